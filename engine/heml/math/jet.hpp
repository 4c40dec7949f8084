#pragma once
// Forward-mode automatic differentiation: a number with its first and (order 2) second derivatives by N variables.
// Expressions of jets with + − × ÷ and the functions below carry their exact derivatives.
//
//   Jet<double, 2> x = variable<2>(3.0, 0), y = variable<2>(4.0, 1);
//   (x * x * y).gradient[0] == 24;  (x * x * y).hessian(0, 1) == 6
#include <array>
#include <cmath>
#include <cstddef>
#include <heml/math/elementary.hpp>
#include <heml/math/scalar.hpp>
#include <type_traits>

namespace heml {

template <class Real, std::size_t N, int order = 2>
struct Jet {
  Real value{};
  std::array<Real, N> gradient{};
  std::array<Real, order == 2 ? N*(N + 1) / 2 : 0> second{};  ///< upper triangle, row after row

  Jet() = default;
  Jet(Real constant) : value(constant) {}  // NOLINT: implicit conversion from a number
  template <class Number>
  requires std::is_arithmetic_v<Number> Jet(Number constant)
      : value(static_cast<Real>(constant)) {}  // NOLINT: as above
  static constexpr std::size_t at(std::size_t i, std::size_t j) {
    return i <= j ? i * N - i * (i + 1) / 2 + j : at(j, i);
  }
  Real hessian(std::size_t i, std::size_t j) const { return second[at(i, j)]; }

  /// f(this) from f's value and first two derivatives there.
  [[gnu::always_inline]] Jet chain_rule(Real f, Real df, Real ddf) const {
    Jet r;
    r.value = f;
    for (std::size_t i = 0; i < N; ++i) r.gradient[i] = df * gradient[i];
    if constexpr (order == 2)
      for (std::size_t i = 0; i < N; ++i)
        for (std::size_t j = i; j < N; ++j)
          r.second[at(i, j)] = df * second[at(i, j)] + ddf * gradient[i] * gradient[j];
    return r;
  }

  [[gnu::always_inline]] friend inline Jet operator+(Jet a, const Jet& b) {
    a.value += b.value;
    for (std::size_t i = 0; i < N; ++i) a.gradient[i] += b.gradient[i];
    for (std::size_t i = 0; i < a.second.size(); ++i) a.second[i] += b.second[i];
    return a;
  }
  [[gnu::always_inline]] friend inline Jet operator-(const Jet& a) { return a.chain_rule(-a.value, -1, 0); }
  [[gnu::always_inline]] friend inline Jet operator-(const Jet& a, const Jet& b) { return a + -b; }
  [[gnu::always_inline]] friend inline Jet operator*(const Jet& a, const Jet& b) {
    Jet r;
    r.value = a.value * b.value;
    for (std::size_t i = 0; i < N; ++i) r.gradient[i] = a.gradient[i] * b.value + a.value * b.gradient[i];
    if constexpr (order == 2)
      for (std::size_t i = 0; i < N; ++i)
        for (std::size_t j = i; j < N; ++j)
          r.second[at(i, j)] = a.second[at(i, j)] * b.value + a.value * b.second[at(i, j)] +
                               a.gradient[i] * b.gradient[j] + a.gradient[j] * b.gradient[i];
    return r;
  }
  [[gnu::always_inline]] friend inline Jet operator/(const Jet& a, const Jet& b) {
    const Real inverse = 1 / b.value;
    return a * b.chain_rule(inverse, -inverse * inverse, 2 * inverse * inverse * inverse);
  }
  friend Mask<Real> operator<(const Jet& a, const Jet& b) { return a.value < b.value; }
  friend Mask<Real> operator>(const Jet& a, const Jet& b) { return a.value > b.value; }
};

template <class Real, std::size_t N, int order>
[[gnu::always_inline]] inline Jet<Real, N, order> natural_log(const Jet<Real, N, order>& x) {
  const Real inverse = 1 / x.value;
  return x.chain_rule(natural_log(x.value), inverse, -inverse * inverse);
}
template <class Real, std::size_t N, int order>
[[gnu::always_inline]] inline Jet<Real, N, order> natural_exp(const Jet<Real, N, order>& x) {
  const Real e = natural_exp(x.value);
  return x.chain_rule(e, e, e);
}
template <class Real, std::size_t N, int order>
[[gnu::always_inline]] inline Jet<Real, N, order> natural_expm1(const Jet<Real, N, order>& x) {
  const Real e = natural_exp(x.value);
  return x.chain_rule(natural_expm1(x.value), e, e);
}

/// condition ? a : b in each lane, for jets of packs.
template <class LaneMask, class Real, std::size_t N, int order>
requires(!std::is_same_v<LaneMask, bool>)
    [[gnu::always_inline]] inline Jet<Real, N, order> select(LaneMask condition, const Jet<Real, N, order>& a,
                                                             const Jet<Real, N, order>& b) {
  Jet<Real, N, order> r;
  r.value = select(condition, a.value, b.value);
  for (std::size_t i = 0; i < N; ++i) r.gradient[i] = select(condition, a.gradient[i], b.gradient[i]);
  for (std::size_t i = 0; i < r.second.size(); ++i) r.second[i] = select(condition, a.second[i], b.second[i]);
  return r;
}

/// The i-th of N independent variables.
template <std::size_t N, int order = 2, class Real>
[[gnu::always_inline]] inline Jet<Real, N, order> variable(Real value, std::size_t i) {
  Jet<Real, N, order> x(value);
  x.gradient[i] = 1;
  return x;
}

}  // namespace heml
