#pragma once
// Times of quadratic elements beside linear ones on the same nodes, eight for one.
#include <studies/bench.hpp>

namespace heml {

/// Rows of suite `step`, ms, of a regular cube of n cells a side whose tetrahedra are quadratic, interleaved with those
/// of its subdivision: an evaluation of forces, a step of Verlet, a step of backward Euler of one Newton iteration. In
/// double.
std::vector<BenchRow> element_rows(int n, bool quick);

}  // namespace heml
