#include <algorithm>
#include <cmath>
#include <compare>
#include <heml/elastic/springs.hpp>

namespace heml {
namespace {
constexpr std::size_t grain = 2048;
}  // namespace

template <class Real>
Springs<Real>::Springs(const TetMesh& mesh, const std::vector<double>& stiffness) {
  // The distinct stiffnesses at each edge: the mean is over regions, not over elements. Likewise of scales of rest
  // shapes, of which one stiffness may have several.
  struct Edge {
    int a, b;
    double k, scale;
    auto operator<=>(const Edge&) const = default;
  };
  std::vector<Edge> edges;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (stiffness[t] == 0) continue;
    for (const auto& ends : tet_edges) {
      const int p = mesh.tets[t][ends[0]], q = mesh.tets[t][ends[1]];
      edges.push_back({std::min(p, q), std::max(p, q), stiffness[t], rest_scale(mesh, t)});
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  start_.assign(mesh.nodes.size() + 1, 0);
  for (auto first = edges.begin(); first != edges.end();) {
    const auto end =
        std::find_if(first, edges.end(), [&](const Edge& e) { return e.a != first->a || e.b != first->b; });
    const auto is_first_of_k = [&](const Edge& e) { return &e == &*first || e.k != (&e)[-1].k; };
    const auto count = static_cast<double>(std::count_if(first, end, is_first_of_k));
    double mean = 0, scales = 0;
    for (auto edge = first; edge != end; ++edge) {
      if (is_first_of_k(*edge)) mean += edge->k / count;
      scales += edge->scale;
    }
    const double scale = scales / static_cast<double>(end - first);
    const auto a = static_cast<std::size_t>(first->a), b = static_cast<std::size_t>(first->b);
    springs_.push_back({first->a, first->b, static_cast<Real>(mean),
                        static_cast<Real>(scale * (mesh.nodes[b] - mesh.nodes[a]).norm())});
    ++start_[a + 1];
    ++start_[b + 1];
    first = end;
  }
  for (std::size_t n = 0; n + 1 < start_.size(); ++n) start_[n + 1] += start_[n];
  of_node_.resize(start_.back());
  std::vector<std::size_t> fill(start_.begin(), start_.end() - 1);
  for (std::size_t s = 0; s < springs_.size(); ++s)
    for (const int n : {springs_[s].a, springs_[s].b}) of_node_[fill[static_cast<std::size_t>(n)]++] = s;
}

template <class Real>
void Springs<Real>::add_forces(const Real* x, Real* f, ThreadTeam& team) const {
  team.parallel_for(start_.size() - 1, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n)
      for (std::size_t k = start_[n]; k < start_[n + 1]; ++k) {
        const Spring& spring = springs_[of_node_[k]];
        const auto other = static_cast<std::size_t>(spring.a) == n ? spring.b : spring.a;
        const Real* p = x + 3 * n;
        const Real* q = x + 3 * other;
        const Real d[3] = {q[0] - p[0], q[1] - p[1], q[2] - p[2]};
        const Real length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        const Real tension = length > 0 ? spring.k * (1 - spring.length / length) : Real(0);
        for (std::size_t i = 0; i < 3; ++i) f[3 * n + i] += tension * d[i];
      }
  });
}

/// B = k d dᵀ/ℓ² + k (1 − L/ℓ) (I − d dᵀ/ℓ²).
template <class Real>
void Springs<Real>::block(const Spring& spring, const Real* x, bool positive, Real B[3][3]) const {
  Real d[3], square = 0;
  for (int i = 0; i < 3; ++i) {
    d[i] = x[3 * spring.b + i] - x[3 * spring.a + i];
    square += d[i] * d[i];
  }
  Real tension = square > 0 ? spring.k * (1 - spring.length / std::sqrt(square)) : Real(0);
  if (positive) tension = std::max(tension, Real(0));
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      B[i][j] = (i == j ? tension : Real(0)) + (square > 0 ? (spring.k - tension) * d[i] * d[j] / square : Real(0));
}

template <class Real>
void Springs<Real>::add_force_differential(const Real* x, const Real* dx, Real* out, bool positive,
                                           ThreadTeam& team) const {
  team.parallel_for(start_.size() - 1, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n)
      for (std::size_t k = start_[n]; k < start_[n + 1]; ++k) {
        const Spring& spring = springs_[of_node_[k]];
        const auto other = static_cast<std::size_t>(spring.a) == n ? spring.b : spring.a;
        Real B[3][3];
        block(spring, x, positive, B);
        for (std::size_t i = 0; i < 3; ++i)
          for (std::size_t j = 0; j < 3; ++j)
            out[3 * n + i] += B[i][j] * (dx[3 * static_cast<std::size_t>(other) + j] - dx[3 * n + j]);
      }
  });
}

template <class Real>
double Springs<Real>::energy(const Real* x) const {
  double sum = 0;
  for (const Spring& spring : springs_) {
    double square = 0;
    for (int i = 0; i < 3; ++i) {
      const double d = static_cast<double>(x[3 * spring.b + i]) - static_cast<double>(x[3 * spring.a + i]);
      square += d * d;
    }
    const double stretch = std::sqrt(square) - static_cast<double>(spring.length);
    sum += static_cast<double>(spring.k) / 2 * stretch * stretch;
  }
  return sum;
}

template <class Real>
Real Springs<Real>::frequency_bound(const std::vector<Real>& mass) const {
  Real largest = 0;
  for (std::size_t n = 0; n + 1 < start_.size(); ++n) {
    Real sum = 0;
    for (std::size_t k = start_[n]; k < start_[n + 1]; ++k) sum += springs_[of_node_[k]].k;
    if (sum > 0) largest = std::max(largest, 2 * sum / mass[n]);
  }
  return largest;
}

template class Springs<float>;
template class Springs<double>;

}  // namespace heml
