#pragma once
// A double that counts what is done to it: code that is generic over its scalar, run on this one, says how many
// operations it takes.
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

/// Of this thread, since it began.
inline thread_local Operations operations_done;

/// What `work` does with counted numbers.
template <class Work>
Operations operations_of(const Work& work) {
  const Operations before = operations_done;
  work();
  return operations_done - before;
}

struct Counted {
  double value = 0;
  constexpr Counted() = default;
  constexpr Counted(double v) : value(v) {}  // NOLINT: numbers are counted numbers
  explicit operator double() const { return value; }

  friend Counted operator+(Counted a, Counted b) { return ++operations_done.additions, Counted(a.value + b.value); }
  friend Counted operator-(Counted a, Counted b) { return ++operations_done.additions, Counted(a.value - b.value); }
  friend Counted operator*(Counted a, Counted b) {
    return ++operations_done.multiplications, Counted(a.value * b.value);
  }
  friend Counted operator/(Counted a, Counted b) { return ++operations_done.others, Counted(a.value / b.value); }
  friend Counted operator-(Counted a) { return Counted(-a.value); }
  Counted& operator+=(Counted b) { return *this = *this + b; }
  Counted& operator-=(Counted b) { return *this = *this - b; }
  Counted& operator*=(Counted b) { return *this = *this * b; }
  friend bool operator<(Counted a, Counted b) { return a.value < b.value; }
  friend bool operator>(Counted a, Counted b) { return a.value > b.value; }
  friend bool operator==(Counted a, Counted b) { return a.value == b.value; }
  friend Counted sqrt(Counted a) { return ++operations_done.others, Counted(std::sqrt(a.value)); }
  friend Counted abs(Counted a) { return Counted(std::abs(a.value)); }
  friend Counted natural_log(Counted a) { return ++operations_done.others, Counted(heml::natural_log(a.value)); }
  friend Counted natural_exp(Counted a) { return ++operations_done.others, Counted(heml::natural_exp(a.value)); }
  friend Counted natural_expm1(Counted a) { return ++operations_done.others, Counted(heml::natural_expm1(a.value)); }
};

}  // namespace heml

template <>
struct std::numeric_limits<heml::Counted> : std::numeric_limits<double> {
  static constexpr bool is_iec559 = false;
  static heml::Counted max() { return heml::Counted(std::numeric_limits<double>::max()); }
  static heml::Counted epsilon() { return heml::Counted(std::numeric_limits<double>::epsilon()); }
};

namespace heml {

inline Counted power(Counted a, Counted s) { return natural_exp(s * natural_log(a)); }

// What the laws ask of a scalar type.
template <>
inline const Counted largest_exponent<Counted> = Counted(709);
template <>
inline const Counted exponent_in_range<Counted> = Counted(638);
template <>
inline const Counted continuation_start<Counted> = Counted(0.3);
template <>
inline const Counted smallest_ratio<Counted> = Counted(1e-12);

}  // namespace heml
