#pragma once
// Finite-strain multiplicative plasticity, F = Fe Fp with det Fp = 1. In tension form it changes the rest shape only:
// the elastic law of Fe sees C through A = Dm⁻¹ Fp⁻¹ Fp⁻ᵀ Dm⁻ᵀ, so the force loops stay as they are; fans have a copy of
// A (fan_flow.hpp), and their kernels find what is beyond yield. A return mapping
// (return_mapping.hpp) changes the A of elements beyond yield (exponential map, principal axes fixed; Simo 1992), until
// the von Mises Kirchhoff stress equals yield + hardening · (equivalent plastic strain).
//
// An explicit step flows once it has ended. Within an implicit one every evaluation is of the A that flow to its
// positions gives, from the A that the step began with:
//
//   A of the last step ── try_flow(x) ──► A(x): forces, potential, stiffness ── end_trial() ──► A of the last step
//
// and the step ends by flow() at its last positions.
#include <heml/elastic/group_term.hpp>
#include <heml/elastic/return_mapping.hpp>
#include <heml/math/symmetric3.hpp>
#include <memory>
#include <span>

namespace heml {

template <class Real>
class PlasticFlow {
 public:
  using Group = ElementGroup<Real>;

  /// law: the elastic law of the group's material.
  PlasticFlow(std::unique_ptr<GroupTerm<Real>> law, const Plasticity& plasticity, const Group& group);

  /// Return mapping at positions x (3 #V, m): updates A of elements beyond yield. Returns the plastic work, J.
  double flow(Group& group, const Real* x);
  /// The same where kernels of points have written the von Mises stress of all slots at x, Pa, to mises_stress().
  double flow_at_stress(Group& group, const Real* x);
  Real* mises_stress() { return stress_bounds_.data(); }
  /// The same of slots that may be, ascending, where all others are not.
  double flow(Group& group, const Real* x, std::span<const std::size_t> slots);
  /// The slots whose A the last flow() changed, ascending.
  const std::vector<std::size_t>& flowed() const { return flowed_; }
  /// The von Mises stress below which a slot does not flow, however its stress was rounded, Pa.
  Real least_stress_of_flow(std::size_t s) const;

  // A trial: begin_trial(), try_flow() of all packets, evaluations, end_trial(). Threads may call the functions of
  // packets [begin, end) on disjoint ranges.
  /// x: 3 #V, m. Returns whether try_flow() is done with: the last trial was at x too, and the state is as it was.
  bool begin_trial(Group& group, std::span<const Real> x);
  /// Gives elements beyond yield the A that flow() would.
  void try_flow(Group& group, const Real* x, std::size_t begin, std::size_t end);
  /// The slots that flow in the trial, ascending.
  std::vector<std::size_t> trial_slots() const;
  /// What flow adds to the potential, J: Φ of return_mapping.hpp less W. 0 outside a trial.
  double trial_potential(const Group& group) const;
  /// Adds to the stiffness of elements (edge_stiffness.hpp) that they flow as x changes. Outside a trial nothing.
  void add_stiffness(const Group& group, const Real* x, std::size_t begin, std::size_t end, Real* K) const;
  /// Restores A.
  void end_trial(Group& group);

  /// A copy with the initial rest shape.
  Group at_rest(Group group) const;
  /// Restores the initial rest shape.
  void reset(Group& group);
  /// Multiplies the lengths of a slot's initial rest shape, as scale_rest_shape() does those of the group's.
  void scale_rest_shape(std::size_t s, Real factor);
  /// After an edit of the group: slot s takes the state of the old slot from[s].
  void gather_slots(std::span<const std::size_t> from);
  /// Inherits the flow of another group and updates the rest shapes of `group`: slot s is a piece of slot from[s],
  /// mapped by subelement_maps[s].
  void transfer_state(const PlasticFlow& other, const Group& of_other, std::span<const std::size_t> from,
                      const std::vector<SubelementMap<Real>>& subelement_maps, Group& group);
  /// The lists of internal state: the plastic strain, and A of the group.
  SlotStates<Real> slot_states(Group& group);
  std::size_t bytes() const {
    return bytes_of(rest_A_, strain_, stress_bounds_, flowed_, trial_x_, trial_strain_, other_A_);
  }
  const std::vector<Real>& plastic_strain() const { return strain_; }  ///< padded #S, equivalent

 private:
  /// An element beyond yield, with L of its rest shape, C in its frame, and what flows.
  struct Yielding {
    Real factor[3][3], edges[3][3];
    SymmetricEigen3<Real> e;
    PlasticReturn<Real> flow;
    void rest_A(Real A[6]) const;  ///< after the flow
  };
  void forget_trial() { trial_x_.clear(); }
  FlowStress<Real> flow_stress(std::size_t s) const { return {yield_ + hardening_ * strain_[s], hardening_}; }
  /// Returns whether the slot flows.
  bool find_flow(const Group& group, const Real* x, std::size_t s, const RestShape<Real>& rest,
                 Yielding& yielding) const;
  double add_flow(Group& group, std::size_t s, const Yielding& yielding);
  double flow_beyond_bounds(Group& group, const Real* x);
  template <class Visit>
  void each_yielding(const Group& group, const Real* x, std::size_t begin, std::size_t end, const Visit& visit);

  std::unique_ptr<GroupTerm<Real>> law_;
  Real yield_, hardening_;
  std::array<std::vector<Real>, 6> rest_A_;
  std::vector<Real> strain_;
  std::vector<Real> stress_bounds_;  ///< scratch, padded #S
  std::vector<std::size_t> flowed_;
  // Of the last trial: where it was, the equivalent strain that flows, 0 where none does, and A there; while it lasts
  // the group has these A, and other_A_ those of the state.
  std::vector<Real> trial_x_, trial_strain_;
  std::array<std::vector<Real>, 6> other_A_;
  bool is_on_trial_ = false;
};

/// The plastic flow of a material's elements; null without plasticity.
template <class Real>
std::unique_ptr<PlasticFlow<Real>> make_flow(const Material& material, bool continuation,
                                             const ElementGroup<Real>& group);

}  // namespace heml
