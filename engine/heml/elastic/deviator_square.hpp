#pragma once
// The deviator of the Kirchhoff stress from tensions, which kernels of fans and of points compare with what an element
// bears without plastic flow (plastic_flow.hpp).
#include <heml/math/scalar.hpp>
#include <limits>

namespace heml {

/// A G of symmetric matrices.
template <class P>
[[gnu::always_inline]] inline void product3(const P A[6], const P G[6], P W[3][3]) {
  constexpr int entry[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      W[i][j] = A[entry[i][0]] * G[entry[0][j]] + A[entry[i][1]] * G[entry[1][j]] + A[entry[i][2]] * G[entry[2][j]];
}

/// tr W².
template <class P>
[[gnu::always_inline]] inline P trace_of_square(const P W[3][3]) {
  return W[0][0] * W[0][0] + W[1][1] * W[1][1] + W[2][2] * W[2][2] +
         P(2) * (W[0][1] * W[1][0] + W[0][2] * W[2][0] + W[1][2] * W[2][1]);
}

/// tr τ'² and what rounding may take away from it, Pa² for T/V: τ' has the invariants of TG/V less a third of its
/// trace. 3/2 of it is the square of the von Mises stress.
template <class P>
[[gnu::always_inline]] inline P deviator_square(const P T[6], const P G[6]) {
  constexpr auto epsilon = std::numeric_limits<Lane<P>>::epsilon();
  constexpr Lane<P> more = Lane<P>(1e-3),
                    rounding = 64 * epsilon * epsilon / more;  // (a + b)² ≤ (1 + m) a² + (1 + 1/m) b²
  P W[3][3], size = 0;
  product3(T, G, W);
  for (const auto& row : W)
    for (const P& entry : row) size += entry * entry;
  const P mean = (W[0][0] + W[1][1] + W[2][2]) * P(1.0 / 3);
  for (int i = 0; i < 3; ++i) W[i][i] -= mean;
  return trace_of_square(W) * P(1 + more) + size * P(rounding);
}

}  // namespace heml
