#pragma once
// A few threads that share loops. Ranges are split by position alone and each item writes its own result, so the number
// of threads never changes a bit of it. Workers sleep between loops: on a small machine a spinning worker steals the
// core from drawing.
#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <thread>
#include <vector>

namespace heml {

class ThreadTeam {
 public:
  /// threads: the caller and threads − 1 workers; 0: one a core.
  explicit ThreadTeam(int threads);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  int size() const { return static_cast<int>(workers_.size()) + 1; }

  /// Calls body(begin, end) on contiguous pieces that together cover [0, count), each at least `grain` long, and
  /// returns when all are done. One caller at a time. body must not throw.
  template <class Body>
  void for_ranges(std::size_t count, std::size_t grain, const Body& body) {
    const std::size_t pieces = std::min<std::size_t>(workers_.size() + 1, grain ? count / grain : count);
    if (pieces <= 1) {
      if (count) body(std::size_t{0}, count);
      return;
    }
    run(Loop{[](const void* b, std::size_t first, std::size_t last) { (*static_cast<const Body*>(b))(first, last); },
             &body, count, pieces});
  }

 private:
  struct Loop {
    void (*call)(const void*, std::size_t, std::size_t);
    const void* body;
    std::size_t count, pieces;
  };
  void run(const Loop& loop);
  struct Worker {
    std::thread thread;
    std::condition_variable wake;
    bool is_wanted = false;
  };
  void work(std::size_t k);
  static void run_piece(const Loop& loop, std::size_t piece);

  std::vector<Worker> workers_;
  std::mutex mutex_;
  std::condition_variable done_;
  Loop loop_{};
  std::size_t unfinished_ = 0;
  bool stop_ = false;
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
