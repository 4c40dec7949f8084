#include <heml/base/thread_team.hpp>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace heml {

ThreadTeam::ThreadTeam(int threads) {
  const int wanted = threads > 0 ? threads : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  for (int i = 1; i < wanted; ++i) workers_.emplace_back([this, i] { work(static_cast<std::size_t>(i)); });
}

ThreadTeam::~ThreadTeam() {
  {
    std::lock_guard lock(mutex_);
    stop_ = true;
  }
  start_.notify_all();
  for (auto& worker : workers_) worker.join();
}

void ThreadTeam::run_piece(const Loop& loop, std::size_t piece) {
  if (piece >= loop.pieces) return;
  loop.call(loop.body, loop.count * piece / loop.pieces, loop.count * (piece + 1) / loop.pieces);
}

void ThreadTeam::run(const Loop& loop) {
  {
    std::lock_guard lock(mutex_);
    loop_ = loop;
    unfinished_ = workers_.size();
    ++round_;
  }
  start_.notify_all();
  run_piece(loop, 0);
  std::unique_lock lock(mutex_);
  done_.wait(lock, [this] { return unfinished_ == 0; });
}

void ThreadTeam::work(std::size_t piece) {
  FlushDenormals flush;
  unsigned long seen = 0;
  for (;;) {
    Loop loop;
    {
      std::unique_lock lock(mutex_);
      start_.wait(lock, [&] { return stop_ || round_ != seen; });
      if (stop_) return;
      seen = round_;
      loop = loop_;
    }
    run_piece(loop, piece);
    std::lock_guard lock(mutex_);
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
