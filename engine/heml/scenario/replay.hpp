#pragma once
// Plays the events of a scene or recording in a world and compares the states on the way with the recorded ones.
#include <functional>
#include <heml/scenario/recorder.hpp>
#include <heml/scenario/scene.hpp>
#include <heml/world/world.hpp>
#include <optional>
#include <string>

namespace heml {

/// The first recorded state that a replay did not reach.
struct ReplayDifference {
  long tick = 0;  ///< of the checkpoint
  int node = -1;  ///< the first node that differs, mesh-file order; -1: the checkpoint does not tell
  std::uint64_t expected = 0, actual = 0;  ///< state hashes; the same where only the recorded hash of a node is wrong
};

struct ReplayResult {
  long ticks = 0;                              ///< played
  long checkpoints = 0;                        ///< compared
  std::optional<ReplayDifference> difference;  ///< the first
  std::optional<StopReason> halt;              ///< the world stopped before the end, or as its end says
};

/// How many ticks a replay plays: as far as the recording goes, with the one in which it stopped where it did; or, of a
/// scene with a script, its duration.
long ticks_to_play(const Scene& scene);

/// world: load_world(scene), before its first tick. on_tick: called after every tick. recorder: of that world, takes
/// down what is played and is ended. Throws InputError when the world refuses an event.
ReplayResult replay(const Scene& scene, World& world, const std::function<void(World&)>& on_tick = {},
                    Recorder* recorder = nullptr);

/// One sentence for people.
std::string to_text(const ReplayDifference& difference);

}  // namespace heml
