#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <heml/base/thread_team.hpp>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

namespace heml::thread_team_test {

TEST_CASE("every item of a loop is visited once, whatever the number of threads") {
  for (const int threads : {1, 2, 3, 16}) {
    ThreadTeam team(threads);
    CHECK(team.size() == threads);
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{7}, std::size_t{1000}}) {
      std::vector<int> visits(count, 0);
      for (int repeat = 0; repeat < 20; ++repeat)
        team.parallel_for(count, 3, [&](std::size_t begin, std::size_t end) {
          for (std::size_t i = begin; i < end; ++i) ++visits[i];
        });
      for (const int visit : visits) REQUIRE(visit == 20);
    }
  }
}

TEST_CASE("loops in close succession see what the loop before them wrote") {
  ThreadTeam team(4);
  std::vector<int> a(4096, 0), b(4096, 0);
  for (int repeat = 0; repeat < 5000; ++repeat) {
    team.parallel_for(a.size(), 64, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) a[i] = b[a.size() - 1 - i] + 1;
    });
    team.parallel_for(b.size(), 64, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) b[i] = a[i];
    });
  }
  CHECK(std::all_of(b.begin(), b.end(), [](int value) { return value == 5000; }));
}

TEST_CASE("a loop shorter than its grain stays on the calling thread") {
  ThreadTeam team(4);
  std::size_t calls = 0;
  team.parallel_for(99, 100, [&](std::size_t begin, std::size_t end) {
    ++calls;
    CHECK(begin == 0);
    CHECK(end == 99);
  });
  CHECK(calls == 1);
}

void compute_for(std::chrono::microseconds time) {
  const auto until = std::chrono::steady_clock::now() + time;
  while (std::chrono::steady_clock::now() < until) {
  }
}

/// Number of threads that take part in loops. Repeats loops until `wanted` threads have or `longest` has passed:
/// other programs may delay workers on a busy machine.
std::size_t threads_seen(ThreadTeam& team, std::size_t wanted, std::chrono::milliseconds longest) {
  std::mutex mutex;
  std::set<std::thread::id> seen;
  const auto until = std::chrono::steady_clock::now() + longest;
  while (seen.size() < wanted && std::chrono::steady_clock::now() < until)
    team.parallel_for(64, 1, [&](std::size_t, std::size_t) {
      compute_for(std::chrono::microseconds(100));
      std::lock_guard lock(mutex);
      seen.insert(std::this_thread::get_id());
    });
  return seen.size();
}

TEST_CASE("a limit keeps workers out, and lets them in again") {
  constexpr auto patience = std::chrono::seconds(60);
  ThreadTeam team(3);
  CHECK(threads_seen(team, 3, patience) == 3);
  team.limit(1);
  CHECK(threads_seen(team, 2, std::chrono::milliseconds(100)) == 1);
  team.limit(100);
  CHECK(team.limit() == 3);
  CHECK(threads_seen(team, 3, patience) == 3);
}

TEST_CASE("after a long pause within a loop workers soon take part again") {
  ThreadTeam team(2);
  team.parallel_for(2, 1,
                    [](std::size_t, std::size_t) { std::this_thread::sleep_for(std::chrono::milliseconds(400)); });
  CHECK(threads_seen(team, 2, std::chrono::seconds(15)) == 2);
}

TEST_CASE("workers sleep between loops that are far apart") {
  ThreadTeam team(2);
  threads_seen(team, 2, std::chrono::milliseconds(100));
  std::this_thread::sleep_for(std::chrono::milliseconds(20));  // longer than any spin
  const double before = team.worker_seconds();
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  CHECK(team.worker_seconds() - before < 0.02);
}

TEST_CASE("a team that the system refuses threads computes with fewer") {
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    const rlimit one{1, 1};
    if (setrlimit(RLIMIT_NPROC, &one) != 0 || (getuid() == 0 && setuid(65534) != 0)) _exit(2);
    ThreadTeam team(6);
    int sum = 0;
    team.parallel_for(1000, 1, [&](std::size_t begin, std::size_t end) { sum += static_cast<int>(end - begin); });
    _exit(team.size() == 1 && sum == 1000 ? 0 : 1);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
}

}  // namespace heml::thread_team_test
