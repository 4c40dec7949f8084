#pragma once
// What a machine can do at most: arithmetic in registers, and streams of memory.
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

/// What this processor has, in all.
std::vector<PeakLoop> peak_loops();

/// a = b + s c over three arrays of `bytes` in all, shared out among a team; each thread goes `turns` times over its
/// own part.
class Triad {
 public:
  explicit Triad(std::size_t bytes);
  void run(ThreadTeam& team, long turns);
  double bytes() const { return 24.0 * static_cast<double>(a_.size()); }  ///< read and written in one turn

 private:
  std::vector<double> a_, b_, c_;
};

}  // namespace heml
