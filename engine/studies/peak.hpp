#pragma once
// Peak performance of a machine: arithmetic in registers, and memory bandwidth.
#include <cstddef>
#include <functional>
#include <heml/base/thread_team.hpp>
#include <string>
#include <vector>

namespace heml {

/// Multiplications and additions in registers, as wide as an instruction set allows and fused where it can.
struct PeakLoop {
  std::string isa, precision;  ///< "portable", "avx2", "avx512"; "float", "double"
  void (*run)(long turns);
  double operations_per_turn;
};

/// The loops that this processor can run, in both precisions.
std::vector<PeakLoop> peak_loops();

/// STREAM triad a = b + s c over three arrays of `bytes` in total, split among a team; each thread passes `turns` times
/// over its own part.
class Triad {
 public:
  explicit Triad(std::size_t bytes);
  void run(ThreadTeam& team, long turns);
  double bytes() const { return 24.0 * static_cast<double>(a_.size()); }  ///< read and written in one turn

 private:
  std::vector<double> a_, b_, c_;
};

}  // namespace heml
