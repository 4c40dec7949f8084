#include <algorithm>
#include <studies/counting_scalar.hpp>
#include <studies/mass_tensor.hpp>

namespace heml {
namespace {

/// ∇N of a tetrahedron's four nodes, 1/m, and its volume, m³.
struct Gradients {
  Vec3 g[4];
  double volume;
};

Gradients gradients_of(const TetMesh& mesh, const Tet& tet) {
  const auto node = [&](std::size_t a) { return mesh.nodes[static_cast<std::size_t>(tet[a])]; };
  Mat3 Dm;
  Dm << node(1) - node(0), node(2) - node(0), node(3) - node(0);
  const Mat3 inverse = Dm.inverse();
  Gradients result;
  for (int a = 1; a < 4; ++a) result.g[a] = inverse.row(a - 1);
  result.g[0] = -(result.g[1] + result.g[2] + result.g[3]);
  result.volume = Dm.determinant() / 6;
  return result;
}

/// The coefficients of one node p as dense arrays over its m neighbours, p included.
struct Tensors {
  std::size_t m;
  std::vector<Mat3> B;              ///< m
  std::vector<Vec3> C1;             ///< m², C_jkp
  std::vector<Vec3> C2;             ///< m², C_pjk
  std::vector<double> D;            ///< m³
  std::vector<char> shares_pair;    ///< m²: whether j and k share a tetrahedron with p
  std::vector<char> shares_triple;  ///< m³

  explicit Tensors(std::size_t neighbours)
      : m(neighbours),
        B(m, Mat3::Zero()),
        C1(m * m, Vec3::Zero()),
        C2(m * m, Vec3::Zero()),
        D(m * m * m, 0.0),
        shares_pair(m * m, 0),
        shares_triple(m * m * m, 0) {}

  /// Adds one tetrahedron. local: indices of its nodes among the neighbours. p: which of the four is the node.
  void add(const Gradients& at, const std::size_t local[4], std::size_t p, double lambda, double mu) {
    const Vec3* g = at.g;
    const double V = at.volume;
    const auto C = [&](std::size_t j, std::size_t k, std::size_t l) -> Vec3 {
      return V / 2 * (lambda * g[k].dot(g[l]) * g[j] + mu * g[j].dot(g[l]) * g[k] + mu * g[j].dot(g[k]) * g[l]);
    };
    for (std::size_t j = 0; j < 4; ++j) {
      B[local[j]] += V * (lambda * g[p] * g[j].transpose() + mu * g[p].dot(g[j]) * Mat3::Identity() +
                          mu * g[j] * g[p].transpose());
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t pair = local[j] * m + local[k];
        C1[pair] += C(j, k, p);
        C2[pair] += C(p, j, k);
        shares_pair[pair] = 1;
        for (std::size_t l = 0; l < 4; ++l) {
          D[pair * m + local[l]] += V / 8 *
                                    (lambda * g[j].dot(g[k]) * g[l].dot(g[p]) + mu * g[j].dot(g[l]) * g[k].dot(g[p]) +
                                     mu * g[k].dot(g[l]) * g[j].dot(g[p]));
          shares_triple[pair * m + local[l]] = 1;
        }
      }
    }
  }
};

}  // namespace

template <class Real>
MassTensor<Real>::MassTensor(const TetMesh& mesh, double lambda, double mu, MassTensorSums sums) {
  std::vector<std::vector<std::size_t>> tets_of(mesh.nodes.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    for (const int n : mesh.tets[t]) tets_of[static_cast<std::size_t>(n)].push_back(t);
  for (std::size_t p = 0; p < mesh.nodes.size(); ++p) {
    for (const double value : mesh.nodes[p]) rest_.push_back(static_cast<Real>(value));
    std::vector<int> around;
    for (const std::size_t t : tets_of[p]) around.insert(around.end(), mesh.tets[t].begin(), mesh.tets[t].end());
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    const std::size_t m = around.size();
    Tensors tensors(m);
    for (const std::size_t t : tets_of[p]) {
      const Tet& tet = mesh.tets[t];
      std::size_t local[4], self = 0;
      for (std::size_t a = 0; a < 4; ++a) {
        local[a] = static_cast<std::size_t>(std::lower_bound(around.begin(), around.end(), tet[a]) - around.begin());
        if (tet[a] == static_cast<int>(p)) self = a;
      }
      tensors.add(gradients_of(mesh, tet), local, self, lambda, mu);
    }
    const bool all = sums == MassTensorSums::as_printed;
    for (std::size_t j = 0; j < m; ++j) {
      Neighbour& neighbour = neighbour_.emplace_back();
      neighbour.node = around[j];
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) neighbour.B[r][c] = static_cast<Real>(tensors.B[j](r, c));
      for (std::size_t k = 0; k < m; ++k) {
        const std::size_t at = j * m + k;
        if (!all && !tensors.shares_pair[at]) continue;
        for (std::size_t l = 0; l < m; ++l)
          if (all || tensors.shares_triple[at * m + l])
            triple_.push_back({around[l], static_cast<Real>(4 * tensors.D[at * m + l])});
        Pair& pair = pair_.emplace_back();
        pair.j = around[j], pair.k = around[k], pair.last_triple = triple_.size();
        for (int i = 0; i < 3; ++i) {
          pair.twice_C[i] = static_cast<Real>(2 * tensors.C1[at][i]);
          pair.C[i] = static_cast<Real>(tensors.C2[at][i]);
        }
      }
    }
    node_.push_back({neighbour_.size(), pair_.size()});
  }
}

template <class Real>
template <bool linear>
void MassTensor<Real>::sum_forces(const Real* x, Real* f) const {
  std::vector<Real> displacement(rest_.size());
  for (std::size_t i = 0; i < rest_.size(); ++i) displacement[i] = x[i] - rest_[i];
  const auto U = [&](int node) { return &displacement[3 * static_cast<std::size_t>(node)]; };
  const auto dot = [](const Real* a, const Real* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  std::size_t neighbour = 0, pair = 0, triple = 0;
  for (std::size_t p = 0; p < node_.size(); ++p) {
    Real* force = f + 3 * p;
    for (int i = 0; i < 3; ++i) force[i] = Real(0);
    for (; neighbour < node_[p].last_neighbour; ++neighbour) {
      const Neighbour& at = neighbour_[neighbour];
      for (int i = 0; i < 3; ++i) force[i] -= dot(at.B[i], U(at.node));
    }
    if constexpr (linear) continue;
    for (; pair < node_[p].last_pair; ++pair) {
      const Pair& at = pair_[pair];
      const Real *Uj = U(at.j), *Uk = U(at.k);
      const Real along = dot(Uj, at.twice_C), both = dot(Uj, Uk);
      for (int i = 0; i < 3; ++i) force[i] -= Uk[i] * along + both * at.C[i];
      for (; triple < at.last_triple; ++triple) {
        const Real by = triple_[triple].four_D * both;
        const Real* Ul = U(triple_[triple].l);
        for (int i = 0; i < 3; ++i) force[i] -= by * Ul[i];
      }
    }
  }
}

template <class Real>
void MassTensor<Real>::forces(const Real* x, Real* f) const {
  sum_forces<false>(x, f);
}

template <class Real>
void MassTensor<Real>::linear_forces(const Real* x, Real* f) const {
  sum_forces<true>(x, f);
}

template <class Real>
std::size_t MassTensor<Real>::coefficients() const {
  return 9 * neighbour_.size() + 6 * pair_.size() + triple_.size();
}

template class MassTensor<float>;
template class MassTensor<double>;
template class MassTensor<CountingScalar>;

}  // namespace heml
