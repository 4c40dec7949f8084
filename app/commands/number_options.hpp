#pragma once
// What numbers the command line takes. CLI11's own checks let nan and inf through.
#include <CLI/CLI.hpp>
#include <limits>

namespace heml {

/// A finite number greater than 0.
CLI::Validator positive_number();
/// A finite number, low and high included.
CLI::Validator number_between(double low, double high = std::numeric_limits<double>::max());
/// A whole number, low and high included.
CLI::Validator whole_number_between(long low, long high = std::numeric_limits<int>::max());
/// How many threads, as scenes have it: 0 is one a core.
CLI::Validator thread_count();

}  // namespace heml
