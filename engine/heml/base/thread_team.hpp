#pragma once
// Threads for parallel loops. A loop is split into contiguous chunks and each item writes its own result, so results
// are bit-identical for any number of threads and whichever thread runs a chunk.
//
//   count items:  | range of the caller    | range of worker 0      | range of worker 1      |
//   chunks:       |  c  |  c  |  c  |  c   |  c  |  c  |  c  |  c   |  c  |  c  |  c  |  c   |
//
// A thread first claims the chunks of its own range, whose data are in its cache, then those left in other ranges. So
// the caller never waits for a worker that has not started: it runs that worker's chunks itself.
//
// Workers spin for some microseconds before they sleep, since waking a sleeping thread takes longer than most loops.
// The caller sums the time that workers save, less the time it waits for them and the time in which other programs
// use its core. When the sum is negative, it runs loops serially for a while.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

namespace heml {

class ThreadTeam {
 public:
  /// Starts threads − 1 workers beside the calling thread; 0: one thread per core. Warns if the system starts fewer.
  explicit ThreadTeam(int threads);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  /// Number of threads, the caller included.
  int size() const { return static_cast<int>(workers_.size()) + 1; }

  /// Sets the maximum number of threads of a loop, the caller included; clamped to [1, size()]. Not during a loop.
  void limit(int threads) { limit_ = static_cast<std::size_t>(std::clamp(threads, 1, size())); }
  int limit() const { return static_cast<int>(limit_); }

  /// CPU time of the workers, s.
  double worker_seconds() const;

  /// Calls body(begin, end) on contiguous chunks that together cover [0, count), and returns when all are done.
  /// grain: least number of items per thread. Not thread-safe: one caller at a time. body must not throw.
  template <class Body>
  void parallel_for(std::size_t count, std::size_t grain, const Body& body) {
    const std::size_t threads = std::min<std::size_t>(limit_, grain ? count / grain : count);
    if (threads <= 1) {
      if (count) body(std::size_t{0}, count);
      return;
    }
    run(Loop{[](const void* b, std::size_t first, std::size_t last) { (*static_cast<const Body*>(b))(first, last); },
             &body, count, threads});
  }

 private:
  using Clock = std::chrono::steady_clock;
  struct Loop {
    void (*call)(const void*, std::size_t, std::size_t);
    const void* body;
    std::size_t count, threads;
  };
  /// One thread's part of a loop; [next, end) is unclaimed.
  struct alignas(64) Range {
    std::atomic<std::size_t> next{0};
    std::size_t end = 0;
  };
  struct alignas(64) Worker {
    std::thread thread;
    std::atomic<int> asleep{0};  ///< 1: waits to be woken
    int spin_budget = 0;         ///< grows with each loop that arrives while the worker spins; 0: sleeps at once
  };

  void start_workers(std::size_t wanted);
  void run(const Loop& loop);
  void open(const Loop& loop);
  std::size_t claim_chunks(std::size_t own);
  void close();
  void update_credit(Clock::time_point began, Clock::time_point worked, std::size_t own_chunks);
  static void wake(Worker& worker);

  void work(Worker& self, std::size_t range);
  std::uint64_t await_loop(Worker& self, std::size_t range, std::uint64_t last) const;
  bool enter(std::uint64_t gate);

  std::vector<std::unique_ptr<Worker>> workers_;  ///< worker k has range k + 1
  std::unique_ptr<Range[]> ranges_;               ///< one per thread, the caller's first
  std::size_t limit_ = 1;
  Loop loop_{};
  std::size_t chunk_ = 1, chunks_ = 0;  ///< items per chunk; number of chunks
  std::uint64_t loops_ = 0;
  double credit_ = 0;  ///< time saved by workers less their cost, s
  Clock::time_point serial_until_{}, last_end_{};
  struct Mark {
    Clock::time_point wall{};
    double processor = 0;  ///< CPU time of the caller, s
  } mark_;                 ///< start of the interval in which lost CPU time is measured
  /// Bits 0-14: workers inside the current loop; 15: stop; 16: open to workers; 17-31: threads; 32-63: loop number.
  alignas(64) std::atomic<std::uint64_t> gate_{0};
};

/// Treats denormals as zero in the constructing thread during its lifetime: they are slow and too small to matter.
/// Does nothing without SSE2.
class FlushDenormals {
 public:
  FlushDenormals();
  ~FlushDenormals();
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  unsigned saved_ = 0;
};

}  // namespace heml
