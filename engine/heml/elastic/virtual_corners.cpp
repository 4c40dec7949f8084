#include <algorithm>
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
    for (std::size_t t = begin; t < end; ++t) {
      Real at[10][3], out[16][3] = {};
      for (std::size_t a = 0; a < 10; ++a)
        for (std::size_t i = 0; i < 3; ++i)
          at[a][i] =
              x[3 * static_cast<std::size_t>(nodes_[t][a]) + i] - x[3 * static_cast<std::size_t>(nodes_[t][0]) + i];
#pragma GCC unroll 64
      for (const Product& p : products)
        for (std::size_t i = 0; i < 3; ++i) out[p.corner][i] += static_cast<Real>(p.weight) * at[p.node][i];
      std::copy_n(&out[0][0], 48, y.data() + 48 * t);
    }
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
    for (std::size_t t = begin; t < end; ++t) {
      const Real* corner = &h[3 * first_corner_[t]];
      Real out[10][3] = {};
#pragma GCC unroll 64
      for (const Product& p : products)
        for (std::size_t i = 0; i < 3; ++i) out[p.node][i] += static_cast<Real>(p.weight) * corner[3 * p.corner + i];
      std::copy_n(&out[0][0], 30, of_element.data() + 30 * t);
    }
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
