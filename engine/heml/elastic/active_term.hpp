#pragma once
// Active stress of contracting muscle: S = Ta a0 ⊗ a0, beside the stress of the law, along the fibre a0. For a constant
// Ta it is the gradient of V Ta/2 (I4 − 1), and T_ab = V Ta m_a m_b with m = Dm⁻¹a0 does not depend on the deformation:
// forces are linear in x, and the stiffness is constant and positive.
//
// Kernels of fans add it to the tensions of the law (fan_terms.hpp); elsewhere forces are those of loops:
//
//   f_a = −V Ta m_a F a0,   F a0 = Σ_a m_a e_a,   K_ab = V Ta m_a m_b I
//
// The stress is that of Land et al. 2015 (Proc. R. Soc. A 471, 20150641), problem 3.
#include <heml/elastic/group_term.hpp>

namespace heml {

template <class Real>
class ActiveTerm final : public GroupTerm<Real> {
 public:
  using Group = ElementGroup<Real>;

  /// stress: Ta, Pa. Groups must have fibres.
  explicit ActiveTerm(Real stress) : stress_(stress) {}
  void set_stress(Real stress) { stress_ = stress; }
  Real stress() const { return stress_; }

  Tensions<Real> tensions(const Group& group, std::size_t s, const ElementKinematics<Real>& kinematics,
                          const RestShape<Real>& rest) const override;
  Tensions<Real> tension_differential(const Group&, std::size_t, const ElementKinematics<Real>&, const RestShape<Real>&,
                                      const KinematicsDifferential<Real>&) const override {
    return {};
  }
  Real slot_frequency_bound(const Group& group, std::size_t s, const ElementKinematics<Real>&, const RestShape<Real>&,
                            const CornerWeights<Real>& weights) const override {
    return slot_bound(group, s, weights);
  }
  double energy(const Group& group, std::size_t s, const ElementKinematics<Real>& kinematics,
                const RestShape<Real>& rest) const override;
  bool valid(const Group&, std::size_t, const ElementKinematics<Real>&) const override { return true; }
  /// Zero: materials that flow have no active stress.
  SlotStates<Real> slot_states() override { return {}; }

  bool forces(const Group& group, const Real* x, std::size_t begin, std::size_t end, Real* corner,
              bool add) const override;
  void stiffness(const Group& group, const Real* x, std::size_t begin, std::size_t end, Real scale, Real* K,
                 bool add) const override;
  void frequency_bounds(const Group& group, const Real* weights, const Real* x, std::size_t begin, std::size_t end,
                        Real* bounds, bool add) const override;

 private:
  Real slot_bound(const Group& group, std::size_t s, const CornerWeights<Real>& weights) const;

  Real stress_;
};

}  // namespace heml
