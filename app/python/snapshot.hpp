#pragma once
// A world's state at one moment, as Python holds it. In the process that took it it is a copy of the state. Pickled it
// is a recording that leads there, which is played to the same bits when it is first restored from in another process.
#include <app/python/event_log.hpp>
#include <heml/scenario/scene.hpp>
#include <heml/world/world_snapshot.hpp>
#include <memory>
#include <mutex>
#include <string>

namespace heml::python {

class Snapshot {
 public:
  /// Where a world was.
  struct Moment {
    long ticks = 0;
    double time = 0;         ///< s
    long next_events = 0;    ///< tick whose events of the scene come next
    std::uint64_t hash = 0;  ///< World::state_hash()
    bool halted = false;
  };

  /// scene: as_recorded(), without its events. past: every command since the world was made.
  Snapshot(std::shared_ptr<const WorldSnapshot> state, std::shared_ptr<const Scene> scene, EventLog past,
           const Moment& moment);

  /// What pickle keeps.
  struct Pickled {
    std::string build, recording, file;
    long kernel_revision = 0;
    Moment moment;
  };
  explicit Snapshot(Pickled pickled);
  /// Throws InputError for a world that had halted: a recording leads to whole ticks alone.
  Pickled pickled() const;

  /// The state. Throws InputError where it was taken by another build, or where the recording does not lead there.
  std::shared_ptr<const WorldSnapshot> state() const;

  const Moment& moment() const { return moment_; }
  const Scene& scene() const { return *scene_; }  ///< of the world it was taken of; its events say nothing
  const EventLog& past() const { return past_; }
  const std::string& build() const { return build_; }

 private:
  std::shared_ptr<const WorldSnapshot> play() const;

  mutable std::mutex mutex_;                            ///< of state_
  mutable std::shared_ptr<const WorldSnapshot> state_;  ///< null until it is played
  std::shared_ptr<const Scene> scene_;
  EventLog past_;
  Moment moment_;
  std::string build_;
  long kernel_revision_;
};

}  // namespace heml::python
