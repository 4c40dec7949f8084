#pragma once
// Times one force evaluation of a body and law for every instruction set, precision and number of threads, interleaved
// with the naive loop.
#include <string>
#include <studies/bench.hpp>
#include <studies/bench_bodies.hpp>
#include <studies/interleaved_timing.hpp>
#include <vector>

namespace heml {

struct ForceTiming {
  std::string law, precision, isa;  ///< isa: "native" for the naive loop
  int threads = 1;
  bool naive = false;
  Timing time;
  double bytes_per_tet = 0;  ///< read and written by the engine, each array once
  double ratio_to_naive = 1;
};

/// The naive loop first. Throws std::logic_error where forces differ from it by more than 1e-10 (double) or 1e-2
/// (float), relative.
std::vector<ForceTiming> time_forces(const BenchBody& body, const Material& material, const TimingLimits& limits);

/// As a row of ns/tet.
BenchRow force_row(const ForceTiming& timing, const BenchBody& body);

}  // namespace heml
