#pragma once
// One force evaluation of one body and law, in every way it can be made, against the naive loop: all in turn.
#include <string>
#include <studies/bench.hpp>
#include <studies/bench_bodies.hpp>
#include <studies/interleaved_timing.hpp>
#include <vector>

namespace heml {

struct ForceTiming {
  std::string law, precision, isa;  ///< isa: "native" of the naive loop
  int threads = 1;
  bool naive = false;
  Timing time;
  double bytes_per_tet = 0;  ///< read and written by ours, each array once
  double ratio_to_naive = 1;
};

/// The naive loop first. Forces of all agree with it; what does not is an internal error (std::logic_error).
std::vector<ForceTiming> time_forces(const BenchBody& body, const Material& material, const TimingLimits& limits);

/// As a row of ns/tet.
BenchRow force_row(const ForceTiming& timing, const BenchBody& body);

}  // namespace heml
