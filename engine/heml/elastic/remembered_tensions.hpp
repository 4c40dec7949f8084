#pragma once
// Tensions of viscosity, and those that relaxing elements remember, for any scalar: numbers in the loops over a group
// (viscoelastic_loops.hpp), packs in the kernels of points (point_stages.hpp).
#include <heml/elastic/tension.hpp>
#include <heml/elastic/term_values.hpp>

namespace heml {

/// Adds the viscous tensions V (η A dG A + ζ/2 (A:dG) A) / h.
template <class Real>
[[gnu::always_inline]] inline void add_viscous_tensions(const Real dG[6], const RestShape<Real>& rest, Real eta,
                                                        Real zeta, Real per_step, Real T[6]) {
  const Real* A = rest.A;
  const Real a[3][3] = {{A[0], A[3], A[4]}, {A[3], A[1], A[5]}, {A[4], A[5], A[2]}};
  Real AdGA[6];
  congruence3(a, dG, AdGA);
  const Real bulk = zeta / 2 * double_contraction3(A, dG), scale = rest.volume * per_step;
  for (int i = 0; i < 6; ++i) T[i] += scale * (eta * AdGA[i] + bulk * A[i]);
}

/// Tensions with the law's wJ expressed as tensions, wJ (cross_a·cross_b) / (36 V J), for an element to remember. Below
/// |J| = min_remembered_J they fade with J²: those of an element that is crushed to nothing are without bound, and
/// would throw it once it has its volume again.
template <class Real>
[[gnu::always_inline]] inline void put_total_tensions(const Tensions<Real>& law, const Real cross[3][3], Real J,
                                                      Real volume, Real T[6]) {
  const Real limit = Real(min_remembered_J) * Real(min_remembered_J), one = 1;
  const Mask<Real> is_crushed = J * J < limit;
  const Real fade = select(is_crushed, J * J / limit, one);
  const Real scale = select(is_crushed, law.wJ * (J / limit), law.wJ) / (36 * volume * select(is_crushed, one, J));
  constexpr int row[6] = {0, 1, 2, 0, 0, 1}, col[6] = {0, 1, 2, 1, 2, 2};
  for (int k = 0; k < 6; ++k) {
    const Real *p = cross[row[k]], *q = cross[col[k]];
    T[k] = fade * law.T[k] + scale * (p[0] * q[0] + p[1] * q[1] + p[2] * q[2]);
  }
}

}  // namespace heml
