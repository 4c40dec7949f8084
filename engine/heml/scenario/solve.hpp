#pragma once
// Runs a scene to its end without drawing, and writes what it reached.
#include <filesystem>
#include <functional>
#include <heml/scenario/scene.hpp>
#include <heml/world/world.hpp>
#include <optional>

namespace heml {

struct SolveResult {
  std::optional<StopReason> halt;  ///< why it stopped early; what was reached is written all the same
  long ticks = 0, steps = 0;
  double time = 0;          ///< s, simulated
  double wall_seconds = 0;  ///< of stepping
};

/// Static equilibrium under the whole load (the scene's events of step 0 alone take part), or dynamics with the scene's
/// events up to its duration. Writes into `out` (made when missing) positions.csv and
/// report.json, and for outputs.times, in the order listed, positions_<k>.csv; .vtu beside them where asked for
/// (frame_series.hpp); tables of how it went where asked for (trace.hpp); of the last recovery a recording,
/// recovery.jsonl.
/// progress: called now and then with the fraction done. Throws InputError; of an event that the world refuses only
/// after what was reached is written, marked in report.json by "refused".
SolveResult solve(const Scene& scene, const std::filesystem::path& out,
                  const std::function<void(double)>& progress = {});

}  // namespace heml
