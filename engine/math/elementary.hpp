#pragma once
// Elementary functions of our own: the C library picks other code on other processors (with or without FMA), whose last
// bits differ, and a replay must not.
#include <bit>
#include <cstdint>
#include <type_traits>

namespace heml {

/// Natural logarithm of a normal positive number, within 2 ulp. x = m 2^k with m in [√½, √2): ln x = 2 artanh s + k ln
/// 2, s = (m−1)/(m+1), |s| < 0.172. No branches: loops over it vectorise.
template <class Real>
inline Real natural_log(Real x) {
  if constexpr (std::is_same_v<Real, double>) {
    // d = bits(x) − bits(√½): its upper 12 bits are k, the rest what m is above √½. Logical shifts and a conversion by the
    // exponent of 2⁵² (Hacker's Delight), since those vectorise everywhere.
    constexpr std::uint64_t offset = 0x3fe6a09e667f3bcdull, mantissa = 0x000fffffffffffffull;
    const std::uint64_t d = std::bit_cast<std::uint64_t>(x) - offset;
    const double m = std::bit_cast<double>((d & mantissa) + offset);
    const double n = std::bit_cast<double>(((d + (1024ull << 52)) >> 52) | 0x4330000000000000ull) - (0x1p52 + 1024);
    const double s = (m - 1) / (m + 1);
    const double z = s * s;
    const double tail =
        z * (1.0 / 3 +
             z * (1.0 / 5 +
                  z * (1.0 / 7 +
                       z * (1.0 / 9 + z * (1.0 / 11 +
                                           z * (1.0 / 13 +
                                                z * (1.0 / 15 + z * (1.0 / 17 + z * (1.0 / 19 + z * (1.0 / 21))))))))));
    // ln 2 in two parts, the first with enough trailing zeros that k times it is exact.
    return n * 0x1.62e42fefap-1 + (n * 0x1.cf79abc9e3b3ap-40 + (2 * s + 2 * s * tail));
  } else {
    constexpr std::uint32_t offset = 0x3f3504f3u, mantissa = 0x007fffffu;
    const std::uint32_t d = std::bit_cast<std::uint32_t>(x) - offset;
    const float m = std::bit_cast<float>((d & mantissa) + offset);
    const float n = std::bit_cast<float>(((d + (128u << 23)) >> 23) | 0x4b000000u) - (0x1p23f + 128);
    const float s = (m - 1) / (m + 1);
    const float z = s * s;
    const float tail = z * (1.0f / 3 + z * (1.0f / 5 + z * (1.0f / 7 + z * (1.0f / 9 + z * (1.0f / 11)))));
    return n * 0x1.62e4p-1f + (n * 0x1.7f7d1cp-20f + (2 * s + 2 * s * tail));
  }
}

}  // namespace heml
