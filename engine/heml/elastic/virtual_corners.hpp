#pragma once
// The map B from the nodes of quadratic tetrahedra to the virtual corners of their integration points
// (mesh/quadratic.hpp), and its transpose. A body of linear tetrahedra on the virtual corners (energy E, forces f,
// stiffness K) makes a body of quadratic ones: E(Bx), Bᵀf(Bx), BᵀKB.
#include <heml/base/thread_team.hpp>
#include <heml/elastic/element_group.hpp>
#include <heml/elastic/quadratic_map.hpp>
#include <heml/math/bytes.hpp>
#include <heml/mesh/quadratic.hpp>
#include <span>
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

  /// Bx, 3 a virtual corner, of each element relative to its first node: edges keep the digits that sums of whole
  /// coordinates would lose. x: 3 #V.
  void positions(const Real* x, std::vector<Real>& y, ThreadTeam& team) const;
  std::vector<Real> positions(const Real* x) const;
  /// Bᵀh of each element of a group, 3 a node of its, into of_element (30 #T); h: corner forces of all slots. Every
  /// element's points are consecutive slots of one group.
  void at_nodes(const ElementGroup<Real>& group, const std::vector<Real>& h, Real* of_element, ThreadTeam& team) const;
  /// Writes the sums of of_element at the nodes into f (3 #V), or adds them.
  void sum(const Real* of_element, Real* f, bool add, ThreadTeam& team) const;

  /// Lumped masses (#V, kg) that are positive: 1/36 of an element's on a corner, 4/27 on a mid-edge node (scaled from
  /// the diagonal of the consistent matrix: Hinton, Rock & Zienkiewicz 1976). element_mass: #T.
  std::vector<Real> lumped(const std::vector<double>& element_mass) const;
  /// ∫ρN (#V, kg), which gravity acts on. point_mass: 4 #T.
  std::vector<Real> consistent(const std::vector<double>& point_mass) const;

  /// Where a node is in the elements: 10 element + local node, ascending.
  std::span<const std::size_t> places_at(std::size_t node) const {
    return {places_.data() + start_[node], places_.data() + start_[node + 1]};
  }
  std::size_t nodes() const { return start_.size() - 1; }
  std::size_t elements() const { return nodes_.size(); }
  const QuadraticNodes& nodes_of(std::size_t element) const { return nodes_[element]; }
  std::size_t bytes() const { return bytes_of(nodes_, start_, places_); }

 private:
  std::vector<QuadraticNodes> nodes_;  ///< #T
  std::vector<std::size_t> start_;     ///< #V + 1
  std::vector<std::size_t> places_;    ///< 10 #T: of each node, 10 element + local node, ascending
};

}  // namespace heml
