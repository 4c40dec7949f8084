#pragma once
// What led a world into a recovery, kept so that anybody can see it again.
#include <filesystem>
#include <heml/scenario/scene.hpp>
#include <heml/world/world.hpp>
#include <span>

namespace heml {

/// world: between two ticks, not halted. Writes the way to its present state as a recording: the scene, the commands, a
/// checkpoint of the state, the end. It plays back to the bit (`heml replay --verify`). events: every command since the
/// world was built; those the scene itself holds are not written. scene: as_recorded() of it. Throws InputError when
/// the file cannot be written.
void write_replay(const std::filesystem::path& path, const Scene& scene, std::span<const Event> events,
                  const World& world);

/// Tells when a world's recoveries begin and end. Asked after every tick.
class RecoveryMonitor {
 public:
  enum class Change { none, began, ended };
  Change after_tick(const World& world);

 private:
  long begun_ = -1;          ///< Recovery::tick of the last one told of
  bool is_ongoing_ = false;  ///< its end is still to be told
};

}  // namespace heml
