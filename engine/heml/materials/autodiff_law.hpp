#pragma once
// Base class of laws given by their energy W(I1, I2, J) alone (paper, Table 1, first row: the general type).
// Forward-mode differentiation (math/jet.hpp) gives the derivatives.
//
// A law derives from AutodiffLaw<itself, Real, continued> and implements density(at) for invariants of any scalar;
// yeoh.hpp is the shortest example.
#include <heml/materials/volume.hpp>
#include <heml/math/jet.hpp>

namespace heml {

template <class Self, class Real, bool continued>
struct AutodiffLaw {
  static constexpr bool has_volume_term = true, uses_I2 = true, uses_J = true, uses_I4 = false;
  static constexpr bool always_valid = continued, is_stress_free = true;
  static constexpr SmallStrainModuli sample = {1e3, 5e4};

  Mask<Real> valid(const Invariants<Real>& at) const {
    return continued || at.J > min_volume_ratio<Real> || at.J < -min_volume_ratio<Real>;
  }
  Real energy(const Invariants<Real>& at) const { return self().density(at); }
  FirstDerivatives<Real> first_derivatives(const Invariants<Real>& at) const {
    const auto w = differentiated<1>(at);
    return {w.gradient[0], w.gradient[1], w.gradient[2]};
  }
  SecondDerivatives<Real> second_derivatives(const Invariants<Real>& at) const {
    const auto w = differentiated<2>(at);
    return {w.hessian(0, 0), w.hessian(0, 1), w.hessian(1, 1), w.hessian(0, 2), w.hessian(1, 2), w.hessian(2, 2)};
  }

 private:
  const Self& self() const { return static_cast<const Self&>(*this); }
  template <int order>
  [[gnu::always_inline]] Jet<Real, 3, order> differentiated(const Invariants<Real>& at) const {
    return self().density(Invariants<Jet<Real, 3, order>>{variable<3, order>(at.I1, 0), variable<3, order>(at.I2, 1),
                                                          variable<3, order>(at.J, 2)});
  }
};

}  // namespace heml
