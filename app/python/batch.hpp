#pragma once
// Many worlds of one scene, stepped by a pool of threads. Each world is computed by one thread, so its bits are those
// of a world by itself.
#include <app/python/live_world.hpp>
#include <app/python/worker_pool.hpp>
#include <functional>
#include <memory>
#include <vector>

namespace heml::python {

class Batch {
 public:
  /// Reads the scene once. All worlds share what no step changes: setup, mesh and layout, until one is edited. threads:
  /// 0: all cores. Throws InputError.
  Batch(Scene scene, int count, int threads);

  ~Batch();
  Batch(const Batch&) = delete;
  Batch& operator=(const Batch&) = delete;

  const std::vector<std::shared_ptr<LiveWorld>>& worlds() const { return worlds_; }
  /// The state at the start, that of all worlds.
  const Snapshot& start() const { return *start_; }

  /// Plays ticks in every world that has not halted. Threads take worlds in turn, each for a slice of time, so that
  /// none waits for another but at the end; the calling one asks interrupted() between slices, and while it waits.
  /// Returns false where that said so: worlds are then some ticks apart. Throws what the first world that throws does,
  /// once all have stopped.
  bool step(long ticks, Clock::duration slice, const std::function<bool()>& interrupted);

 private:
  std::vector<std::shared_ptr<LiveWorld>> worlds_;
  std::shared_ptr<Snapshot> start_;
  std::unique_ptr<WorkerPool> pool_;
  long process_;  ///< that the threads of the pool belong to
};

}  // namespace heml::python
