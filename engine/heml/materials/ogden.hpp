#pragma once
// Ogden with any number of terms: W = Σ_p μp/αp (λ̄1^αp + λ̄2^αp + λ̄3^αp − 3) + κ/2 (J−1)²; the shear modulus at rest
// is Σ μp αp / 2. In c̄ = λ̄²: h(c̄) = Σ_p μp/αp (c̄^(αp/2) − 1).
//
// `continued` replaces a power by its second-order Taylor polynomial in c̄ where it would exceed 1000, and below
// λ̄ = 0.2: C2, and smooth through c̄ = 0. (A polynomial in λ̄ would have a kink there as a function of C.) A function
// of C alone is equal for an element and its mirror image, so a term of negative power has an energy barrier at J = 0
// that would keep an inverted element inverted. A quartic in J0 − J, scaled by the steepest slope of the barrier, is
// added below J0 to overcome it.
#include <algorithm>
#include <heml/materials/principal.hpp>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

namespace heml {

template <class Real>
struct OgdenTerm {
  Real mu, alpha;
  Real low, high;  ///< range of c̄ in which the power is not continued
};

/// Type of `owner` in a law that borrows its terms.
struct NoOwner {};

template <class Real, bool continued>
struct Ogden {
  using Term = OgdenTerm<Lane<Real>>;
  const Term* terms = nullptr;
  std::size_t count = 0;
  Real steepness = 1;  ///< max |α/2 − 1| + 1
  Real kappa = 0;
  Real barrier_coefficient = 0;  ///< coefficient of the quartic below J0, Pa
  std::conditional_t<std::is_same_v<Real, Lane<Real>>, std::shared_ptr<const std::vector<Term>>, NoOwner> owner = {};

  static constexpr std::string_view name = "ogden";
  static constexpr std::string_view title = "Ogden";
  static constexpr std::string_view formula = "Σ μp/αp (λ̄1^αp + λ̄2^αp + λ̄3^αp − 3) + κ/2 (J−1)²";
  static constexpr std::string_view source = "Ogden 1972";
  static constexpr Parameter<Ogden, Real> parameters[] = {
      {nullptr,
       {"mu", "μ", "Pa", "strength of each term; the shear modulus at rest is Σ μ α / 2", ParameterRange::any, 1,
        ParameterKind::list}},
      {nullptr,
       {"alpha", "α", "", "power of each term; negative ones stiffen in compression", ParameterRange::not_zero, 2,
        ParameterKind::list}},
      {&Ogden::kappa, {"kappa", "κ", "Pa", "bulk modulus: resistance to change of volume", ParameterRange::positive}},
  };
  static constexpr bool is_stress_free = true;
  static constexpr ForceCost cost = {148, 60};
  static constexpr SmallStrainModuli sample = {850, 5e4};
  static constexpr auto of_moduli(double shear, double bulk) {
    return std::array{6 * shear / 17, -4 * shear / 17, 3.0, -4.0, bulk};
  }
  static constexpr bool has_volume_term = true, uses_I2 = true, uses_J = true, uses_I4 = false;
  static constexpr bool always_valid = continued;
  static constexpr bool is_continued = continued;

  /// values: all μ, all α, κ.
  static Ogden from(std::span<const double> values) {
    using std::abs;  // other scalar types provide theirs
    const std::size_t count = (values.size() - 1) / 2;
    auto list = std::make_shared<std::vector<OgdenTerm<Real>>>();
    Ogden law;
    for (std::size_t i = 0; i < count; ++i) {
      const Real mu = static_cast<Real>(values[i]), alpha = static_cast<Real>(values[count + i]), s = alpha / 2;
      constexpr Real far = Real(6.907755278982137);  // ln 1000
      const Real low = std::max(Real(0.04), s < 0 ? natural_exp(far / s) : Real(0));
      const Real high = s > 0 ? natural_exp(std::min(far / s, Real(80))) : std::numeric_limits<Real>::max();
      list->push_back({mu, alpha, low, high});
      // |h1| of the continued term at c̄ = 0, where the barrier is steepest.
      if (continued && s < 0) law.barrier_coefficient += abs(mu / 2 * (2 - s) * power(low, s - 1));
      law.steepness = std::max(law.steepness, abs(s - 1) + 1);
    }
    law.terms = list->data();
    law.count = list->size();
    law.owner = std::move(list);
    law.kappa = static_cast<Real>(values.back());
    return law;
  }

  /// The same law for packs. It borrows the terms, so it must not outlive this law.
  template <class Pack>
  Ogden<Pack, continued> broadcast() const {
    return {terms, count, steepness, kappa, barrier_coefficient};
  }

  Mask<Real> valid(const Invariants<Real>& at) const {
    if constexpr (continued) return true;
    // Powers of the eigenvalues of C̄ must not overflow. Bounds from Ī1 and det C̄ = 1, since eigenvalues are not at
    // hand.
    const Real p = volume_powers<continued>(at.J).p, max_c = p * at.I1, min_c = Real(4) / (p * p * at.I1 * at.I1);
    const Mask<Real> has_volume = at.J > min_volume_ratio<Real> || at.J < -min_volume_ratio<Real>;
    return has_volume && steepness * natural_log(max_c) < safe_exponent<Real> &&
           -steepness * natural_log(min_c) < safe_exponent<Real>;
  }

  PrincipalDerivatives<Real> principal(Real c) const {
    PrincipalDerivatives<Real> sum{0, 0, 0};
    for (const Term *end = terms + count, *each = terms; each != end; ++each) {
      const Term& term = *each;
      const Real s = term.alpha / 2, low = term.low, high = term.high;
      const Real at = continued ? select(c < low, low, select(c > high, high, c)) : c;
      const Real exp_minus_one = natural_expm1(s * natural_log(at)), x = exp_minus_one + 1;
      const Real h = Real(term.mu / term.alpha) * exp_minus_one, h1 = Real(term.mu / 2) * x / at,
                 h2 = h1 * (s - 1) / at, d = c - at;
      sum.h += h + d * (h1 + d / 2 * h2);
      sum.h1 += h1 + d * h2;
      sum.h2 += h2;
    }
    return sum;
  }

  VolumeDerivatives<Real> volume(Real J) const {
    VolumeDerivatives<Real> v{kappa / 2 * (J - 1) * (J - 1), kappa * (J - 1), kappa};
    if constexpr (continued) {
      constexpr Real J0 = continuation_start<Real>;
      const Real d = select(J < J0, J0 - J, Real(0)), k = barrier_coefficient / (J0 * J0);
      v.w += k * d * d * d * d / 4, v.w1 -= k * d * d * d, v.w2 += 3 * k * d * d;
    }
    return v;
  }

  /// For close a and b the mean of h2 between them, by three-point Gauss quadrature with an error below 1e-12.
  Real divided_difference(Real a, Real b) const {
    const Real apart = a - b, middle = (a + b) / 2;
    const Real distance = select(apart < 0, -apart, apart), reach = apart / 2 * Real(0.7745966692414834);
    const Real mean =
        (5 * (principal(middle - reach).h2 + principal(middle + reach).h2) + 8 * principal(middle).h2) / 18;
    return select(distance * steepness > Real(0.1) * middle, (principal(a).h1 - principal(b).h1) / apart, mean);
  }
};

}  // namespace heml
