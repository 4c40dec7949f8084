#include <heml/base/thread_team.hpp>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace heml {

ThreadTeam::ThreadTeam(int threads) {
  const int wanted = threads > 0 ? threads : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  workers_ = std::vector<Worker>(static_cast<std::size_t>(wanted - 1));
  for (std::size_t k = 0; k < workers_.size(); ++k) workers_[k].thread = std::thread([this, k] { work(k); });
}

ThreadTeam::~ThreadTeam() {
  {
    std::lock_guard lock(mutex_);
    stop_ = true;
  }
  for (Worker& worker : workers_) worker.wake.notify_one();
  for (Worker& worker : workers_) worker.thread.join();
}

void ThreadTeam::run_piece(const Loop& loop, std::size_t piece) {
  loop.call(loop.body, loop.count * piece / loop.pieces, loop.count * (piece + 1) / loop.pieces);
}

/// Wakes as many as there are pieces: to wake the others would take longer than many a loop.
void ThreadTeam::run(const Loop& loop) {
  const std::size_t helpers = loop.pieces - 1;
  {
    std::lock_guard lock(mutex_);
    loop_ = loop;
    unfinished_ = helpers;
    for (std::size_t k = 0; k < helpers; ++k) workers_[k].is_wanted = true;
  }
  for (std::size_t k = 0; k < helpers; ++k) workers_[k].wake.notify_one();
  run_piece(loop, 0);
  std::unique_lock lock(mutex_);
  done_.wait(lock, [this] { return unfinished_ == 0; });
}

void ThreadTeam::work(std::size_t k) {
  FlushDenormals flush;
  Worker& self = workers_[k];
  std::unique_lock lock(mutex_);
  for (;;) {
    self.wake.wait(lock, [&] { return stop_ || self.is_wanted; });
    if (stop_) return;
    self.is_wanted = false;
    const Loop loop = loop_;
    lock.unlock();
    run_piece(loop, k + 1);
    lock.lock();
    if (--unfinished_ == 0) done_.notify_one();
  }
}

#if defined(__SSE2__)
FlushDenormals::FlushDenormals() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | 0x8040u); }
FlushDenormals::~FlushDenormals() { _mm_setcsr(saved_); }
#else
FlushDenormals::FlushDenormals() = default;
FlushDenormals::~FlushDenormals() = default;
#endif

}  // namespace heml
