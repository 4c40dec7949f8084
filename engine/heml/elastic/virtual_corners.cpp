#include <algorithm>
#include <heml/elastic/avx2_dispatch.hpp>
#include <heml/elastic/quadratic_map.hpp>
#include <heml/elastic/virtual_corners.hpp>

namespace heml {
namespace {

constexpr std::size_t element_grain = 512, gather_grain = 600;

/// Bx of elements [begin, end).
template <class Real>
[[gnu::always_inline]] inline void corners_of_nodes(const QuadraticNodes* nodes, const Real* x, std::size_t begin,
                                                    std::size_t end, Real* y) {
  for (std::size_t t = begin; t < end; ++t) {
    Four<Real> corners[16];
    read_virtual_corners(nodes[t], x, corners);
    write_threes(corners, y + 48 * t);
  }
}

/// Bᵀh of the elements in slots 4 [begin, end) of a group, 3 a node of theirs.
template <class Real>
[[gnu::always_inline]] inline void nodes_of_corners(const ElementGroup<Real>& group, const Real* h, std::size_t begin,
                                                    std::size_t end, Real* of_element) {
  for (std::size_t k = begin; k < end; ++k) {
    const Real* from = h + 3 * (group.first_corner + 16 * k);
    Four<Real> corners[16];
#pragma GCC unroll 16
    for (std::size_t c = 0; c < 16; ++c) corners[c] = read_three(from + 3 * c);
    write_nodes(corners, of_element + 30 * element_at(group, 4 * k));
  }
}

template <class Real>
HEML_WIDE void wide_corners_of_nodes(const QuadraticNodes* nodes, const Real* x, std::size_t begin, std::size_t end,
                                     Real* y) {
  corners_of_nodes(nodes, x, begin, end, y);
}

template <class Real>
HEML_WIDE void wide_nodes_of_corners(const ElementGroup<Real>& group, const Real* h, std::size_t begin, std::size_t end,
                                     Real* of_element) {
  nodes_of_corners(group, h, begin, end, of_element);
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
void VirtualCorners<Real>::at_nodes(const ElementGroup<Real>& group, const std::vector<Real>& h, Real* of_element,
                                    ThreadTeam& team) const {
  team.parallel_for(group.size() / element_points, element_grain, [&](std::size_t begin, std::size_t end) {
    (has_avx2() ? wide_nodes_of_corners<Real> : nodes_of_corners<Real>)(group, h.data(), begin, end, of_element);
  });
}

template <class Real>
void VirtualCorners<Real>::sum(const Real* of_element, Real* f, bool add, ThreadTeam& team) const {
  team.parallel_for(nodes(), gather_grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      Real sum[3] = {0, 0, 0};
      for (std::size_t k = start_[n]; k < start_[n + 1]; ++k)
        for (std::size_t i = 0; i < 3; ++i) sum[i] += of_element[3 * places_[k] + i];
      for (std::size_t i = 0; i < 3; ++i) f[3 * n + i] = add ? f[3 * n + i] + sum[i] : sum[i];
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
