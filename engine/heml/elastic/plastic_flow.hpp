#pragma once
// Finite-strain multiplicative plasticity, F = Fe Fp with det Fp = 1. In HEML's form it is nothing but a rest shape
// that flows: the elastic law of Fe sees C through A alone, and A = Dm⁻¹ Fp⁻¹ Fp⁻ᵀ Dm⁻ᵀ. So the force loops do not
// change; after each step, elements beyond yield have their A brought back along the deviator of the elastic
// logarithmic strain (exponential map, principal axes kept; Simo 1992), by the Δγ that makes the von Mises Kirchhoff
// stress equal yield + hardening · (equivalent plastic strain). For isotropic laws whose principal stresses are ordered
// as the stretches, stress times flow is never negative: plastic work is dissipated, not made.
#include <heml/elastic/group_term.hpp>
#include <memory>

namespace heml {

template <class Real>
class PlasticFlow {
 public:
  using Group = ElementGroup<Real>;

  /// law: the elastic law of the group's material.
  PlasticFlow(std::unique_ptr<GroupTerm<Real>> law, const Plasticity& plasticity, const Group& group);

  /// Lets elements beyond yield flow at positions x. Returns the plastic work, J.
  double flow(Group& group, const Real* x);
  /// Back to the rest shape as made.
  void reset(Group& group);
  /// An edit of the group: what slot from[s] was is slot s's from now on.
  void gather_slots(std::span<const std::size_t> from);
  /// What slots of another group have flowed becomes that of its pieces: slot s is one of slot from[s], reshaped so.
  void transfer_state(const PlasticFlow& other, const Group& of_other, std::span<const std::size_t> from,
                      const std::vector<SubelementMap<Real>>& subelement_maps, Group& group);
  /// All that has flowed: of the group too, whose rest shape it is.
  SlotMemories<Real> memory(Group& group);
  std::size_t bytes() const { return bytes_of(rest_A_, rest_gamma_, strain_); }
  const std::vector<Real>& plastic_strain() const { return strain_; }  ///< padded #S, equivalent

 private:
  double return_map(Group& group, const Real* x, std::size_t s);

  std::unique_ptr<GroupTerm<Real>> law_;
  Real yield_, hardening_;
  std::array<std::vector<Real>, 6> rest_A_;
  std::vector<Real> rest_gamma_, strain_;
};

/// Flow of a material's elements; none where it has no plasticity.
template <class Real>
std::unique_ptr<PlasticFlow<Real>> make_flow(const Material& material, bool continuation,
                                             const ElementGroup<Real>& group);

}  // namespace heml
