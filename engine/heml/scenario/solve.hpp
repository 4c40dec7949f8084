#pragma once
// Runs a scene to its end without drawing, and writes the results.
#include <filesystem>
#include <functional>
#include <heml/scenario/scene.hpp>
#include <heml/world/world.hpp>
#include <optional>

namespace heml {

struct SolveFacts;  // report.hpp

struct SolveResult {
  std::optional<StopReason> halt;  ///< why it stopped early; results up to there are written all the same
  long ticks = 0, steps = 0;
  double time = 0;          ///< s, simulated
  double wall_seconds = 0;  ///< spent stepping
};

/// Solves for static equilibrium under the full load (of events, only those of step 0 apply), or runs dynamics with all
/// events up to the scene's duration. Writes into the folder `out`, created if missing:
///   positions.csv, report.json      the final state
///   positions_<k>.csv               for each of outputs.times, in the order listed
///   *.vtu of these                  if the scene asks for them (frame_series.hpp)
///   markers.csv, history.csv        if the scene asks for them (trace.hpp)
///   recovery.jsonl                  recording of the last recovery, if there was one
/// progress: called with the fraction done. Throws InputError; for an event that the world refuses only after the
/// results up to there are written, with "refused" in report.json.
SolveResult solve(const Scene& scene, const std::filesystem::path& out,
                  const std::function<void(double)>& progress = {});

/// The same to the bit without files. world: load_world(scene), before its first tick. on_tick: called after every
/// tick; returns false to stop. Throws InputError.
SolveFacts solve(
    const Scene& scene, World& world, const std::function<bool()>& on_tick = [] { return true; });

}  // namespace heml
