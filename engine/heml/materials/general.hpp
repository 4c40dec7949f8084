#pragma once
// The general type of the paper (Table 1, first row): a law given as nothing but its energy W(I1, I2, J). Slopes and
// curvatures come by forward-mode differentiation (math/jet.hpp).
//
// A law derives from GeneralLaw<itself, Real, continued> and answers density(at) for invariants of any scalar:
// yeoh.hpp is the shortest.
#include <heml/materials/volume.hpp>
#include <heml/math/jet.hpp>

namespace heml {

template <class Self, class Real, bool continued>
struct GeneralLaw {
  static constexpr bool has_volume_term = true, uses_I2 = true, uses_J = true, uses_I4 = false;
  static constexpr bool always_valid = continued, is_stress_free = true;
  static constexpr GroundState sample = {1e3, 5e4};

  Truth<Real> valid(const Invariants<Real>& at) const {
    return continued || at.J > smallest_ratio<Real> || at.J < -smallest_ratio<Real>;
  }
  Real energy(const Invariants<Real>& at) const { return self().density(at); }
  Slopes<Real> slopes(const Invariants<Real>& at) const {
    const auto w = differentiated<1>(at);
    return {w.slope[0], w.slope[1], w.slope[2]};
  }
  Curvatures<Real> curvatures(const Invariants<Real>& at) const {
    const auto w = differentiated<2>(at);
    return {w.curvature(0, 0), w.curvature(0, 1), w.curvature(1, 1),
            w.curvature(0, 2), w.curvature(1, 2), w.curvature(2, 2)};
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
