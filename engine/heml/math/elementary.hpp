#pragma once
// Elementary functions with the same bits on every processor, which replays need: the C library selects its code by
// processor (with or without FMA), and the last bits differ. Branch-free, so that loops over them vectorise. For float
// and double; other scalar types (math/jet.hpp, a counting scalar) provide their own overloads.
#include <cstdint>
#include <limits>
#include <type_traits>

namespace heml {

namespace detail {
// Kernels for one number (Bits: an unsigned integer) or a vector (Bits: a vector of unsigned integers). The type of the
// last argument selects double or float.

template <class Bits, class V>
[[gnu::always_inline]] inline V logarithm(V x, double) {
  // d = bits(x) − bits(√½): its upper 12 bits are k, the lower ones bits(m) − bits(√½). k becomes a double by logical
  // shifts and the exponent of 2⁵² (Hacker's Delight), which vectorise on every target.
  constexpr std::uint64_t offset = 0x3fe6a09e667f3bcdull, mantissa = 0x000fffffffffffffull;
  const Bits d = __builtin_bit_cast(Bits, x) - offset;
  const V m = __builtin_bit_cast(V, (d & mantissa) + offset);
  const V n = __builtin_bit_cast(V, ((d + (1024ull << 52)) >> 52) | 0x4330000000000000ull) - (0x1p52 + 1024);
  const V s = (m - 1) / (m + 1);
  const V z = s * s;
  const V tail =
      z * (1.0 / 3 +
           z * (1.0 / 5 +
                z * (1.0 / 7 +
                     z * (1.0 / 9 +
                          z * (1.0 / 11 +
                               z * (1.0 / 13 + z * (1.0 / 15 + z * (1.0 / 17 + z * (1.0 / 19 + z * (1.0 / 21))))))))));
  // ln 2 in two parts, the first with enough trailing zeros that k times it is exact.
  return n * 0x1.62e42fefap-1 + (n * 0x1.cf79abc9e3b3ap-40 + (2 * s + 2 * s * tail));
}

template <class Bits, class V>
[[gnu::always_inline]] inline V logarithm(V x, float) {
  constexpr std::uint32_t offset = 0x3f3504f3u, mantissa = 0x007fffffu;
  const Bits d = __builtin_bit_cast(Bits, x) - offset;
  const V m = __builtin_bit_cast(V, (d & mantissa) + offset);
  const V n = __builtin_bit_cast(V, ((d + (128u << 23)) >> 23) | 0x4b000000u) - (0x1p23f + 128);
  const V s = (m - 1) / (m + 1);
  const V z = s * s;
  const V tail = z * (1.0f / 3 + z * (1.0f / 5 + z * (1.0f / 7 + z * (1.0f / 9 + z * (1.0f / 11)))));
  return n * 0x1.62e4p-1f + (n * 0x1.7f7d1cp-20f + (2 * s + 2 * s * tail));
}

/// e^x = scale (1 + expm1): scale is a power of two, |expm1| < 0.42. Requires |x| up to max_exponent.
template <class V>
struct Exponential {
  V scale, expm1;
};

template <class Bits, class V>
[[gnu::always_inline]] inline Exponential<V> exponential(V x, double) {
  // n = x / ln 2 rounded to the nearest integer: adding 1.5·2⁵² shifts the fraction out of the mantissa.
  const V shifted = x * 0x1.71547652b82fep+0 + 0x1.8p52;
  const V n = shifted - 0x1.8p52;
  const V r = (x - n * 0x1.62e42fefap-1) - n * 0x1.cf79abc9e3b3ap-40;
  const V expm1 =
      r +
      r * r *
          (1.0 / 2 +
           r * (1.0 / 6 +
                r * (1.0 / 24 +
                     r * (1.0 / 120 +
                          r * (1.0 / 720 + r * (1.0 / 5040 + r * (1.0 / 40320 +
                                                                  r * (1.0 / 362880 +
                                                                       r * (1.0 / 3628800 +
                                                                            r * (1.0 / 39916800 +
                                                                                 r * (1.0 / 479001600 +
                                                                                      r * (1.0 / 6227020800))))))))))));
  // The exponent field of 2⁻¹⁰²³ (x below −708.74) would be 0: it is subnormal, a bit of the mantissa.
  const Bits normal = (__builtin_bit_cast(Bits, shifted) + 1023ull) << 52;
  const Bits power = normal | (((normal - 1) >> 63) << 51);
  return {__builtin_bit_cast(V, power), expm1};
}

template <class Bits, class V>
[[gnu::always_inline]] inline Exponential<V> exponential(V x, float) {
  const V shifted = x * 0x1.715476p+0f + 0x1.8p23f;
  const V n = shifted - 0x1.8p23f;
  const V r = (x - n * 0x1.62e4p-1f) - n * 0x1.7f7d1cp-20f;
  const V expm1 =
      r +
      r * r * (1.0f / 2 + r * (1.0f / 6 + r * (1.0f / 24 + r * (1.0f / 120 + r * (1.0f / 720 + r * (1.0f / 5040))))));
  const Bits power = (__builtin_bit_cast(Bits, shifted) + 127u) << 23;
  return {__builtin_bit_cast(V, power), expm1};
}
}  // namespace detail

/// Natural logarithm of a normal positive number, within 2 ulp: x = m 2^k with m in [√½, √2), and
/// ln x = 2 artanh s + k ln 2 with s = (m−1)/(m+1), |s| < 0.172.
inline double natural_log(double x) { return detail::logarithm<std::uint64_t>(x, x); }
inline float natural_log(float x) { return detail::logarithm<std::uint32_t>(x, x); }

/// Largest |x| for which e^x is computed; beyond, it is infinite or 0.
template <class Real>
inline constexpr Real max_exponent = std::numeric_limits<Real>::digits == 24 ? Real(87) : Real(709);

/// Largest x for which a stress proportional to e^x and its derivatives do not overflow a Real.
template <class Real>
inline constexpr Real safe_exponent = max_exponent<Real>* Real(0.9);

template <class Real>
using UnsignedOf = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;

/// e^x, within 2 ulp; infinite above max_exponent, 0 below its negative.
template <class Real>
requires std::numeric_limits<Real>::is_iec559 inline Real natural_exp(Real x) {
  constexpr Real max_value = max_exponent<Real>;
  const Real inside = x < max_value ? (x > -max_value ? x : -max_value) : max_value;
  const auto [scale, expm1] = detail::exponential<UnsignedOf<Real>>(inside, inside);
  const Real value = scale + scale * expm1;
  return x > max_value ? std::numeric_limits<Real>::infinity() : (x < -max_value ? Real(0) : value);
}

/// e^x − 1 without cancellation near 0.
template <class Real>
requires std::numeric_limits<Real>::is_iec559 inline Real natural_expm1(Real x) {
  constexpr Real max_value = max_exponent<Real>;
  const Real inside = x < max_value ? (x > -max_value ? x : -max_value) : max_value;
  const auto [scale, expm1] = detail::exponential<UnsignedOf<Real>>(inside, inside);
  const Real value = scale * expm1 + (scale - 1);
  return x > max_value ? std::numeric_limits<Real>::infinity() : value;
}

/// x^s for x > 0.
template <class Real>
requires std::numeric_limits<Real>::is_iec559 inline Real power(Real x, Real s) {
  return natural_exp(s * natural_log(x));
}

}  // namespace heml
