#pragma once
// The 3×3 blocks K_ab of the stiffness between two nodes of an element, in float, from stiffnesses with respect to
// edges (edge_stiffness.hpp): of four linear elements side by side, and of a quadratic one with its four integration
// points side by side.
#include <array>
#include <heml/elastic/edge_stiffness.hpp>
#include <heml/elastic/element_group.hpp>
#include <heml/elastic/four.hpp>
#include <heml/mesh/quadratic.hpp>

namespace heml {

inline constexpr int side_by_side = 4;  ///< elements added together

template <class Real>
[[gnu::always_inline]] inline Four<float> read_as_float(const Real* from) {
  return __builtin_convertvector(read_four(from), Four<float>);
}

/// Calls put(pair, j, columns) with column j of K_ab of each of four linear elements. k: their stiffness.
template <class Real>
[[gnu::always_inline]] inline void each_column(const Real* k, const auto& put) {
  constexpr std::size_t packet = ElementGroup<Real>::lanes;
  const auto put_column = [&](std::size_t pair, int j, const Four<float>(&xyz)[3]) {
    Four<float> column[side_by_side] = {xyz[0], xyz[1], xyz[2], {}};
    transpose(column);
    put(pair, j, column);
  };
  std::size_t pair = 0;
#pragma GCC unroll 3
  for (std::size_t b = 1; b < 4; ++b) {
#pragma GCC unroll 3
    for (int j = 0; j < 3; ++j) {
      Four<float> of_corner_0[3] = {};  // minus the sum of the others, since corner 0 moves all edges back
#pragma GCC unroll 3
      for (std::size_t a = 1; a < 4; ++a) {
        Four<float> xyz[3];
        for (int i = 0; i < 3; ++i) {
          const int entry = edge_entry(3 * static_cast<int>(a - 1) + i, 3 * static_cast<int>(b - 1) + j);
          xyz[i] = read_as_float(k + packet * static_cast<std::size_t>(entry));
          of_corner_0[i] -= xyz[i];
        }
        if (a < b) put_column(pair + a, j, xyz);
      }
      put_column(pair, j, of_corner_0);
    }
    pair += b;
  }
}

/// The virtual corners that a node of a quadratic element has a weight in, and its weight at each point.
struct NodeWeights {
  struct OfCorner {
    std::size_t corner = 0;
    float at_point[element_points] = {};
  };
  std::size_t corners = 0;
  OfCorner weight[2];
};
inline constexpr std::array<NodeWeights, 10> node_weights = [] {
  std::array<NodeWeights, 10> result{};
  for (std::size_t corner = 0; corner < 4; ++corner)
    for (std::size_t k = 0; k < 4; ++k) {
      NodeWeights& node = result[virtual_corner(0, corner)[k].node];  // the same nodes at every point
      NodeWeights::OfCorner& of_corner = node.weight[node.corners++];
      of_corner.corner = corner;
      for (std::size_t q = 0; q < element_points; ++q)
        of_corner.at_point[q] = static_cast<float>(virtual_corner(q, corner)[k].weight);
    }
  return result;
}();

/// K_cd of the virtual corners at four points, [c][d][column][row]. k: their edge stiffness.
template <class Real>
[[gnu::always_inline]] inline void expand_corners(const Real* k, Four<float> (&out)[4][4][3][3]) {
  constexpr std::size_t packet = ElementGroup<Real>::lanes;
  for (std::size_t j = 0; j < 3; ++j)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t d = 1; d < 4; ++d) {
        out[0][d][j][i] = Four<float>{};  // minus the sum of the others, since corner 0 moves all edges back
        for (std::size_t c = 1; c < 4; ++c) {
          const int entry = edge_entry(static_cast<int>(3 * (c - 1) + i), static_cast<int>(3 * (d - 1) + j));
          out[c][d][j][i] = read_as_float(k + packet * static_cast<std::size_t>(entry));
          out[0][d][j][i] -= out[c][d][j][i];
        }
      }
  for (std::size_t j = 0; j < 3; ++j)
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t c = 1; c < 4; ++c) out[c][0][j][i] = out[0][c][i][j];
      out[0][0][j][i] = -(out[0][1][j][i] + out[0][2][j][i] + out[0][3][j][i]);
    }
}

/// Columns of K_ab = Σ_cd w_ac w_bd K_cd over the virtual corners c, d that nodes a, b have a weight in, summed over
/// the points.
[[gnu::always_inline]] inline void find_quadratic_block(const Four<float> (&of_corners)[4][4][3][3], std::size_t a,
                                                        std::size_t b, Four<float> (&columns)[3]) {
  Four<float> sum[3][4] = {};
  for (std::size_t i = 0; i < node_weights[a].corners; ++i)
    for (std::size_t k = 0; k < node_weights[b].corners; ++k) {
      const auto& [c, of_a] = node_weights[a].weight[i];
      const auto& [d, of_b] = node_weights[b].weight[k];
      const Four<float> weight = read_four(of_a) * read_four(of_b);
#pragma GCC unroll 3
      for (std::size_t j = 0; j < 3; ++j)
#pragma GCC unroll 3
        for (std::size_t m = 0; m < 3; ++m) sum[j][m] += weight * of_corners[c][d][j][m];
    }
#pragma GCC unroll 3
  for (std::size_t j = 0; j < 3; ++j) {
    transpose(sum[j]);
    columns[j] = (sum[j][0] + sum[j][1]) + (sum[j][2] + sum[j][3]);
  }
}

}  // namespace heml
