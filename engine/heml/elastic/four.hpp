#pragma once
// Four numbers in a register, for loops that read and write vectors of three coordinates.
#include <cstring>

// Clang warns at every call that such a value is returned in another way with AVX; all these calls are inlined.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace heml {

template <class Real>
struct FourOf {
  typedef Real Type __attribute__((vector_size(4 * sizeof(Real))));
};
template <class Real>
using Four = typename FourOf<Real>::Type;

/// Three coordinates; the fourth number is 0.
template <class Real>
[[gnu::always_inline]] inline Four<Real> read_three(const Real* from) {
  Four<Real> value = {from[0], from[1], from[2], 0};
  return value;
}

template <class Real>
[[gnu::always_inline]] inline Four<Real> read_four(const Real* from) {
  Four<Real> value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

template <class Real>
[[gnu::always_inline]] inline void write_four(const Four<Real>& value, Real* to) {
  std::memcpy(to, &value, sizeof value);
}

/// rows[i][j] becomes rows[j][i].
template <class Row>
[[gnu::always_inline]] inline void transpose(Row (&rows)[4]) {
  const Row a = __builtin_shufflevector(rows[0], rows[1], 0, 4, 2, 6);
  const Row b = __builtin_shufflevector(rows[0], rows[1], 1, 5, 3, 7);
  const Row c = __builtin_shufflevector(rows[2], rows[3], 0, 4, 2, 6);
  const Row d = __builtin_shufflevector(rows[2], rows[3], 1, 5, 3, 7);
  rows[0] = __builtin_shufflevector(a, c, 0, 1, 4, 5);
  rows[1] = __builtin_shufflevector(b, d, 0, 1, 4, 5);
  rows[2] = __builtin_shufflevector(a, c, 2, 3, 6, 7);
  rows[3] = __builtin_shufflevector(b, d, 2, 3, 6, 7);
}

}  // namespace heml
