#pragma once
// A world as Python holds it: the engine's world, the events of its scene, what was done to it, and its recording.
#include <app/python/event_log.hpp>
#include <app/python/snapshot.hpp>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <heml/scenario/recorder.hpp>
#include <heml/scenario/report.hpp>
#include <heml/scenario/scene.hpp>
#include <heml/scenario/schedule.hpp>
#include <heml/world/world.hpp>
#include <memory>
#include <optional>

namespace heml::python {

using Clock = std::chrono::steady_clock;

/// Knows nothing of Python. One thread at a time; Use refuses a second one.
class LiveWorld {
 public:
  /// threads: 0: as the scene says. Throws InputError.
  LiveWorld(Scene scene, int threads);
  /// Another world at the start that a snapshot of `first` is of, which shares with it what no step changes.
  LiveWorld(const LiveWorld& first, const Snapshot& start);
  ~LiveWorld();
  LiveWorld(const LiveWorld&) = delete;
  LiveWorld& operator=(const LiveWorld&) = delete;

  /// Holds a world for one call. Throws std::runtime_error where another thread does, where the world is closed, or
  /// where it is of the process that this one was forked from.
  class Use {
   public:
    explicit Use(LiveWorld& live);
    ~Use() { live_.in_use_ = false; }
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;

   private:
    LiveWorld& live_;
  };

  /// Another one for every world of the process, closed ones too.
  std::uint64_t number() const { return number_; }
  World& world() { return *world_; }
  const Scene& scene() const { return *scene_; }

  /// Plays up to so many ticks with the events of the scene, until a time. Returns how many are left; none once the
  /// world has halted. Throws InputError when the world refuses an event.
  long step(long ticks, Clock::time_point deadline);
  /// Applies a command now. points: places that stand in for its nodes. Throws InputError when the world refuses it.
  void apply(Command command, const std::vector<Vec3>& points);

  std::shared_ptr<Snapshot> snapshot();
  /// Throws InputError where the snapshot does not fit; then nothing has changed. Ends a recording, and throws too.
  void restore(const Snapshot& snapshot);

  /// Records from now on, the past first. Throws InputError.
  void record(const std::filesystem::path& path);
  void stop_recording();

  SolveFacts facts() const;

  /// Ends its recording and frees all. Any later use is refused.
  void close();
  /// Whether it is; for the thread that may close it.
  bool is_closed() const { return !world_; }

 private:
  void finish_call();
  void remember_state(const Command& command);

  const std::uint64_t number_;
  std::shared_ptr<const Scene> scene_;
  std::unique_ptr<World> world_;
  Schedule schedule_;
  std::shared_ptr<const Scene> recorded_;  ///< as_recorded()
  EventLog past_;
  std::optional<Recorder> recorder_;
  bool restored_ = false;
  struct Before {
    long tick;
    std::uint64_t hash;
  };
  std::optional<Before> before_;  ///< the state before the commands of a tick, where one of them may have changed it
  double seconds_ = 0;            ///< spent stepping
  long process_;                  ///< forks before this process
  std::atomic<bool> in_use_{false};
};

}  // namespace heml::python
