#pragma once
// A few threads that share loops. A loop is cut into chunks by position alone and each item writes its own result, so
// neither the number of threads nor who takes which chunk changes a bit of it.
//
//   count items:  | range of the caller    | range of worker 0      | range of worker 1      |
//   chunks:       |  c  |  c  |  c  |  c   |  c  |  c  |  c  |  c   |  c  |  c  |  c  |  c   |
//
// A thread claims the chunks of its own range first, which are in its cache, then those left in other ranges. So the
// caller never waits for a worker that has not begun: it does that worker's chunks itself.
//
// Workers spin for some microseconds before they sleep, since waking a sleeping thread takes longer than most loops.
// The caller keeps an account of the time that workers save, of the time it waits for them, and of the time it loses
// its own core to other programs. Once they cost more than they save, it goes on alone for a while.
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
  /// threads: the caller and threads − 1 workers; 0: one a core. Where the system starts fewer, a warning says so;
  /// loops give the same results.
  explicit ThreadTeam(int threads);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  /// Threads that may take part in a loop, the caller included.
  int size() const { return static_cast<int>(workers_.size()) + 1; }

  /// At most so many threads take part from now on, the caller included; clamped to [1, size()]. Called between loops.
  void limit(int threads) { limit_ = static_cast<std::size_t>(std::clamp(threads, 1, size())); }
  int limit() const { return static_cast<int>(limit_); }

  /// Processor time that the workers have had, s.
  double worker_seconds() const;

  /// Calls body(begin, end) on contiguous chunks that together cover [0, count), and returns when all are done.
  /// `grain`: items that are worth a thread of their own. One caller at a time. body must not throw.
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
  /// One thread's part of a loop: [next, end) is not yet claimed.
  struct alignas(64) Range {
    std::atomic<std::size_t> next{0};
    std::size_t end = 0;
  };
  struct alignas(64) Worker {
    std::thread thread;
    std::atomic<int> asleep{0};  ///< 1 until somebody wakes it
    int patience = 0;            ///< grows with loops that came while it waited awake; 0: it sleeps at once
  };

  void start_workers(std::size_t wanted);
  void run(const Loop& loop);
  void open(const Loop& loop);
  std::size_t claim_chunks(std::size_t own);
  void close();
  void settle_account(Clock::time_point began, Clock::time_point worked, std::size_t own_chunks);
  static void wake(Worker& worker);

  void work(Worker& self, std::size_t range);
  std::uint64_t await_loop(Worker& self, std::size_t range, std::uint64_t last) const;
  bool enter(std::uint64_t gate);

  std::vector<std::unique_ptr<Worker>> workers_;  ///< worker k has range k + 1
  std::unique_ptr<Range[]> ranges_;               ///< one a thread, the caller's first
  std::size_t limit_ = 1;
  Loop loop_{};
  std::size_t chunk_ = 1, chunks_ = 0;  ///< items; number of chunks
  std::uint64_t loops_ = 0;
  double credit_ = 0;  ///< s that workers have saved, less what they have cost
  Clock::time_point alone_until_{}, last_end_{};
  struct Mark {
    Clock::time_point wall{};
    double processor = 0;  ///< s that this thread has had
  } mark_;                 ///< not more than a few loops ago
  /// Of the present loop, in bits: 0-14 workers inside, 15 the team ends, 16 open, 17-31 threads, 32-63 its number.
  alignas(64) std::atomic<std::uint64_t> gate_{0};
};

/// Denormals count as zero in this thread while the object lives: they are slow and never matter to a body.
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
