#pragma once
// Laws by expression of invariants in the kernels of fans and of points, which run each operation on a pack.
#include <heml/materials/energy_law.hpp>

namespace heml {

/// A law by expression that notes whether its derivatives are defined as it computes them.
template <class P, bool with_fibre>
struct NotingEnergy {
  static constexpr bool has_volume_term = false, uses_I2 = true, uses_J = true, uses_I4 = with_fibre;
  static constexpr bool always_valid = true;
  static constexpr std::array<int, 0> parameters{};
  InvariantEnergy<P, false, with_fibre> law;
  Mask<P>* defined;

  [[gnu::always_inline]] Mask<P> valid(const Invariants<P>&) const { return true; }
  [[gnu::always_inline]] P energy(const Invariants<P>&) const { return P(0); }
  [[gnu::always_inline]] FirstDerivatives<P> first_derivatives(const Invariants<P>& at) const {
    const FirstDerivatives<P> s = law.first_derivatives(at);
    *defined = *defined && at.J > P(min_volume_ratio<P>) && is_finite(s.w1 + s.w2 + s.wJ + s.w4);
    return s;
  }
  SecondDerivatives<P> second_derivatives(const Invariants<P>&) const { return {}; }
};

}  // namespace heml
