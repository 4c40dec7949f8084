#pragma once
// SIMD vectors as a scalar type: code generic in its scalar, such as a law, computes all lanes of a pack at once. Built
// on the compiler's vector types, without intrinsics.
//
// Family: a tag type defined by the file that uses packs, so that files compiled for different instruction sets do not
// share template instantiations.
#include <cmath>
#include <concepts>
#include <cstdint>
#include <heml/math/elementary.hpp>
#include <heml/math/scalar.hpp>
#include <limits>

namespace heml {

template <class Real>
struct BitsOf;
template <>
struct BitsOf<float> {
  using Unsigned = std::uint32_t;
  using Signed = std::int32_t;
};
template <>
struct BitsOf<double> {
  using Unsigned = std::uint64_t;
  using Signed = std::int64_t;
};

/// Result of a comparison: all bits of a lane are set, or none.
template <class Real, int lanes, class Family>
struct PackMask {
  using Signed = typename BitsOf<Real>::Signed;
  typedef Signed Vector [[gnu::vector_size(lanes * sizeof(Real))]];
  Vector bits;

  PackMask() = default;
  [[gnu::always_inline]] PackMask(bool all) : bits(Vector{} - Signed{all}) {}  // NOLINT: implicit, sets all lanes
  [[gnu::always_inline]] explicit PackMask(Vector b) : bits(b) {}

  [[gnu::always_inline]] friend PackMask operator&&(PackMask a, PackMask b) { return PackMask(a.bits & b.bits); }
  [[gnu::always_inline]] friend PackMask operator||(PackMask a, PackMask b) { return PackMask(a.bits | b.bits); }
  [[gnu::always_inline]] friend PackMask operator!(PackMask a) { return PackMask(~a.bits); }
  [[gnu::always_inline]] bool all() const {
    Signed every = -1;
    for (int l = 0; l < lanes; ++l) every &= bits[l];
    return every != 0;
  }
};

template <class Real, int n, class Family>
struct Pack {
  static constexpr int lanes = n;
  typedef Real Vector [[gnu::vector_size(n * sizeof(Real))]];
  typedef typename BitsOf<Real>::Unsigned Bits [[gnu::vector_size(n * sizeof(Real))]];
  using Mask = PackMask<Real, n, Family>;
  Vector v;

  Pack() = default;
  template <class Number>
  requires std::integral<Number> || std::floating_point<Number>
  [[gnu::always_inline]] constexpr Pack(Number all) : v(static_cast<Real>(all) - Vector{}) {}  // NOLINT: implicit
  [[gnu::always_inline]] constexpr explicit Pack(Vector vector) : v(vector) {}

  [[gnu::always_inline]] friend constexpr Pack operator+(Pack a, Pack b) { return Pack(a.v + b.v); }
  [[gnu::always_inline]] friend constexpr Pack operator-(Pack a, Pack b) { return Pack(a.v - b.v); }
  [[gnu::always_inline]] friend constexpr Pack operator*(Pack a, Pack b) { return Pack(a.v * b.v); }
  [[gnu::always_inline]] friend constexpr Pack operator/(Pack a, Pack b) { return Pack(a.v / b.v); }
  [[gnu::always_inline]] friend constexpr Pack operator-(Pack a) { return Pack(-a.v); }
  [[gnu::always_inline]] Pack& operator+=(Pack b) { return v += b.v, *this; }
  [[gnu::always_inline]] Pack& operator-=(Pack b) { return v -= b.v, *this; }
  [[gnu::always_inline]] Pack& operator*=(Pack b) { return v *= b.v, *this; }
  [[gnu::always_inline]] friend Mask operator<(Pack a, Pack b) { return Mask(a.v < b.v); }
  [[gnu::always_inline]] friend Mask operator>(Pack a, Pack b) { return Mask(a.v > b.v); }
  [[gnu::always_inline]] friend Mask operator==(Pack a, Pack b) { return Mask(a.v == b.v); }

  [[gnu::always_inline]] friend Pack select(Mask condition, Pack a, Pack b) { return Pack(condition.bits ? a.v : b.v); }
  [[gnu::always_inline]] friend Pack sqrt(Pack a) {
    Pack root;
    for (int l = 0; l < n; ++l) root.v[l] = std::sqrt(a.v[l]);
    return root;
  }
  [[gnu::always_inline]] friend Pack natural_log(Pack a) { return Pack(detail::logarithm<Bits>(a.v, Real{})); }
  [[gnu::always_inline]] friend Pack natural_exp(Pack a) {
    const Pack max_value = max_exponent<Real>;
    const auto [scale, expm1] = detail::exponential<Bits>(within(a, max_value).v, Real{});
    return select(a > max_value, Pack(std::numeric_limits<Real>::infinity()),
                  select(a < -max_value, Pack(0), Pack(scale + scale * expm1)));
  }
  [[gnu::always_inline]] friend Pack natural_expm1(Pack a) {
    const Pack max_value = max_exponent<Real>;
    const auto [scale, expm1] = detail::exponential<Bits>(within(a, max_value).v, Real{});
    return select(a > max_value, Pack(std::numeric_limits<Real>::infinity()), Pack(scale * expm1 + (scale - Real(1))));
  }

 private:
  [[gnu::always_inline]] static Pack within(Pack a, Pack max_value) {
    return select(a < max_value, select(a > -max_value, a, -max_value), max_value);
  }
};

template <class Real, int n, class Family>
struct LaneOf<Pack<Real, n, Family>> {
  using type = Real;
};
template <class Real, int n, class Family>
inline constexpr Real max_exponent<Pack<Real, n, Family>> = max_exponent<Real>;
template <class Real, int n, class Family>
inline constexpr Real safe_exponent<Pack<Real, n, Family>> = safe_exponent<Real>;

}  // namespace heml

template <class Real, int n, class Family>
struct std::numeric_limits<heml::Pack<Real, n, Family>> : std::numeric_limits<Real> {
  static constexpr bool is_iec559 = false;
};
