#pragma once
// Averaged nodal pressure against locking (Bonet & Burton 1998; Joldes, Wittek & Miller 2009): the volume term is
// evaluated at the mean volume ratio round each node, the isochoric part per tetrahedron.
//     J̄_a = Σ V_t J_t / ΣV_t,  E = Σ_a V_a κ_a ψ(J̄_a),  V_a = ΣV_t/4,  κ_a = ΣV_t κ_t / ΣV_t  (t: the elements at a)
//     p_a = κ_a ψ'(J̄_a),  f = −Σ_t V_t p_t ∇J_t,  p_t = ¼ Σ_a p_a: the exact gradient of E.
//
//   per slot:  V_t J_t, then summed at nodes in ascending order of corner
#include <heml/base/thread_team.hpp>
#include <heml/elastic/group_loops.hpp>
#include <heml/math/bytes.hpp>
#include <span>
#include <vector>

namespace heml {

template <class Real>
class NodalPressure {
 public:
  /// kappa: Pa, one per slot (padded) of each group. All groups have the same volume term. groups and corners must
  /// outlive this.
  NodalPressure(std::vector<const ElementGroup<Real>*> groups, const CornerMap& corners,
                const std::vector<std::vector<Real>>& kappa, VolumeTerm term, bool continuation);

  /// Adds the forces at x (N) to the corner forces of all groups (3 a corner). Returns whether ψ is defined at every
  /// node.
  bool add_forces(const Real* x, Real* corner, ThreadTeam& team);

  /// The pressures of the nodes (#V, Pa), valid until the next evaluation, at sums of V_t J_t at each node (#V, m³).
  const Real* at_volumes(const std::vector<Real>& sums, ThreadTeam& team);
  /// Whether ψ is defined at every node of the last evaluation.
  bool is_defined() const;

  /// Evaluates volume ratios and pressures at x for the calls below, until the next linearise(). Other evaluations
  /// between leave them.
  void linearise(const Real* x, ThreadTeam& team);
  /// To be called after it for packets [begin, end) of each group: evaluates V_t ∇J_t, and adds p_t V_t ∇²J_t to the
  /// stiffness of every slot (elastic/edge_stiffness.hpp). Threads: any, on disjoint ranges.
  void linearise_group(std::size_t group, const Real* x, std::size_t begin, std::size_t end, Real* K);
  /// Adds −Σ_a κ_a ψ''/(4 ΣV_t) g_a g_aᵀ dx (N) to the corner forces, g_a = Σ V_t ∇J_t.
  void add_force_differential(const Real* dx, Real* corner, ThreadTeam& team);
  /// Adds an approximation of that stiffness of one slot for preconditioners, without coupling to other elements; κ ψ''
  /// is averaged over its nodes.
  void add_stiffness(std::size_t group, std::size_t s, Real K[edge_entries]) const;
  /// p_t of a slot at the point of linearise(), Pa.
  Real pressure(std::size_t group, std::size_t s) const { return pressure(linear_, group, s); }

  double energy(const Real* x);  ///< J
  /// Evaluates volume ratios and pressures at x for add_frequency_bounds(), valid until the next evaluation.
  void begin_bounds(const Real* x, ThreadTeam& team);
  /// Adds to bounds (8 a packet) for packets [begin, end) of a group how far these terms raise those of its elements,
  /// 1/s²: K ≤ Σ b_t M_t. weights: as GroupTerm::frequency_bounds(). Threads: any, on disjoint ranges.
  void add_frequency_bounds(std::size_t group, const Real* weights, const Real* x, std::size_t begin, std::size_t end,
                            Real* bounds) const;
  std::size_t bytes() const {
    return bytes_of(kappa_, node_volume_, node_kappa_, last_.ratio, last_.pressure, linear_.ratio, linear_.pressure,
                    of_corner_, stiffness_, gradient_, node_stiffness_);
  }

 private:
  struct NodeValues {
    std::vector<Real> ratio, pressure;  ///< #V: J̄_a; p_a
  };
  VolumeDerivatives<Real> psi(Real J) const;  ///< ψ
  void average(const Real* x, NodeValues& values, ThreadTeam& team);
  void evaluate(NodeValues& values, ThreadTeam& team) const;
  Real pressure(const NodeValues& values, std::size_t group, std::size_t s) const;  ///< mean p_t of a slot, Pa
  template <class OfSlot>
  void gather(std::vector<Real>& node_sums, ThreadTeam& team, const OfSlot& of_slot);

  std::vector<const ElementGroup<Real>*> groups_;
  const CornerMap& corners_;
  std::vector<std::vector<Real>> kappa_;
  VolumeTerm term_;
  bool continuation_;
  std::vector<Real> node_volume_, node_kappa_;  ///< #V: ΣV_t; κ_a
  NodeValues last_;                             ///< at the x of the last evaluation, scratch
  NodeValues linear_;                           ///< at the point of linearise()
  std::vector<std::vector<Real>> gradient_;     ///< there, V ∂J/∂e of each group: [packet][9][lanes], m²
  std::vector<Real> node_stiffness_;            ///< there, #V: κ_a ψ''
  std::vector<Real> of_corner_;                 ///< one a slot, scratch
  std::vector<Real> stiffness_;                 ///< #V, κ ψ'' of begin_bounds(), scratch
};

}  // namespace heml
