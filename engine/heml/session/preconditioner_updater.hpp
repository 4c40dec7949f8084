#pragma once
// Has the preconditioner of implicit steps made anew, in a thread of its own, after elements were removed: its arrival,
// which a clock decides, becomes a command, which is recorded like any other, so a replay needs no clock.
#include <heml/dynamics/preconditioner_build.hpp>
#include <heml/world/world.hpp>
#include <thread>

namespace heml {

class PreconditionerUpdater {
 public:
  PreconditionerUpdater() = default;
  ~PreconditionerUpdater();  ///< waits for work under way
  PreconditionerUpdater(const PreconditionerUpdater&) = delete;
  PreconditionerUpdater& operator=(const PreconditionerUpdater&) = delete;

  /// Before each tick. Begins work where there is some; returns whether it has arrived for the body as it is: time for
  /// AdoptPreconditioner. What a body has left behind meanwhile is made again.
  bool arrived(World& world);

 private:
  std::shared_ptr<PreconditionerBuild> work_;  ///< under way
  std::thread thread_;
  long version_ = 0;  ///< of the topology that was looked at last
};

}  // namespace heml
