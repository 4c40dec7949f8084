#pragma once
// The map B of one quadratic tetrahedron from its ten nodes to the virtual corners of its four integration points
// (mesh/quadratic.hpp), and its transpose, in registers.
#include <array>
#include <heml/elastic/element_group.hpp>
#include <heml/elastic/four.hpp>
#include <heml/mesh/quadratic.hpp>

namespace heml {

using QuadraticNodes = std::array<int, 10>;  ///< as quadratic_nodes()

/// Positions of the virtual corners, [point][corner], relative to the element's first node: edges keep the digits that
/// sums of whole coordinates would lose. x: 3 #V.
template <class Real>
[[gnu::always_inline]] inline void read_virtual_corners(const QuadraticNodes& nodes, const Real* x,
                                                        Four<Real> (&corners)[16]) {
  constexpr Real of_corner = corner_weight, of_midedge = midedge_weight, own = own_weight;
  Four<Real> at[10];
  const auto place = [&](std::size_t a) { return read_three(x + 3 * static_cast<std::size_t>(nodes[a])); };
  const Four<Real> first = place(0);
#pragma GCC unroll 16
  for (std::size_t a = 0; a < 10; ++a) at[a] = place(a) - first;
#pragma GCC unroll 4
  for (std::size_t i = 0; i < 4; ++i) {
    Four<Real> midedges = {};
#pragma GCC unroll 4
    for (std::size_t j = 0; j < 4; ++j)
      if (j != i) midedges += at[node_between[i][j]];
    const Four<Real> shared = of_corner * at[i] + of_midedge * midedges;
#pragma GCC unroll 4
    for (std::size_t q = 0; q < 4; ++q) corners[4 * q + i] = shared + own * at[node_between[q][i]];
  }
}

/// Writes 3 count values, and nothing behind them.
template <std::size_t count, class Real>
[[gnu::always_inline]] inline void write_threes(const Four<Real> (&values)[count], Real* to) {
#pragma GCC unroll 16
  for (std::size_t k = 0; k + 1 < count; ++k) write_four(values[k], to + 3 * k);
  for (std::size_t i = 0; i < 3; ++i) to[3 * (count - 1) + i] = values[count - 1][i];
}

/// The transpose: what [point][corner] is at the ten nodes, 3 each, into to (30).
template <class Real>
[[gnu::always_inline]] inline void write_nodes(const Four<Real> (&corners)[16], Real* to) {
  constexpr Real of_corner = corner_weight, of_midedge = midedge_weight, own = own_weight;
  Four<Real> sum[4], out[10];
#pragma GCC unroll 4
  for (std::size_t i = 0; i < 4; ++i) {
    sum[i] = (corners[i] + corners[4 + i]) + (corners[8 + i] + corners[12 + i]);
    out[i] = of_corner * sum[i] + own * corners[5 * i];
  }
#pragma GCC unroll 4
  for (std::size_t i = 0; i < 4; ++i)
#pragma GCC unroll 4
    for (std::size_t j = i + 1; j < 4; ++j)
      out[node_between[i][j]] = of_midedge * (sum[i] + sum[j]) + own * (corners[4 * j + i] + corners[4 * i + j]);
  write_threes(out, to);
}

/// The quadratic element of which a slot is a point.
template <class Real>
[[gnu::always_inline]] inline std::size_t element_at(const ElementGroup<Real>& group, std::size_t slot) {
  return static_cast<std::size_t>(group.element[slot]) / element_points;
}

}  // namespace heml
