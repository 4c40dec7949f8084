#include <heml/base/write_file.hpp>
#include <heml/scenario/recovery_monitor.hpp>

namespace heml {

void write_replay(const std::filesystem::path& path, const Scene& scene, std::span<const Event> events,
                  const World& world) {
  const std::filesystem::path folder = path.parent_path();
  std::string text = scene_line(scene, folder.empty() ? "." : folder) + '\n';
  for (const Event& event : events) text += event_line(event) + '\n';
  const std::uint64_t hash = world.state_hash();
  text += checkpoint_line({world.ticks(), hash, world.node_hashes()}) + '\n';
  text += end_line({world.ticks(), 1, hash, {}, {}}) + '\n';
  write_file(path, text);
}

RecoveryMonitor::Change RecoveryMonitor::after_tick(const World& world) {
  const Recovery* recovery = world.recovery();
  if (recovery && recovery->tick != begun_) {
    begun_ = recovery->tick;
    is_ongoing_ = true;
    return Change::began;
  }
  if (!is_ongoing_ || (recovery && !recovery->ended)) return Change::none;
  is_ongoing_ = false;
  return recovery ? Change::ended : Change::none;  // none: the world was reset
}

}  // namespace heml
