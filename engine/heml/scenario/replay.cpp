#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <heml/scenario/replay.hpp>
#include <heml/scenario/schedule.hpp>
#include <utility>

namespace heml {
namespace {

int first_different_node(const std::vector<std::uint16_t>& expected, const std::vector<std::uint16_t>& actual) {
  const auto [at, other] = std::mismatch(expected.begin(), expected.end(), actual.begin(), actual.end());
  return at == expected.end() && other == actual.end() ? -1 : static_cast<int>(at - expected.begin());
}

/// Compares the world with the checkpoints and the end state of a recording.
class Comparison {
 public:
  explicit Comparison(const Scene& recording) : recording_(recording) {}

  /// Call before the events of each tick.
  void at(const World& world, ReplayResult& result) {
    const std::vector<Checkpoint>& all = recording_.checkpoints;
    for (; next_ < all.size() && all[next_].tick == world.ticks(); ++next_) compare(all[next_], world, result);
    const auto& end = recording_.recorded_end;
    if (!end || !end->hash || end->tick != world.ticks() || std::exchange(ended_, true)) return;
    if (const std::uint64_t hash = world.state_hash(); hash != *end->hash && !result.difference)
      result.difference = {end->tick, -1, *end->hash, hash};
  }

 private:
  static void compare(const Checkpoint& checkpoint, const World& world, ReplayResult& result) {
    ++result.checkpoints;
    const std::uint64_t hash = world.state_hash();
    const int node = checkpoint.nodes.empty() ? -1 : first_different_node(checkpoint.nodes, world.node_hashes());
    if ((hash != checkpoint.hash || node >= 0) && !result.difference)
      result.difference = {checkpoint.tick, node, checkpoint.hash, hash};
  }

  const Scene& recording_;
  std::size_t next_ = 0;
  bool ended_ = false;
};

}  // namespace

long ticks_to_play(const Scene& scene) {
  if (scene.recorded_end && scene.recorded_end->halt) return scene.recorded_end->tick + 1;
  if (scene.recorded_ticks) return *scene.recorded_ticks;
  return std::lround(scene.solver.duration / scene.solver.tick());
}

ReplayResult replay(const Scene& scene, World& world, const std::function<void(World&)>& on_tick, Recorder* recorder) {
  const long ticks = ticks_to_play(scene);
  Schedule schedule(scene, world.setup().mesh);
  Comparison comparison(scene);
  ReplayResult result;
  while (true) {
    comparison.at(world, result);
    if (world.ticks() >= ticks || world.halt()) break;
    schedule.apply(world, [&](const Command& command) {
      if (recorder) recorder->command(world, command);
    });
    world.tick();
    if (recorder) recorder->ticked(world);
    if (on_tick) on_tick(world);
  }
  if (recorder) recorder->end(world);
  result.ticks = world.ticks();
  if (world.ticks() < ticks) result.halt = world.halt();
  return result;
}

std::string to_text(const ReplayDifference& difference) {
  const std::string node = difference.node < 0 ? "" : fmt::format(", node {}", difference.node);
  if (difference.actual == difference.expected)
    return fmt::format("differs at step {}{}: its recorded hash is not that of the state, {:016x}", difference.tick,
                       node, difference.actual);
  return fmt::format("differs at step {}{}: state {:016x}, recorded {:016x}", difference.tick, node, difference.actual,
                     difference.expected);
}

}  // namespace heml
