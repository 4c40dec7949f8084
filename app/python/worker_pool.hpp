#pragma once
// Threads for work of milliseconds and more, which all of them do together. base/thread_team.hpp is for loops of
// microseconds: it computes alone for a while where other programs on its cores keep it waiting, which would cost a
// batch half its speed.
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

  /// Calls work() once on every thread, the calling one too, and returns when all have ended; calls waiting() now and
  /// then while it waits for others. One caller at a time. Neither may throw.
  void run(const std::function<void()>& work, const std::function<void()>& waiting);

 private:
  void wait_for_work();

  std::mutex mutex_;
  std::condition_variable called_, done_;
  const std::function<void()>* work_ = nullptr;
  long call_ = 0;            ///< number of the last call of run()
  std::size_t working_ = 0;  ///< workers that have not ended it
  bool ends_ = false;
  std::vector<std::thread> workers_;
};

}  // namespace heml::python
