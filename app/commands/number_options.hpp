#pragma once
// Validators for numbers on the command line. CLI11's own checks accept nan and inf.
#include <CLI/CLI.hpp>
#include <limits>

namespace heml {

/// A finite number greater than 0.
CLI::Validator positive_number();
/// A finite number, low and high included.
CLI::Validator number_between(double low, double high = std::numeric_limits<double>::max());
/// A whole number, low and high included.
CLI::Validator whole_number_between(long low, long high = std::numeric_limits<int>::max());
/// A number of threads, as in scenes: 0 is one per core.
CLI::Validator thread_count();

}  // namespace heml
