#pragma once
// One energy term of a group of elements, type-erased. A material is a list of terms: its law; a volume term that
// replaces the law's own; viscosity and relaxation; active stress.
//
// A loop over packets is one virtual call. Terms of uniform laws override the loops with the vectorised ones of
// group_loops.hpp. The default loops call the functions of one slot, which also serve parameters that vary by element
// and internal state.
#include <algorithm>
#include <heml/elastic/deviatoric_stress.hpp>
#include <heml/elastic/group_loops.hpp>
#include <heml/elastic/slot_state.hpp>
#include <heml/elastic/subelement_map.hpp>
#include <heml/materials/material.hpp>
#include <memory>
#include <vector>

namespace heml {

/// Sum over terms of S = 2 ∂W/∂C in the rest frame of the Cholesky factor of A (elastic/tension.hpp), and of wJ, Pa.
template <class Real>
struct StressSum {
  Real S[6] = {0, 0, 0, 0, 0, 0}, wJ = 0;

  /// S = L⁻¹ T L⁻ᵀ / V.
  void add(const Tensions<Real>& t, const RestShape<Real>& rest);
};

template <class Real>
class GroupTerm {
 public:
  using Group = ElementGroup<Real>;
  virtual ~GroupTerm() = default;

  // One slot; kinematics from full_element_kinematics().
  virtual Tensions<Real> tensions(const Group& group, std::size_t s, const ElementKinematics<Real>& kinematics,
                                  const RestShape<Real>& rest) const = 0;
  virtual Tensions<Real> tension_differential(const Group& group, std::size_t s,
                                              const ElementKinematics<Real>& kinematics, const RestShape<Real>& rest,
                                              const KinematicsDifferential<Real>& change) const = 0;
  /// Upper bound of λ_max(M_t⁻¹K_t), 1/s² (step_bound.hpp).
  virtual Real slot_frequency_bound(const Group& group, std::size_t s, const ElementKinematics<Real>& kinematics,
                                    const RestShape<Real>& rest, const CornerWeights<Real>& weights) const = 0;
  /// V W, J.
  virtual double energy(const Group& group, std::size_t s, const ElementKinematics<Real>& kinematics,
                        const RestShape<Real>& rest) const = 0;
  /// Whether energy() is stored elastic energy, not the incremental potential of viscosity and relaxation.
  virtual bool stores() const { return true; }
  virtual bool valid(const Group& group, std::size_t s, const ElementKinematics<Real>& kinematics) const = 0;
  /// At eigenvalues c of C. Only plasticity asks; 0 but for the laws that it is for.
  virtual DeviatoricStress<Real> deviatoric_stress(const Group&, std::size_t, const Real[3], Real) const { return {}; }

  // Packets [begin, end). Threads may call these on disjoint ranges.
  /// Corner forces into corner (3 reals a corner), overwritten or added to. Returns whether the term is defined in all.
  /// Asked of what kernels of fans and points do not run.
  virtual bool forces(const Group& group, const Real* x, std::size_t begin, std::size_t end, Real* corner,
                      bool add) const;
  /// See group_stiffness().
  virtual void stiffness(const Group& group, const Real* x, std::size_t begin, std::size_t end, Real scale, Real* K,
                         bool add) const;
  /// Sums of scale · energy() over each packet into of_packet (#packets), overwritten or added to.
  virtual void energies(const Group& group, const Real* x, std::size_t begin, std::size_t end, double scale,
                        double* of_packet, bool add) const;
  /// Writes slot_frequency_bound() of the slots into bounds (8 a packet), or adds it. weights: w of the nodes; null: 1.
  virtual void frequency_bounds(const Group& group, const Real* weights, const Real* x, std::size_t begin,
                                std::size_t end, Real* bounds, bool add) const;
  /// Writes tensions() of the slots into of_packets: [packet][T, wJ][lanes], 7 lists a packet.
  virtual void packet_tensions(const Group& group, const Real* x, std::size_t begin, std::size_t end,
                               Real* of_packets) const;
  /// Writes an upper bound of the von Mises stress of deviatoric_stress() for each slot, Pa (8 a packet): close to it,
  /// or infinite where only deviatoric_stress() tells.
  virtual void mises_bounds(const Group& group, const Real* x, std::size_t begin, std::size_t end, Real* bounds) const;
  /// Writes upper bounds of λ_max(M_t⁻¹D_t), 1/s, of the slots into bounds (8 a packet), or adds them; D: the damping
  /// matrix of the term.
  virtual void damping_bounds(const Group&, const Real*, const Real*, std::size_t begin, std::size_t end, Real* bounds,
                              bool add) const {
    if (!add) std::fill_n(bounds, (end - begin) * Group::lanes, Real(0));
  }

  // Internal state. begin_step() starts a step of h seconds from the state committed last; commit() stores the state at
  // x; reset_history() discards the state and takes x as relaxed.
  virtual void begin_step(Real) {}
  virtual void commit(const Group&, const Real*) {}
  virtual void reset_history(const Group&, const Real*) {}
  /// The lists of internal state per slot; empty for a law.
  virtual SlotStates<Real> slot_states() = 0;
  /// After an edit of the mesh, transforms the internal state of every slot from the original element to its piece.
  virtual void reshape(const std::vector<SubelementMap<Real>>&) {}
};

/// Writes or adds one slot's corner forces.
template <class Real>
void write_slot_forces(const Real f[12], const ElementGroup<Real>& group, std::size_t s, Real* corner, bool add) {
  Real* to = corner + 3 * (group.first_corner + 4 * s);
  for (int i = 0; i < 12; ++i) to[i] = add ? to[i] + f[i] : f[i];
}

/// Writes or adds one slot's stiffness (elastic/edge_stiffness.hpp).
template <class Real>
void write_edge_stiffness(const Real k[edge_entries], std::size_t s, Real* K, bool add) {
  constexpr std::size_t lanes = ElementGroup<Real>::lanes;
  Real* to = K + edge_entries * lanes * (s / lanes) + s % lanes;
  for (std::size_t i = 0; i < edge_entries; ++i) to[lanes * i] = add ? to[lanes * i] + k[i] : k[i];
}

/// Reads one slot's stiffness.
template <class Real>
void read_edge_stiffness(const Real* K, std::size_t s, Real k[edge_entries]) {
  constexpr std::size_t lanes = ElementGroup<Real>::lanes;
  const Real* from = K + edge_entries * lanes * (s / lanes) + s % lanes;
  for (std::size_t i = 0; i < edge_entries; ++i) k[i] = from[lanes * i];
}

/// The passive terms of a material that material_problem() accepts; none if its law is not a continuum. without_volume:
/// the isochoric part alone (nodal_pressure.hpp evaluates the volume term).
template <class Real>
std::vector<std::unique_ptr<GroupTerm<Real>>> make_terms(const Material& material, bool continuation,
                                                         bool without_volume);

}  // namespace heml
