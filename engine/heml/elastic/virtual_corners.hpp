#pragma once
// The map B from the nodes of quadratic tetrahedra to the virtual corners of their integration points
// (mesh/quadratic.hpp), and its transpose. A body of linear tetrahedra on the virtual corners (energy E, forces f,
// stiffness K) makes a body of quadratic ones: E(Bx), Bᵀf(Bx), BᵀKB.
#include <heml/base/thread_team.hpp>
#include <heml/elastic/element_group.hpp>
#include <heml/math/bytes.hpp>
#include <heml/mesh/quadratic.hpp>
#include <vector>

namespace heml {

/// λ_max(M⁻¹ Σ_q BᵀPB M_q): how far the highest frequency of an element with lumped masses may exceed that of its
/// integration points as linear tetrahedra, squared. P takes out the mean, which is not strained. It is the same for
/// all shapes.
inline constexpr double frequency_ratio = 2.5547918;

template <class Real>
class VirtualCorners {
 public:
  VirtualCorners(const TetMesh& mesh, const MidEdges& midedges);

  /// Says where the corner forces of the elements are: after map_corners(). Every element's points are consecutive
  /// slots of one group.
  void follow(const std::vector<const ElementGroup<Real>*>& groups);

  /// Bx, 3 a virtual corner, of each element relative to its first node: edges keep the digits that sums of whole
  /// coordinates would lose. x: 3 #V.
  void positions(const Real* x, std::vector<Real>& y, ThreadTeam& team) const;
  std::vector<Real> positions(const Real* x) const;
  /// Writes Bᵀh into f (3 #V); h: corner forces of all slots; of_element: scratch.
  void gather(const std::vector<Real>& h, std::vector<Real>& of_element, Real* f, ThreadTeam& team) const;

  /// Lumped masses (#V, kg) that are positive: 1/36 of an element's on a corner, 4/27 on a mid-edge node (scaled from
  /// the diagonal of the consistent matrix: Hinton, Rock & Zienkiewicz 1976). element_mass: #T.
  std::vector<Real> lumped(const std::vector<double>& element_mass) const;
  /// ∫ρN (#V, kg), which gravity acts on. point_mass: 4 #T.
  std::vector<Real> consistent(const std::vector<double>& point_mass) const;

  std::size_t nodes() const { return start_.size() - 1; }
  std::size_t elements() const { return nodes_.size(); }
  const std::array<int, 10>& nodes_of(std::size_t element) const { return nodes_[element]; }
  std::size_t bytes() const { return bytes_of(nodes_, start_, places_, first_corner_); }

 private:
  std::vector<std::array<int, 10>> nodes_;  ///< #T
  std::vector<std::size_t> start_;          ///< #V + 1
  std::vector<std::size_t> places_;         ///< 10 #T: of each node, 10 element + local node, ascending
  std::vector<std::size_t> first_corner_;   ///< #T
};

}  // namespace heml
