#pragma once
// Sine, cosine and the rotation matrix they make, the same to the bit on every processor (elementary.hpp says why the C
// library's are not). Pairs of doubles carry the leading terms, so that nearly all results are the correctly rounded
// ones.
#include <cmath>
#include <heml/math/types.hpp>
#include <limits>

namespace heml {

struct SineCosine {
  double sine, cosine;
};

namespace detail {

/// An unevaluated sum, |low| ≤ half a unit in the last place of high.
struct DoubleDouble {
  double high, low = 0;
};

inline DoubleDouble exact_sum(double a, double b) {
  const double sum = a + b, of_b = sum - a;
  return {sum, (a - (sum - of_b)) + (b - of_b)};
}
/// T. J. Dekker's product: factors split into halves of 26 bits.
inline DoubleDouble exact_product(double a, double b) {
  const auto upper = [](double x) {
    const double scaled = 0x8000001p0 * x;
    return scaled - (scaled - x);
  };
  const double product = a * b, ah = upper(a), bh = upper(b), al = a - ah, bl = b - bh;
  return {product, ((ah * bh - product) + ah * bl + al * bh) + al * bl};
}
inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble sum = exact_sum(a.high, b.high);
  return exact_sum(sum.high, sum.low + (a.low + b.low));
}
inline DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble product = exact_product(a.high, b.high);
  return exact_sum(product.high, product.low + (a.high * b.low + a.low * b.high));
}

/// −z/n! + z²/(n + 2)! − …, as far as counts where z < 0.62.
template <int n>
double alternating_series(double z) {
  constexpr int last = n + 12;
  double factorial = 1;  // exact up to 22!
  for (int k = 2; k <= last; ++k) factorial *= k;
  double sum = 0;
  for (int k = last; k >= n; k -= 2) {
    sum = 1 / factorial - z * sum;
    factorial /= k * (k - 1);
  }
  return -z * sum;
}

}  // namespace detail

/// Of an angle, radians. Within 0.501 units in the last place up to a million; beyond that as exact as the angle is.
inline SineCosine sine_cosine(double angle) {
  using detail::DoubleDouble;
  if (!std::isfinite(angle))
    return {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
  // π/2 in three parts; multiples of the first two, of 33 bits each, are exact.
  constexpr double first = 0x1.921fb544p+0, second = 0x1.0b4611a6p-34, third = 0x1.3198a2e037073p-69;
  const double turns = std::nearbyint(angle * 0x1.45f306dc9c883p-1);
  const DoubleDouble r =
      detail::exact_sum(angle - turns * first, -(turns * second)) + detail::exact_product(-turns, third);
  const DoubleDouble z = r * r;
  // sin r = r + r (−z/6 + z²/120 − …), cos r = 1 + (−z/2 + z²/24 − …); the rest of each in plain doubles.
  const double s = (r + r * (z * (DoubleDouble{-1.0 / 6, -0x1.5555555555555p-57} +
                                  z * (DoubleDouble{1.0 / 120, 0x1.1111111111111p-63} +
                                       DoubleDouble{detail::alternating_series<7>(z.high)}))))
                       .high;
  const double c =
      (DoubleDouble{1} + z * (DoubleDouble{-1.0 / 2} + z * (DoubleDouble{1.0 / 24, 0x1.5555555555555p-59} +
                                                            DoubleDouble{detail::alternating_series<6>(z.high)})))
          .high;
  switch (static_cast<int>(turns - 4 * std::floor(turns / 4))) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

/// About a unit axis, by the right hand.
inline Mat3 rotation_matrix(const Vec3& axis, double radians) {
  const auto [s, c] = sine_cosine(radians);
  const Vec3 across = s * axis, rest = (1 - c) * axis;
  const double xy = rest.x() * axis.y(), xz = rest.x() * axis.z(), yz = rest.y() * axis.z();
  Mat3 R;
  R << rest.x() * axis.x() + c, xy - across.z(), xz + across.y(),  //
      xy + across.z(), rest.y() * axis.y() + c, yz - across.x(),   //
      xz - across.y(), yz + across.x(), rest.z() * axis.z() + c;
  return R;
}

}  // namespace heml
