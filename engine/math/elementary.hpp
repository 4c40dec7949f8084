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
    const auto bits = std::bit_cast<std::int64_t>(x);
    constexpr std::int64_t offset = 0x3fe6a09e667f3bcdll;  // √½
    const std::int64_t k = (bits - offset) >> 52;
    const double m = std::bit_cast<double>(bits - (k << 52));
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
    const double n = static_cast<double>(static_cast<std::int32_t>(k));
    return n * 0x1.62e42fefap-1 + (n * 0x1.cf79abc9e3b3ap-40 + (2 * s + 2 * s * tail));
  } else {
    const auto bits = std::bit_cast<std::int32_t>(x);
    const std::int32_t k = (bits - 0x3f3504f3) >> 23;
    const float m = std::bit_cast<float>(bits - (k << 23));
    const float s = (m - 1) / (m + 1);
    const float z = s * s;
    const float tail = z * (1.0f / 3 + z * (1.0f / 5 + z * (1.0f / 7 + z * (1.0f / 9 + z * (1.0f / 11)))));
    const float n = static_cast<float>(k);
    return n * 0x1.62e4p-1f + (n * 0x1.7f7d1cp-20f + (2 * s + 2 * s * tail));
  }
}

}  // namespace heml
