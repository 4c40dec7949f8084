#pragma once
// The largest step an explicit method may take, from a bound on each element's stiffness; no iteration, and safe in
// motion because it is taken at the deformed state.
//
// xᵀK x = Σ_t x_tᵀK_t x_t ≤ max_t λ_max(M_t⁻¹K_t) · xᵀM x with M_t = ρV/4 on each corner, whatever the signs of the
// rest of the spectrum. K_t/V is the quadratic form of ∂²W/∂F² in dF = Σ_a u_a ⊗ g_a, bounded here term by term:
//   |dF|² ≤ γ|u|²,   γ = λ_max(Σ g_a g_aᵀ);      |dC|² ≤ 4 σ1² |dF|²
//   (dI1)² ≤ n1 |u|², n1 = 4 Σ|F g_a|²;  (dI2)² ≤ (σ2²+σ3²)² n1-like ≤ I1² n1;  (dJ)² ≤ nJ |u|², nJ = Σ|∂J/∂x_a|²
//   d²I2 = (dI1)² + 2 I1 |dF|² − |dC|² − 2 C:dFᵀdF
//   −√2 σ1 |dF|² ≤ d²J ≤ 2 σ1 |dF|², and for J > 0: d²J = ((dJ)² − tr((F⁻¹dF J)²))/J, which is sharper near rest.
// σ1 ≥ σ2 ≥ σ3: principal stretches, bounded by mean and spread of the eigenvalues of C (Wolkowicz & Styan 1980).
#include <algorithm>
#include <cmath>
#include <heml/elastic/tension.hpp>

namespace heml {

/// A bound on λ_max(M_t⁻¹K_t), 1/s², of an element whose Link has all invariants.
template <class Real, Law<Real> L>
[[gnu::always_inline]] inline Real element_frequency_bound(const L& law, const Link<Real>& link, const Real A[6],
                                                           Real volume, Real gamma, Real density) {
  const Slopes<Real> s = law.slopes(link.at);
  const Curvatures<Real> c = law.curvatures(link.at);
  const auto& [I1, I2, J] = link.at;
  const auto positive = [](Real value) { return std::max(value, Real(0)); };

  // Eigenvalues of C: at most mean + √2 spread and, the middle one, mean + spread/√2.
  const Real mean = I1 / 3, spread = std::sqrt(positive((I1 * I1 - 2 * I2) / 3 - mean * mean));
  const Real largest = mean + Real(1.4142136) * spread, middle = mean + Real(0.70710678) * spread;
  const Real sigma1 = std::sqrt(largest);

  // Σ_a |F g_a|² = tr(AGA) + 1ᵀAGA 1.
  Real AGA[6];
  product_AGA(A, link.AG, AGA);
  const Real n1 = 4 * (2 * (AGA[0] + AGA[1] + AGA[2]) + 2 * (AGA[3] + AGA[4] + AGA[5]));
  Real nJ = 0;
  for (int i = 0; i < 3; ++i) {
    Real sum = 0;
    for (int a = 0; a < 3; ++a) {
      nJ += link.cross[a][i] * link.cross[a][i];
      sum += link.cross[a][i];
    }
    nJ += sum * sum;
  }
  nJ /= 36 * volume * volume;
  const Real n2 = I1 * I1 * n1;

  // S:(dFᵀdF) with S = 2 (w1 + I1 w2) I − 2 w2 C, and the curvature of W in C.
  Real bound = positive(2 * (s.w1 + I1 * s.w2) + 2 * positive(-s.w2) * largest) * gamma;
  bound += positive(c.w11 + s.w2) * n1 + positive(-s.w2) * 4 * largest * gamma + positive(c.w22) * n2;
  bound += 2 * (std::abs(c.w12) * std::sqrt(n1 * n2) + std::abs(c.w1J) * std::sqrt(n1 * nJ) +
                std::abs(c.w2J) * std::sqrt(n2 * nJ));

  // The volume term: wJJ (dJ)² + wJ d²J.
  Real volume_term = positive(c.wJJ) * nJ + (s.wJ > 0 ? 2 * s.wJ : Real(-1.4142136) * s.wJ) * sigma1 * gamma;
  const Real sharper = positive(c.wJJ + s.wJ / J) * nJ + std::abs(s.wJ) * (largest * middle / J) * gamma;
  volume_term = J > 0 && sharper < volume_term ? sharper : volume_term;  // chosen, not branched: the loop vectorises
  return 4 / density * (bound + volume_term);
}

}  // namespace heml
