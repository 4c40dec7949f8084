#pragma once
// Threads for work of milliseconds and more: each item goes to whichever thread is free, so that none waits for a slower
// one but at the end. base/thread_team.hpp is for loops of microseconds: it computes alone for a while where other
// programs on its cores keep it waiting, which for a batch would cost half its speed.
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace heml::python {

class WorkerPool {
 public:
  /// threads: the calling one included; 0: one per core. The system may start fewer.
  explicit WorkerPool(int threads);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  /// Calls work(item) for every item of [0, count) and returns when all are done. One caller at a time. work must not
  /// throw.
  void for_each(std::size_t count, const std::function<void(std::size_t)>& work);

 private:
  void take_items();
  void wait_for_work();

  std::mutex mutex_;
  std::condition_variable called_, done_;
  const std::function<void(std::size_t)>* work_ = nullptr;
  std::size_t count_ = 0;
  std::atomic<std::size_t> next_{0};
  long call_ = 0;           ///< number of the last call of for_each()
  std::size_t working_ = 0;  ///< workers that have not ended it
  bool ends_ = false;
  std::vector<std::thread> workers_;
};

}  // namespace heml::python
