#pragma once
// Writes the results of `heml solve`.
#include <filesystem>
#include <heml/world/world.hpp>
#include <optional>
#include <string>

namespace heml {

/// Facts about a solve that are not in the world's state.
struct SolveFacts {
  bool converged = true;
  double wall_seconds = 0;
  std::optional<StopReason> halt;
  std::optional<std::string> refused;  ///< message of the refused event that ended it
};

/// The text of report.json (app/docs/commands.md), indented. file: named where a message cannot be written.
std::string report_text(World& world, const SolveFacts& facts, const std::string& file = "");

/// "3 of 40 elements are inverted ...", with the least J and where it is; empty where none is.
std::string inversion_message(World& world);

/// Writes report.json (app/docs/commands.md); extremes of J are of the present elements. Throws InputError when it
/// cannot be written.
void write_report(const std::filesystem::path& path, World& world, const SolveFacts& facts);

/// Writes the current positions to FOLDER/STEM.csv if `csv`, and the state to FOLDER/STEM.vtu (frame_series.hpp) if
/// `vtu`. Throws InputError when a file cannot be written.
void write_state(const std::filesystem::path& folder, const std::string& stem, World& world, bool csv, bool vtu);

}  // namespace heml
