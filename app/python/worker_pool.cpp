#include <algorithm>
#include <app/python/worker_pool.hpp>
#include <chrono>
#include <system_error>

namespace heml::python {
namespace {

constexpr std::chrono::milliseconds waiting_interval{50};

}  // namespace

WorkerPool::WorkerPool(int threads) {
  const auto wanted = threads > 0 ? static_cast<unsigned>(threads) : std::max(1u, std::thread::hardware_concurrency());
  try {
    while (workers_.size() + 1 < wanted) workers_.emplace_back([this] { wait_for_work(); });
  } catch (const std::system_error&) {
    // As many as the system starts: results are the same.
  }
}

WorkerPool::~WorkerPool() {
  {
    const std::scoped_lock lock(mutex_);
    ends_ = true;
  }
  called_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void WorkerPool::run(const std::function<void()>& work, const std::function<void()>& waiting) {
  {
    const std::scoped_lock lock(mutex_);
    work_ = &work;
    working_ = workers_.size();
    ++call_;
  }
  called_.notify_all();
  work();
  std::unique_lock lock(mutex_);
  while (!done_.wait_for(lock, waiting_interval, [this] { return working_ == 0; })) {
    lock.unlock();
    waiting();
    lock.lock();
  }
}

void WorkerPool::wait_for_work() {
  long last = 0;
  std::unique_lock lock(mutex_);
  for (;;) {
    called_.wait(lock, [&] { return ends_ || call_ != last; });
    if (ends_) return;
    last = call_;
    lock.unlock();
    (*work_)();
    lock.lock();
    if (--working_ == 0) done_.notify_one();
  }
}

}  // namespace heml::python
