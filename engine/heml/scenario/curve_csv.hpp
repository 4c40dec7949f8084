#pragma once
// Reads measured curves of material tests from CSV.
#include <filesystem>
#include <heml/materials/fit.hpp>

namespace heml {

/// Name of the first column of a test: "stretch", "gamma" or "time".
std::string_view amount_name(const MeasuredTest& test);

/// Reads a measured curve: header `stretch,stress` (`gamma,stress` for shear, `time,stress` for relaxation), then two
/// numbers a line. Stress is nominal, Pa; time is in s. Lines that begin with # are skipped. Throws InputError naming
/// the line.
MeasuredCurve read_curve_csv(const std::filesystem::path& path, const MeasuredTest& test);

}  // namespace heml
