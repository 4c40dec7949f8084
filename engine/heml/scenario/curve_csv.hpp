#pragma once
// Curves of material tests as CSV: what was measured comes in, what a law gives goes out.
#include <filesystem>
#include <heml/materials/fit.hpp>

namespace heml {

/// What the first column of a test is: "stretch", "gamma" or "time".
std::string_view amount_name(const MeasuredTest& test);

/// Reads a measured curve: header `stretch,stress` (`gamma,stress` for shear, `time,stress` for relaxation), then two
/// numbers a line; stress is nominal, Pa; lines that begin with # are skipped. Throws InputError naming the line.
MeasuredCurve read_curve_csv(const std::filesystem::path& path, const MeasuredTest& test);

}  // namespace heml
