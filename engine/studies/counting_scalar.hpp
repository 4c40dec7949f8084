#pragma once
// A double that counts its operations. Code that is generic over its scalar is run with it to count what it needs.
//
//   const Operations cost = operations_of([&] { corner_forces(law, x0, x1, x2, x3, rest, out); });
#include <cmath>
#include <heml/materials/laws.hpp>
#include <heml/math/elementary.hpp>
#include <limits>

namespace heml {

struct Operations {
  long multiplications = 0, additions = 0;
  long others = 0;  ///< divisions, roots, exponentials, logarithms
  bool operator==(const Operations&) const = default;
  friend Operations operator-(const Operations& a, const Operations& b) {
    return {a.multiplications - b.multiplications, a.additions - b.additions, a.others - b.others};
  }
  /// As the paper counts them (Table 3).
  long multiplications_and_additions() const { return multiplications + additions; }
};

/// Operations of this thread since it started.
inline thread_local Operations operations_done;

/// Operations that `work` does with CountingScalars.
template <class Work>
Operations operations_of(const Work& work) {
  const Operations before = operations_done;
  work();
  return operations_done - before;
}

struct CountingScalar {
  double value = 0;
  constexpr CountingScalar() = default;
  constexpr CountingScalar(double v) : value(v) {}  // NOLINT: implicit, so that literals convert
  explicit operator double() const { return value; }

  friend CountingScalar operator+(CountingScalar a, CountingScalar b) {
    return ++operations_done.additions, CountingScalar(a.value + b.value);
  }
  friend CountingScalar operator-(CountingScalar a, CountingScalar b) {
    return ++operations_done.additions, CountingScalar(a.value - b.value);
  }
  friend CountingScalar operator*(CountingScalar a, CountingScalar b) {
    return ++operations_done.multiplications, CountingScalar(a.value * b.value);
  }
  friend CountingScalar operator/(CountingScalar a, CountingScalar b) {
    return ++operations_done.others, CountingScalar(a.value / b.value);
  }
  friend CountingScalar operator-(CountingScalar a) { return CountingScalar(-a.value); }
  CountingScalar& operator+=(CountingScalar b) { return *this = *this + b; }
  CountingScalar& operator-=(CountingScalar b) { return *this = *this - b; }
  CountingScalar& operator*=(CountingScalar b) { return *this = *this * b; }
  friend bool operator<(CountingScalar a, CountingScalar b) { return a.value < b.value; }
  friend bool operator>(CountingScalar a, CountingScalar b) { return a.value > b.value; }
  friend bool operator==(CountingScalar a, CountingScalar b) { return a.value == b.value; }
  friend CountingScalar sqrt(CountingScalar a) { return ++operations_done.others, CountingScalar(std::sqrt(a.value)); }
  friend CountingScalar abs(CountingScalar a) { return CountingScalar(std::abs(a.value)); }
  friend CountingScalar natural_log(CountingScalar a) {
    return ++operations_done.others, CountingScalar(heml::natural_log(a.value));
  }
  friend CountingScalar natural_exp(CountingScalar a) {
    return ++operations_done.others, CountingScalar(heml::natural_exp(a.value));
  }
  friend CountingScalar natural_expm1(CountingScalar a) {
    return ++operations_done.others, CountingScalar(heml::natural_expm1(a.value));
  }
};

}  // namespace heml

template <>
struct std::numeric_limits<heml::CountingScalar> : std::numeric_limits<double> {
  static constexpr bool is_iec559 = false;
  static heml::CountingScalar max() { return heml::CountingScalar(std::numeric_limits<double>::max()); }
  static heml::CountingScalar epsilon() { return heml::CountingScalar(std::numeric_limits<double>::epsilon()); }
};

namespace heml {

inline CountingScalar power(CountingScalar a, CountingScalar s) { return natural_exp(s * natural_log(a)); }

// Constants that the laws require of a scalar type.
template <>
inline const CountingScalar max_exponent<CountingScalar> = CountingScalar(709);
template <>
inline const CountingScalar safe_exponent<CountingScalar> = CountingScalar(638);
template <>
inline const CountingScalar continuation_start<CountingScalar> = CountingScalar(0.3);
template <>
inline const CountingScalar min_volume_ratio<CountingScalar> = CountingScalar(1e-12);

}  // namespace heml
