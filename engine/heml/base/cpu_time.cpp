#include <pthread.h>

#include <ctime>
#include <heml/base/cpu_time.hpp>

namespace heml {
namespace {

double seconds_of(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

double cpu_seconds_of_thread() { return seconds_of(CLOCK_THREAD_CPUTIME_ID); }
double cpu_seconds_of(std::thread& thread) {
  clockid_t clock{};
  return pthread_getcpuclockid(thread.native_handle(), &clock) == 0 ? seconds_of(clock) : 0;
}
double cpu_seconds_of_process() { return seconds_of(CLOCK_PROCESS_CPUTIME_ID); }

}  // namespace heml
