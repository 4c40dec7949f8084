// The element's code is generic over its scalar: run on one that counts, it says how many operations a law takes.
#include <doctest/doctest.h>

#include <heml/elastic/tension.hpp>
#include <heml/materials/laws.hpp>

#include "engine/materials/sample_materials.hpp"

namespace {

struct Count {
  long multiplications = 0, additions = 0, others = 0;  // others: divisions, roots, exponentials, logarithms
  bool operator==(const Count&) const = default;
};
Count count;

/// A double that counts what is done to it.
struct Counted {
  double value = 0;
  constexpr Counted() = default;
  constexpr Counted(double v) : value(v) {}  // NOLINT: numbers are counted numbers
  explicit operator double() const { return value; }

  friend Counted operator+(Counted a, Counted b) { return ++count.additions, Counted(a.value + b.value); }
  friend Counted operator-(Counted a, Counted b) { return ++count.additions, Counted(a.value - b.value); }
  friend Counted operator*(Counted a, Counted b) { return ++count.multiplications, Counted(a.value * b.value); }
  friend Counted operator/(Counted a, Counted b) { return ++count.others, Counted(a.value / b.value); }
  friend Counted operator-(Counted a) { return Counted(-a.value); }
  Counted& operator+=(Counted b) { return *this = *this + b; }
  Counted& operator-=(Counted b) { return *this = *this - b; }
  Counted& operator*=(Counted b) { return *this = *this * b; }
  friend bool operator<(Counted a, Counted b) { return a.value < b.value; }
  friend bool operator>(Counted a, Counted b) { return a.value > b.value; }
  friend bool operator==(Counted a, Counted b) { return a.value == b.value; }
  friend Counted sqrt(Counted a) { return ++count.others, Counted(std::sqrt(a.value)); }
  friend Counted abs(Counted a) { return Counted(std::abs(a.value)); }
  friend Counted natural_log(Counted a) { return ++count.others, Counted(heml::natural_log(a.value)); }
  friend Counted natural_exp(Counted a) { return ++count.others, Counted(heml::natural_exp(a.value)); }
  friend Counted natural_expm1(Counted a) { return ++count.others, Counted(heml::natural_expm1(a.value)); }
  friend Counted power(Counted a, Counted s) { return natural_exp(s * natural_log(a)); }
};

}  // namespace

template <>
struct std::numeric_limits<Counted> : std::numeric_limits<double> {
  static constexpr bool is_iec559 = false;
  static Counted max() { return Counted(std::numeric_limits<double>::max()); }
  static Counted epsilon() { return Counted(std::numeric_limits<double>::epsilon()); }
};

namespace heml {
template <>
inline const Counted largest_exponent<Counted> = Counted(709);
template <>
inline const Counted exponent_in_range<Counted> = Counted(638);
template <>
inline const Counted continuation_start<Counted> = Counted(0.3);
template <>
inline const Counted smallest_ratio<Counted> = Counted(1e-12);
}  // namespace heml

using namespace heml;

namespace {

const Vec3 rest_nodes[4] = {{0, 0, 0}, {0.1, 0.01, 0}, {0.02, 0.12, 0}, {0.01, 0.03, 0.09}};

/// Corner forces of one stretched element with any scalar.
template <class Real, class L>
std::array<double, 12> forces(const L& law) {
  Mat3 Dm;
  Dm << rest_nodes[1] - rest_nodes[0], rest_nodes[2] - rest_nodes[0], rest_nodes[3] - rest_nodes[0];
  const Mat3 g = Dm.inverse(), A = g * g.transpose();
  const Vec3 m = g * Vec3::UnitX();
  RestShape<Real> rest;
  const double entries[6] = {A(0, 0), A(1, 1), A(2, 2), A(0, 1), A(0, 2), A(1, 2)};
  for (int i = 0; i < 6; ++i) rest.A[i] = Real(entries[i]);
  for (int i = 0; i < 3; ++i) rest.fibre[i] = Real(m[i]);
  rest.volume = Real(Dm.determinant() / 6);
  Real x[4][3], out[12];
  for (int a = 0; a < 4; ++a)
    for (int i = 0; i < 3; ++i) x[a][i] = Real(rest_nodes[a][i] * (i == 0 ? 1.2 : 0.9));
  corner_forces(law, x[0], x[1], x[2], x[3], rest, out);
  std::array<double, 12> result;
  for (std::size_t i = 0; i < 12; ++i) result[i] = static_cast<double>(out[i]);
  return result;
}

template <class L>
Count operations_of(const Material& material) {
  const L law = law_from<L, Counted>(material.parameters);
  count = {};
  forces<Counted>(law);
  return count;
}

}  // namespace

TEST_CASE("every law runs on a counting scalar, gives the same forces, and says what it costs") {
  std::apply(
      [](auto... tag) {
        (
            [](auto one) {
              using Plain = typename decltype(one)::template Law<double, false>;
              using Counting = typename decltype(one)::template Law<Counted, false>;
              const Material material = test::sample_material(Plain::name);
              const auto expected = forces<double>(law_from<Plain, double>(material.parameters));
              const auto counted = forces<Counted>(law_from<Counting, Counted>(material.parameters));
              for (std::size_t i = 0; i < 12; ++i) CHECK(counted[i] == expected[i]);
              const Count c = operations_of<Counting>(material);
              MESSAGE(std::string(Plain::name) << ": " << c.multiplications << " multiplications, " << c.additions
                                               << " additions, " << c.others << " others");
              CHECK(c.multiplications > 50);
              CHECK(operations_of<Counting>(material) == c);
            }(tag),
            ...);
      },
      LawList{});
}

TEST_CASE("one more multiplication is one more counted") {
  struct Dearer : StVK<Counted, false> {
    Slopes<Counted> slopes(const Invariants<Counted>& at) const {
      auto s = StVK<Counted, false>::slopes(at);
      s.w1 = s.w1 * Counted(1);
      return s;
    }
  };
  const StVK<Counted, false> plain{1e3, 1e3};
  count = {};
  forces<Counted>(plain);
  const Count before = count;
  count = {};
  forces<Counted>(Dearer{plain});
  CHECK(count.multiplications == before.multiplications + 1);
  CHECK(count.additions == before.additions);
}
