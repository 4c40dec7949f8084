#pragma once
// Detects recoveries of a world, and writes a recording that reproduces them.
#include <filesystem>
#include <heml/scenario/scene.hpp>
#include <heml/world/world.hpp>
#include <span>

namespace heml {

/// Writes a recording that leads to the world's current state: scene, commands, one checkpoint, end. It replays to the
/// bit (`heml replay --verify`). scene: as_recorded(); its own events are not written. events: every command since the
/// world was made. world: between two ticks, not halted. Throws InputError when the file cannot be written.
void write_replay(const std::filesystem::path& path, const Scene& scene, std::span<const Event> events,
                  const World& world);

/// Reports when a world's recoveries begin and end. after_tick() must be called after every tick.
class RecoveryMonitor {
 public:
  enum class Change { none, began, ended };
  Change after_tick(const World& world);

 private:
  long begun_ = -1;          ///< Recovery::tick of the last one reported
  bool is_ongoing_ = false;  ///< its end has not been reported yet
};

}  // namespace heml
