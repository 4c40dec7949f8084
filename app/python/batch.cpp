#include <unistd.h>

#include <app/python/batch.hpp>
#include <atomic>
#include <deque>
#include <exception>
#include <mutex>
#include <numeric>
#include <thread>

namespace heml::python {

Batch::Batch(Scene scene, int count, int threads) : pool_(std::make_unique<WorkerPool>(threads)), process_(getpid()) {
  worlds_.push_back(std::make_shared<LiveWorld>(std::move(scene), 1));
  start_ = worlds_[0]->snapshot();
  while (worlds_.size() < static_cast<std::size_t>(count))
    worlds_.push_back(std::make_shared<LiveWorld>(*worlds_[0], *start_));
}

Batch::~Batch() {
  if (process_ != getpid()) static_cast<void>(pool_.release());  // a fork: its threads are not here to be ended
}

bool Batch::step(long ticks, Clock::duration slice, const std::function<bool()>& interrupted) {
  std::vector<long> left(worlds_.size(), ticks);
  std::vector<std::exception_ptr> errors(worlds_.size());
  std::deque<std::size_t> waiting(ticks > 0 ? worlds_.size() : 0);
  std::iota(waiting.begin(), waiting.end(), std::size_t{0});
  std::mutex mutex;  // of `waiting`
  std::atomic<bool> stops{false};
  const auto caller = std::this_thread::get_id();
  const auto check = [&] {
    if (!stops && interrupted()) stops = true;
  };
  const auto step_worlds = [&] {
    std::unique_lock lock(mutex);
    while (!stops && !waiting.empty()) {
      const std::size_t i = waiting.front();
      waiting.pop_front();
      lock.unlock();
      try {
        left[i] = worlds_[i]->step(left[i], Clock::now() + slice);
      } catch (...) {
        errors[i] = std::current_exception();
        left[i] = 0;
      }
      if (std::this_thread::get_id() == caller) check();
      lock.lock();
      if (left[i] > 0) waiting.push_back(i);
    }
  };
  pool_->run(step_worlds, check);
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
  return !stops;
}

}  // namespace heml::python
