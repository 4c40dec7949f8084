#pragma once
// Finite-strain multiplicative plasticity, F = Fe Fp with det Fp = 1. In tension form it changes the rest shape only:
// the elastic law of Fe sees C through A = Dm⁻¹ Fp⁻¹ Fp⁻ᵀ Dm⁻ᵀ, so the force loops stay as they are. After each step a
// return mapping changes the A of elements beyond yield along the deviatoric elastic logarithmic strain (exponential
// map, principal axes fixed; Simo 1992), by the Δγ at which the von Mises Kirchhoff stress equals yield + hardening ·
// (equivalent plastic strain). For isotropic laws whose principal stresses are ordered as the stretches, stress times
// flow is never negative: plastic work is dissipated.
#include <heml/elastic/group_term.hpp>
#include <memory>

namespace heml {

template <class Real>
class PlasticFlow {
 public:
  using Group = ElementGroup<Real>;

  /// law: the elastic law of the group's material.
  PlasticFlow(std::unique_ptr<GroupTerm<Real>> law, const Plasticity& plasticity, const Group& group);

  /// Return mapping at positions x (3 #V, m): updates A and gamma of elements beyond yield. Returns the plastic work,
  /// J.
  double flow(Group& group, const Real* x);
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
  /// The lists of internal state: the plastic strain, and A and gamma of the group.
  SlotStates<Real> slot_states(Group& group);
  std::size_t bytes() const { return bytes_of(rest_A_, rest_gamma_, strain_, stress_bounds_); }
  const std::vector<Real>& plastic_strain() const { return strain_; }  ///< padded #S, equivalent

 private:
  double return_map(Group& group, const Real* x, std::size_t s);

  std::unique_ptr<GroupTerm<Real>> law_;
  Real yield_, hardening_;
  std::array<std::vector<Real>, 6> rest_A_;
  std::vector<Real> rest_gamma_, strain_;
  std::vector<Real> stress_bounds_;  ///< scratch of flow()
};

/// The plastic flow of a material's elements; null without plasticity.
template <class Real>
std::unique_ptr<PlasticFlow<Real>> make_flow(const Material& material, bool continuation,
                                             const ElementGroup<Real>& group);

}  // namespace heml
