#pragma once
// Rebuilds the preconditioner of implicit steps on another thread after the mesh was edited. The time of adoption
// depends on the clock, so it becomes a recorded command (AdoptPreconditioner), which a replay repeats.
#include <heml/dynamics/preconditioner_build.hpp>
#include <heml/world/world.hpp>
#include <thread>

namespace heml {

class PreconditionerUpdater {
 public:
  PreconditionerUpdater() = default;
  ~PreconditionerUpdater();  ///< waits for a build under way
  PreconditionerUpdater(const PreconditionerUpdater&) = delete;
  PreconditionerUpdater& operator=(const PreconditionerUpdater&) = delete;

  /// Call before each tick. Starts a build if the topology has changed. Returns true when a build for the current
  /// topology is done: apply AdoptPreconditioner then. A build that became outdated meanwhile is discarded and
  /// restarted.
  bool arrived(World& world);

 private:
  std::shared_ptr<PreconditionerBuild> work_;  ///< under way
  std::thread thread_;
  long version_ = 0;  ///< of the topology last built for
};

}  // namespace heml
