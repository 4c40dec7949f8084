#pragma once
// Times of the direct solver of static solves: the factor of a stiffness and a solution with it.
#include <studies/bench.hpp>
#include <studies/bench_bodies.hpp>

namespace heml {

/// Rows of suite `step`, ms, of a body at rest that is fixed at its face x = 0, in double: factor and solution,
/// interleaved, for small bodies also beside Eigen's simplicial factor.
std::vector<BenchRow> factor_rows(const BenchBody& body, bool quick);

}  // namespace heml
