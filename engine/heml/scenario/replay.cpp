#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <heml/scenario/replay.hpp>
#include <heml/scenario/schedule.hpp>

namespace heml {
namespace {

int first_different_node(const std::vector<std::uint16_t>& expected, const std::vector<std::uint16_t>& actual) {
  const auto [at, other] = std::mismatch(expected.begin(), expected.end(), actual.begin(), actual.end());
  return at == expected.end() || other == actual.end() ? -1 : static_cast<int>(at - expected.begin());
}

/// Compares the checkpoints of a recording as the world comes past them.
class Comparison {
 public:
  explicit Comparison(const std::vector<Checkpoint>& checkpoints) : checkpoints_(checkpoints) {}

  /// Compares those up to a tick with the world as it is.
  void up_to(long tick, const World& world, ReplayResult& result) {
    for (; next_ < checkpoints_.size() && checkpoints_[next_].tick <= tick; ++next_) {
      const Checkpoint& checkpoint = checkpoints_[next_];
      const std::uint64_t hash = world.state_hash();
      ++result.checkpoints;
      if (hash == checkpoint.hash || result.difference) continue;
      const int node = first_different_node(checkpoint.nodes, world.node_hashes());
      result.difference = {checkpoint.tick, node, checkpoint.hash, hash};
    }
  }

 private:
  const std::vector<Checkpoint>& checkpoints_;
  std::size_t next_ = 0;
};

}  // namespace

long ticks_to_play(const Scene& scene) {
  if (scene.recorded_ticks) return *scene.recorded_ticks;
  return std::lround(scene.solver.duration / scene.solver.tick());
}

ReplayResult replay(const Scene& scene, World& world, const std::function<void(World&)>& on_tick, Recorder* recorder) {
  const long ticks = ticks_to_play(scene);
  Schedule schedule(scene, world.setup().mesh);
  Comparison comparison(scene.checkpoints);
  ReplayResult result;
  while (true) {
    comparison.up_to(world.ticks(), world, result);
    if (world.ticks() >= ticks || world.halt()) break;
    const std::size_t past = schedule.past().size();
    schedule.apply(world);
    if (recorder)
      for (const Event& event : schedule.past().subspan(past)) recorder->command(world, event.command);
    world.tick();
    if (recorder) recorder->ticked(world);
    if (on_tick) on_tick(world);
  }
  comparison.up_to(ticks, world, result);  // what a halt left unreached
  if (recorder) recorder->end(world);
  result.ticks = world.ticks();
  if (world.ticks() < ticks) result.halt = world.halt();
  return result;
}

std::string to_text(const ReplayDifference& difference) {
  const std::string node = difference.node < 0 ? "" : fmt::format(", node {}", difference.node);
  return fmt::format("differs at step {}{}: state {:016x}, recorded {:016x}", difference.tick, node, difference.actual,
                     difference.expected);
}

}  // namespace heml
