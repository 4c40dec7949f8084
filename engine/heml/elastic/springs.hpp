#pragma once
// The degenerate case of HEML: a mass-spring net. Every edge of the mesh is one spring of energy k/2 (ℓ − L)². Its
// tension per length k (1 − L/ℓ) depends on its own length alone. An edge shared by regions has the mean k.
//
//   spring e:  node[2] k L          of node n: springs[start[n] .. start[n+1]), ascending, so sums have a fixed order
#include <heml/base/thread_team.hpp>
#include <heml/math/bytes.hpp>
#include <heml/mesh/tet_mesh.hpp>
#include <vector>

namespace heml {

template <class Real>
class Springs {
 public:
  Springs() = default;  ///< none
  /// stiffness: #T, N/m; 0 where an element has no springs.
  Springs(const TetMesh& mesh, const std::vector<double>& stiffness);
  bool operator==(const Springs&) const = default;

  bool empty() const { return springs_.empty(); }
  std::size_t size() const { return springs_.size(); }
  std::size_t bytes() const { return bytes_of(springs_, start_, of_node_); }
  /// Adds forces (N) to f; adds −K dx (N) to out; both 3 #V. positive: without the negative stiffness of compressed
  /// springs.
  void add_forces(const Real* x, Real* f, ThreadTeam& team) const;
  void add_force_differential(const Real* x, const Real* dx, Real* out, bool positive, ThreadTeam& team) const;
  double energy(const Real* x) const;  ///< J
  /// Upper bound of λ_max(M⁻¹K), 1/s², at any length: max_n 2 Σ k / m_n. mass: #V, kg.
  Real frequency_bound(const std::vector<Real>& mass) const;

  /// Calls visit(node a, node b, 3×3 block B) for every spring: its stiffness is [B −B; −B B].
  template <class Visit>
  void each_stiffness(const Real* x, bool positive, const Visit& visit) const {
    for (const Spring& spring : springs_) {
      Real B[3][3];
      block(spring, x, positive, B);
      visit(spring.a, spring.b, B);
    }
  }

 private:
  struct Spring {
    int a, b;
    Real k, length;
    bool operator==(const Spring&) const = default;
  };
  void block(const Spring& spring, const Real* x, bool positive, Real B[3][3]) const;

  std::vector<Spring> springs_;
  std::vector<std::size_t> start_ = {0}, of_node_;
};

}  // namespace heml
