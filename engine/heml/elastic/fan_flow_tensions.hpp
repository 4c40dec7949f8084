#pragma once
// Tensions in a fan of an element whose rest shape has flowed (elastic/fan_flow.hpp), and its von Mises stress. Flow
// couples the axis of a fan with its ring, so A* has all six entries: aa 00 11 a0 a1 01.
#include <heml/elastic/deviator_square.hpp>
#include <heml/elastic/fan_parts.hpp>
#include <heml/elastic/tension.hpp>

namespace heml::fan {

template <class P>
[[gnu::always_inline]] inline void entries_of(const FanGram<P>& G, P out[6]) {
  out[0] = G.aa, out[1] = G.b00, out[2] = G.b11, out[3] = G.a0, out[4] = G.a1, out[5] = G.b01;
}

/// As fan_tensions(), with C = k LᵀGL and T = ⅙ L S Lᵀ, L the Cholesky factor of A*.
template <class P, PrincipalLaw<P> L>
[[gnu::always_inline]] inline FanTensions<P> flowed_tensions(const L& law, const P A[6], P k, const FanGram<P>& gram,
                                                             P J, Mask<P>& valid) {
  P G[6], factor[3][3], C[6], T[6];
  entries_of(gram, G);
  cholesky3(A, factor);
  into_rest_frame(factor, G, C);
  for (P& entry : C) entry *= k;
  const auto stress = principal_stress(law, principal_state<L::is_continued>(law, C, J), J);
  if constexpr (!L::always_valid) valid = valid && law.valid(Invariants<P>{C[0] + C[1] + C[2], P(0), J});
  congruence3(factor, stress.S, T);
  const P sixth = -1.0 / 6;
  return {sixth * T[0], sixth * T[1], sixth * T[2], sixth * T[3], sixth * T[4], sixth * T[5], sixth * stress.wJ};
}

/// T = ⅓ [(w1 + w2 I1) A* − w2 k A*GA*] with I1 = k tr A*G, tr C² = k² tr(A*G)².
template <class P, InvariantLaw<P> L>
[[gnu::always_inline]] inline FanTensions<P> flowed_tensions(const L& law, const P A[6], P k, const FanGram<P>& gram,
                                                             P J, Mask<P>& valid) {
  P G[6], W[3][3];
  entries_of(gram, G);
  Invariants<P> at{P(0), P(0), J, P(1)};
  if constexpr (L::uses_I2) {
    product3(A, G, W);
    at.I1 = k * (W[0][0] + W[1][1] + W[2][2]);
    at.I2 = (at.I1 * at.I1 - k * k * trace_of_square(W)) * P(0.5);
  } else {
    at.I1 = k * double_contraction3(A, G);
  }
  if constexpr (!L::always_valid) valid = valid && law.valid(at);
  const FirstDerivatives<P> s = law.first_derivatives(at);
  const P third = -1.0 / 3;
  P T[6];
  if constexpr (L::uses_I2) {
    const P c = -(s.w2 * third) * k, pull = (s.w1 + s.w2 * at.I1) * third;
    for (auto& row : W)
      for (P& entry : row) entry *= c;
    for (int i = 0; i < 3; ++i) W[i][i] += pull;
    constexpr int row[6] = {0, 1, 2, 0, 0, 1},
                  column[3][6] = {{0, 3, 4, 3, 4, 4}, {3, 1, 5, 1, 5, 5}, {4, 5, 2, 5, 2, 2}};
    for (int e = 0; e < 6; ++e)
      T[e] = W[row[e]][0] * A[column[0][e]] + W[row[e]][1] * A[column[1][e]] + W[row[e]][2] * A[column[2][e]];
  } else {
    for (int e = 0; e < 6; ++e) T[e] = s.w1 * third * A[e];
  }
  return {T[0], T[1], T[2], T[3], T[4], T[5], s.wJ * P(-1.0 / 6)};
}

/// 1/54 of the square of the von Mises Kirchhoff stress, Pa², and what rounding may take away.
template <class P>
[[gnu::always_inline]] inline P mises_measure(const FanTensions<P>& t, const FanGram<P>& gram, P k) {
  P G[6];
  entries_of(gram, G);
  const P T[6] = {k * t.aa, k * t.b00, k * t.b11, k * t.a0, k * t.a1, k * t.b01};
  return deviator_square(T, G);
}

}  // namespace heml::fan
