#pragma once
// What `heml solve` writes about the state it reached.
#include <filesystem>
#include <heml/world/world.hpp>
#include <optional>
#include <string>

namespace heml {

/// What is known of a solve besides the world's state.
struct SolveFacts {
  bool converged = true;
  double wall_seconds = 0;
  std::optional<StopReason> halt;
  std::optional<std::string> refused;  ///< an event that ended it, and why
};

/// report.json; extremes of J are of the elements that are there. Throws InputError when it cannot be written.
void write_report(const std::filesystem::path& path, World& world, const SolveFacts& facts);

/// Where asked for, FOLDER/STEM.csv of the positions now and FOLDER/STEM.vtu (frame_series.hpp). Throws InputError
/// likewise.
void write_state(const std::filesystem::path& folder, const std::string& stem, World& world, bool csv, bool vtu);

}  // namespace heml
