#pragma once
// Replays the events of a scene or recording in a world and compares its states with the recorded checkpoints.
#include <functional>
#include <heml/scenario/recorder.hpp>
#include <heml/scenario/scene.hpp>
#include <heml/world/world.hpp>
#include <optional>
#include <string>

namespace heml {

/// The first recorded state that a replay did not reproduce.
struct ReplayDifference {
  long tick = 0;                           ///< of the checkpoint
  int node = -1;                           ///< the first node that differs, mesh-file order; -1: unknown
  std::uint64_t expected = 0, actual = 0;  ///< state hashes; equal where only a node's recorded hash differs
};

struct ReplayResult {
  long ticks = 0;                              ///< played
  long checkpoints = 0;                        ///< compared
  std::optional<ReplayDifference> difference;  ///< the first
  std::optional<StopReason> halt;              ///< why the world halted before the last tick to play
};

/// Number of ticks to replay: those of the recording, including the one in which it halted; of a scene, its duration.
long ticks_to_play(const Scene& scene);

/// world: load_world(scene), before its first tick. on_tick: called after every tick. recorder: of that world; records
/// the replay, including its end. Throws InputError when the world refuses an event.
ReplayResult replay(const Scene& scene, World& world, const std::function<void(World&)>& on_tick = {},
                    Recorder* recorder = nullptr);

/// One readable sentence.
std::string to_text(const ReplayDifference& difference);

}  // namespace heml
