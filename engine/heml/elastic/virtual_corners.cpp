#include <algorithm>
#include <heml/elastic/avx2_dispatch.hpp>
#include <heml/elastic/four.hpp>
#include <heml/elastic/virtual_corners.hpp>

namespace heml {
namespace {

constexpr std::size_t element_grain = 512, gather_grain = 1024;

/// Node and weight of all 64 products of an element, unrolled by the compiler.
struct Product {
  std::size_t corner, node;
  double weight;
};
constexpr std::array<Product, 64> products = [] {
  std::array<Product, 64> all{};
  for (std::size_t q = 0; q < 4; ++q)
    for (std::size_t i = 0; i < 4; ++i) {
      const auto nodes = virtual_corner(q, i);
      for (std::size_t k = 0; k < 4; ++k) all[16 * q + 4 * i + k] = {4 * q + i, nodes[k].node, nodes[k].weight};
    }
  return all;
}();

/// Writes 3 count values, and nothing behind them.
template <std::size_t count, class Real>
[[gnu::always_inline]] inline void write_threes(const Four<Real> (&values)[count], Real* to) {
#pragma GCC unroll 16
  for (std::size_t k = 0; k + 1 < count; ++k) write_four(values[k], to + 3 * k);
  for (std::size_t i = 0; i < 3; ++i) to[3 * (count - 1) + i] = values[count - 1][i];
}

/// Bx of elements [begin, end).
template <class Real>
[[gnu::always_inline]] inline void corners_of_nodes(const std::array<int, 10>* nodes, const Real* x, std::size_t begin,
                                                    std::size_t end, Real* y) {
  using V = Four<Real>;
  for (std::size_t t = begin; t < end; ++t) {
    V at[10], out[16];
    const auto place = [&](std::size_t a) { return read_three(x + 3 * static_cast<std::size_t>(nodes[t][a])); };
    const V first = place(0);
#pragma GCC unroll 16
    for (std::size_t a = 0; a < 10; ++a) at[a] = place(a) - first;
#pragma GCC unroll 16
    for (V& corner : out) corner = V{};
#pragma GCC unroll 64
    for (const Product& p : products) out[p.corner] += static_cast<Real>(p.weight) * at[p.node];
    write_threes(out, y + 48 * t);
  }
}

/// Bᵀh of elements [begin, end), 3 a node of theirs.
template <class Real>
[[gnu::always_inline]] inline void nodes_of_corners(const std::size_t* first_corner, const Real* h, std::size_t begin,
                                                    std::size_t end, Real* of_element) {
  using V = Four<Real>;
  for (std::size_t t = begin; t < end; ++t) {
    V at[16], out[10];
#pragma GCC unroll 16
    for (std::size_t c = 0; c < 16; ++c) at[c] = read_three(h + 3 * (first_corner[t] + c));
#pragma GCC unroll 16
    for (V& node : out) node = V{};
#pragma GCC unroll 64
    for (const Product& p : products) out[p.node] += static_cast<Real>(p.weight) * at[p.corner];
    write_threes(out, of_element + 30 * t);
  }
}

template <class Real>
HEML_WIDE void wide_corners_of_nodes(const std::array<int, 10>* nodes, const Real* x, std::size_t begin,
                                     std::size_t end, Real* y) {
  corners_of_nodes(nodes, x, begin, end, y);
}

template <class Real>
HEML_WIDE void wide_nodes_of_corners(const std::size_t* first_corner, const Real* h, std::size_t begin, std::size_t end,
                                     Real* of_element) {
  nodes_of_corners(first_corner, h, begin, end, of_element);
}

}  // namespace

template <class Real>
VirtualCorners<Real>::VirtualCorners(const TetMesh& mesh, const MidEdges& midedges) {
  start_.assign(mesh.nodes.size() + 1, 0);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    nodes_.push_back(quadratic_nodes(mesh.tets[t], midedges[t]));
    for (const int n : nodes_.back()) ++start_[static_cast<std::size_t>(n) + 1];
  }
  for (std::size_t n = 1; n < start_.size(); ++n) start_[n] += start_[n - 1];
  places_.resize(start_.back());
  std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
  for (std::size_t t = 0; t < nodes_.size(); ++t)
    for (std::size_t a = 0; a < 10; ++a) places_[next[static_cast<std::size_t>(nodes_[t][a])]++] = 10 * t + a;
}

template <class Real>
void VirtualCorners<Real>::follow(const std::vector<const ElementGroup<Real>*>& groups) {
  first_corner_.assign(nodes_.size(), 0);
  for (const auto* group : groups)
    for (std::size_t s = 0; s < group->size(); s += element_points)
      first_corner_[static_cast<std::size_t>(group->element[s]) / element_points] = group->first_corner + 4 * s;
}

template <class Real>
void VirtualCorners<Real>::positions(const Real* x, std::vector<Real>& y, ThreadTeam& team) const {
  y.resize(48 * nodes_.size());
  team.parallel_for(nodes_.size(), element_grain, [&](std::size_t begin, std::size_t end) {
    (has_avx2() ? wide_corners_of_nodes<Real> : corners_of_nodes<Real>)(nodes_.data(), x, begin, end, y.data());
  });
}

template <class Real>
std::vector<Real> VirtualCorners<Real>::positions(const Real* x) const {
  ThreadTeam alone(1);
  std::vector<Real> y;
  positions(x, y, alone);
  return y;
}

template <class Real>
void VirtualCorners<Real>::gather(const std::vector<Real>& h, std::vector<Real>& of_element, Real* f,
                                  ThreadTeam& team) const {
  of_element.resize(30 * nodes_.size());  // N
  team.parallel_for(nodes_.size(), element_grain, [&](std::size_t begin, std::size_t end) {
    (has_avx2() ? wide_nodes_of_corners<Real> : nodes_of_corners<Real>)(first_corner_.data(), h.data(), begin, end,
                                                                        of_element.data());
  });
  team.parallel_for(nodes(), gather_grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      Real sum[3] = {0, 0, 0};
      for (std::size_t k = start_[n]; k < start_[n + 1]; ++k)
        for (std::size_t i = 0; i < 3; ++i) sum[i] += of_element[3 * places_[k] + i];
      for (std::size_t i = 0; i < 3; ++i) f[3 * n + i] = sum[i];
    }
  });
}

template <class Real>
std::vector<Real> VirtualCorners<Real>::lumped(const std::vector<double>& element_mass) const {
  std::vector<double> mass(nodes(), 0.0);
  for (std::size_t t = 0; t < nodes_.size(); ++t)
    for (std::size_t a = 0; a < 10; ++a)
      mass[static_cast<std::size_t>(nodes_[t][a])] += element_mass[t] * (a < 4 ? 1.0 / 36 : 4.0 / 27);
  return {mass.begin(), mass.end()};
}

template <class Real>
std::vector<Real> VirtualCorners<Real>::consistent(const std::vector<double>& point_mass) const {
  std::vector<double> mass(nodes(), 0.0);
  for (std::size_t t = 0; t < nodes_.size(); ++t)
    for (std::size_t q = 0; q < element_points; ++q) {
      const std::array<double, 10> N = shape_functions(point_place(q));
      for (std::size_t a = 0; a < 10; ++a)
        mass[static_cast<std::size_t>(nodes_[t][a])] += N[a] * point_mass[element_points * t + q];
    }
  return {mass.begin(), mass.end()};
}

template class VirtualCorners<float>;
template class VirtualCorners<double>;

}  // namespace heml
