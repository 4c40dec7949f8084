#include <algorithm>
#include <app/python/worker_pool.hpp>
#include <system_error>

namespace heml::python {

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

void WorkerPool::for_each(std::size_t count, const std::function<void(std::size_t)>& work) {
  {
    const std::scoped_lock lock(mutex_);
    work_ = &work;
    count_ = count;
    next_ = 0;
    working_ = workers_.size();
    ++call_;
  }
  called_.notify_all();
  take_items();
  std::unique_lock lock(mutex_);
  done_.wait(lock, [this] { return working_ == 0; });
}

void WorkerPool::take_items() {
  for (std::size_t item = next_++; item < count_; item = next_++) (*work_)(item);
}

void WorkerPool::wait_for_work() {
  long last = 0;
  std::unique_lock lock(mutex_);
  for (;;) {
    called_.wait(lock, [&] { return ends_ || call_ != last; });
    if (ends_) return;
    last = call_;
    lock.unlock();
    take_items();
    lock.lock();
    if (--working_ == 0) done_.notify_one();
  }
}

}  // namespace heml::python
