#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <functional>
#include <heml/materials/test_bench.hpp>
#include <map>
#include <string>

#include "sample_materials.hpp"

// Compares laws with textbook formulas of stress in principal stretches (Ogden 1984; Holzapfel 2000, chapter 6), in
// long double:
//
//   λi Pi = 2 w1 (λ̄i² − Ī1/3) − 2 w2 (λ̄i^−2 − Ī1'/3) + κ J (J−1),  Ī1' = Σ λ̄j^−2 = Ī2,  w1 = ∂w/∂Ī1, w2 = ∂w/∂Ī2
//
// Free stretches are found by bisection of the closed form. tests/e2e/law_formulas.py has a reference for every law.

namespace heml::closed_forms_test {

using test::law_named;
using test::sample_material;

namespace {

using Long = long double;
using Stretches = std::array<Long, 3>;
using Stress = std::array<Long, 3>;

Long product(const Stretches& s) { return s[0] * s[1] * s[2]; }

/// Isochoric principal stretches λ̄i = λi / J^(1/3).
Stretches isochoric(const Stretches& s) {
  const Long size = std::cbrt(product(s));
  return {s[0] / size, s[1] / size, s[2] / size};
}

Long sum_of_powers(const Stretches& s, Long power) {
  return std::pow(s[0], power) + std::pow(s[1], power) + std::pow(s[2], power);
}

/// Nominal stress from w1, w2 (functions of Ī1 − 3) and κ.
using Slope = std::function<Long(Long)>;
Stress split(const Stretches& s, const Slope& w1, Long w2, Long kappa) {
  const Stretches bar = isochoric(s);
  const Long I1 = sum_of_powers(bar, 2), I2 = sum_of_powers(bar, -2), J = product(s);
  Stress P;
  for (int i = 0; i < 3; ++i)
    P[i] = (2 * w1(I1 - 3) * (bar[i] * bar[i] - I1 / 3) - 2 * w2 * (1 / (bar[i] * bar[i]) - I2 / 3) +
            kappa * J * (J - 1)) /
           s[i];
  return P;
}

/// Nominal stress of the paper's laws as printed: λi Pi = 2 w1 λi² + 2 w2 λi² (I1 − λi²) + κ J (J−1).
Stress printed(const Stretches& s, const Slope& w1, Long w2, Long kappa) {
  const Long I1 = sum_of_powers(s, 2), J = product(s);
  Stress P;
  for (int i = 0; i < 3; ++i) P[i] = 2 * s[i] * (w1(I1 - 3) + w2 * (I1 - s[i] * s[i])) + kappa * J * (J - 1) / s[i];
  return P;
}

Slope constant(Long value) {
  return [value](Long) { return value; };
}
Slope exponential(Long factor, Long rate) {
  return [factor, rate](Long e) { return factor * std::exp(rate * e); };
}

using ClosedForm = std::function<Stress(const Stretches&, const std::vector<double>&)>;

const std::map<std::string, ClosedForm, std::less<>>& closed_forms() {
  using S = Stretches;
  using V = std::vector<double>;
  static const std::map<std::string, ClosedForm, std::less<>> table = {
      {"stvk",  // λi (λ tr E + 2 μ Ei), 2 Ei = λi² − 1
       [](const S& s, const V& v) {
         const Long trace = (sum_of_powers(s, 2) - 3) / 2;
         Stress P;
         for (int i = 0; i < 3; ++i) P[i] = s[i] * (v[0] * trace + v[1] * (s[i] * s[i] - 1));
         return P;
       }},
      {"neo_hookean",  // μ (λi − 1/λi) + λ ln J / λi
       [](const S& s, const V& v) {
         Stress P;
         for (int i = 0; i < 3; ++i) P[i] = v[1] * (s[i] - 1 / s[i]) + v[0] * std::log(product(s)) / s[i];
         return P;
       }},
      {"neo_hookean_iso", [](const S& s, const V& v) { return split(s, constant(v[0]), 0, v[1]); }},
      {"mooney_rivlin", [](const S& s, const V& v) { return split(s, constant(v[0]), v[1], v[2]); }},
      {"fung_demiray", [](const S& s, const V& v) { return split(s, exponential(v[0] / 2, v[1]), 0, v[2]); }},
      {"yeoh",
       [](const S& s, const V& v) {
         return split(
             s, [&](Long e) { return v[0] + 2 * v[1] * e + 3 * v[2] * e * e; }, 0, v[3]);
       }},
      {"gent",
       [](const S& s, const V& v) {
         return split(
             s, [&](Long e) { return v[0] / 2 * v[1] / (v[1] - e); }, 0, v[2]);
       }},
      {"veronda_westmann",
       [](const S& s, const V& v) { return split(s, exponential(v[0] * v[1], v[1]), -v[0] * v[1] / 2, v[2]); }},
      {"ogden",  // λi Pi = Σ μp (λ̄i^αp − ⅓ Σj λ̄j^αp) + κ J (J−1)
       [](const S& s, const V& v) {
         const std::size_t terms = (v.size() - 1) / 2;
         Stress P = split(s, constant(0), 0, v.back());
         const Stretches bar = isochoric(s);
         for (std::size_t p = 0; p < terms; ++p)
           for (int i = 0; i < 3; ++i)
             P[i] += v[p] * (std::pow(bar[i], v[terms + p]) - sum_of_powers(bar, v[terms + p]) / 3) / s[i];
         return P;
       }},
      {"hgo",  // fibre along the first axis: λi Pi gets 2 w4 λ̄1² (δi1 − ⅓), w4 = k1 (Ī4−1) exp(k2 (Ī4−1)²)
       [](const S& s, const V& v) {
         Stress P = split(s, constant(v[0]), 0, v[1]);
         const Long I4 = isochoric(s)[0] * isochoric(s)[0], e = std::max<Long>(I4 - 1, 0);
         for (int i = 0; i < 3; ++i) P[i] += 2 * v[2] * e * std::exp(v[3] * e * e) * I4 * ((i == 0) - 1 / 3.0L) / s[i];
         return P;
       }},
      {"guccione",  // fibre along the first axis: λi Pi = λ̄i² S̄i − ⅓ Σj λ̄j² S̄j + κ J (J−1), S̄i = C exp(Q) bi Ēi
       [](const S& s, const V& v) {
         const Stretches bar = isochoric(s);
         Stress pull;
         Long Q = 0, sum = 0;
         for (int i = 0; i < 3; ++i) {
           const Long E = (bar[i] * bar[i] - 1) / 2, b = i == 0 ? v[1] : v[2];
           pull[i] = bar[i] * bar[i] * v[0] * b * E;
           Q += b * E * E, sum += pull[i];
         }
         Stress P = split(s, constant(0), 0, v[4]);
         for (int i = 0; i < 3; ++i) P[i] += std::exp(Q) * (pull[i] - sum / 3) / s[i];
         return P;
       }},
      {"stable_neo_hookean",  // μ' (1 − 1/(I1+1)) λi + λ' (J − α) J/λi, with the publication's own constants
       [](const S& s, const V& v) {
         const Long mu = 4 * v[1] / 3.0L, lambda = v[0] + 5 * v[1] / 6.0L, alpha = 1 + 3 * mu / (4 * lambda);
         const Long J = product(s), I1 = sum_of_powers(s, 2);
         Stress P;
         for (int i = 0; i < 3; ++i) P[i] = mu * (1 - 1 / (I1 + 1)) * s[i] + lambda * (J - alpha) * J / s[i];
         return P;
       }},
      {"paper_neo_hookean", [](const S& s, const V& v) { return printed(s, constant(v[0]), 0, v[1]); }},
      {"paper_mooney_rivlin", [](const S& s, const V& v) { return printed(s, constant(v[0]), v[1], v[2]); }},
      {"paper_fung_demiray", [](const S& s, const V& v) { return printed(s, exponential(v[0] / 2, v[1]), 0, v[2]); }},
  };
  return table;
}

Stress closed_form(const Material& material, const Stretches& s) {
  return closed_forms().find(material.law)->second(s, material.parameters);
}

/// Calls check(material, material point) for every law of the table.
template <class Check>
void for_every_law(const Check& check) {
  for (const auto& entry : closed_forms()) {
    CAPTURE(entry.first);
    const Material material = sample_material(entry.first);
    check(material, *make_material_point(material, false));
  }
}

/// stretches(s) with the free stretch s at which the third principal stress is zero.
template <class Shape>
Stretches free_of_stress(const Material& material, const Shape& stretches) {
  Long low = 0.2L, high = 5;
  while (closed_form(material, stretches(low))[2] > 0) {
    REQUIRE(low > 0.02L);
    low /= 2;
  }
  REQUIRE(closed_form(material, stretches(high))[2] > 0);
  for (int i = 0; i < 100; ++i) {
    const Long middle = (low + high) / 2;
    (closed_form(material, stretches(middle))[2] > 0 ? high : low) = middle;
  }
  return stretches((low + high) / 2);
}

/// Checks the law's stress at these stretches along the axes, and that the test bench finds the same state.
void compare(const Material& material, const MaterialPoint& point, BenchTest test, const Stretches& s) {
  const Stress expected = closed_form(material, s);
  const Mat3 F = Vec3(static_cast<double>(s[0]), static_cast<double>(s[1]), static_cast<double>(s[2])).asDiagonal();
  const Mat3 P = point.first_piola(F);
  const double scale = static_cast<double>(std::abs(expected[0]));
  for (int i = 0; i < 3; ++i) CHECK(std::abs(P(i, i) - static_cast<double>(expected[i])) <= 1e-8 * scale);
  CHECK((P - Mat3(P.diagonal().asDiagonal())).norm() <= 1e-12 * scale);

  const BenchCurve curve = run_bench(point, test, std::array{F(0, 0)});
  REQUIRE(curve.points.size() == 1);
  CHECK(std::abs(curve.points[0].nominal - static_cast<double>(expected[0])) <= 1e-8 * scale);
  CHECK((curve.points[0].F - F).norm() <= 1e-8);
}

/// Prescribed stretches. StVK softens, so only moderate ones have a free lateral stretch.
std::vector<double> pulls(const Material& material) {
  if (material.law == "stvk") return {0.75, 0.9, 1.1, 1.25};
  return {0.5, 0.8, 1.2, 2.0};
}

}  // namespace

TEST_CASE("uniaxial stress of laws is their closed form") {
  for_every_law([](const Material& material, const MaterialPoint& point) {
    for (const double pull : pulls(material)) {
      CAPTURE(pull);
      compare(material, point, BenchTest::uniaxial, free_of_stress(material, [&](Long s) {
                return Stretches{pull, s, s};
              }));
    }
  });
}

TEST_CASE("equibiaxial stress of laws is their closed form") {
  for_every_law([](const Material& material, const MaterialPoint& point) {
    if (law_named(material.law).has_fibre) return;  // along one of the two axes: the stress is not equibiaxial
    for (const double pull : pulls(material)) {
      CAPTURE(pull);
      compare(material, point, BenchTest::equibiaxial, free_of_stress(material, [&](Long s) {
                return Stretches{pull, pull, s};
              }));
    }
  });
}

TEST_CASE("planar stress of laws is their closed form") {
  for_every_law([](const Material& material, const MaterialPoint& point) {
    for (const double pull : pulls(material)) {
      CAPTURE(pull);
      compare(material, point, BenchTest::planar, free_of_stress(material, [&](Long s) {
                return Stretches{pull, 1, s};
              }));
    }
  });
}

// Stretches a, 1/a, 1 with a − 1/a = γ, along (a, 1, 0), (−1, a, 0) and z in the sheared body; there the Cauchy stress
// is λi Pi (J = 1), and P = σ F⁻ᵀ.
TEST_CASE("stress in simple shear of laws is their closed form") {
  for_every_law([](const Material& material, const MaterialPoint& point) {
    if (law_named(material.law).has_fibre) return;  // tested below
    for (const double gamma : {-1.0, 0.2, 0.7, 1.5}) {
      CAPTURE(gamma);
      const Long g = gamma, a = g / 2 + std::sqrt(1 + g * g / 4);
      const Stress P = closed_form(material, {a, 1 / a, 1});
      const Long major = a * P[0], minor = P[1] / a, n = 1 + a * a;
      const Long s11 = (a * a * major + minor) / n, s22 = (major + a * a * minor) / n, s12 = a * (major - minor) / n;
      Mat3 expected = Mat3::Zero();
      expected(0, 0) = static_cast<double>(s11 - g * s12), expected(0, 1) = static_cast<double>(s12);
      expected(1, 0) = static_cast<double>(s12 - g * s22), expected(1, 1) = static_cast<double>(s22);
      expected(2, 2) = static_cast<double>(P[2]);
      const Mat3 F = Mat3::Identity() + gamma * Vec3::UnitX() * Vec3::UnitY().transpose();
      CHECK((point.first_piola(F) - expected).norm() <= 1e-8 * expected.norm());
    }
  });
}

// Shear turns and stretches a fibre along y: F a0 = (γ, 1, 0), Ī4 = 1 + γ². Its Cauchy stress is 2 w4 dev(F a0 ⊗ F a0).
TEST_CASE("a fibre in simple shear pulls along where it has turned, and one along the shear bears nothing") {
  Material fibres = sample_material("hgo"), matrix = sample_material("neo_hookean_iso");
  matrix.parameters = {fibres.parameters[0], fibres.parameters[1]};
  const auto plain = make_material_point(matrix, false), along = make_material_point(fibres, false);
  fibres.fibre = Vec3::UnitY();
  const auto across = make_material_point(fibres, false);
  const double k1 = fibres.parameters[2], k2 = fibres.parameters[3];
  for (const double gamma : {-0.8, 0.3, 1.0}) {
    CAPTURE(gamma);
    const Mat3 F = Mat3::Identity() + gamma * Vec3::UnitX() * Vec3::UnitY().transpose();
    const Vec3 turned(gamma, 1, 0);
    const double e = gamma * gamma, w4 = k1 * e * std::exp(k2 * e * e);
    Mat3 inverse_transposed = Mat3::Identity();
    inverse_transposed(1, 0) = -gamma;
    const Mat3 pull = 2 * w4 * (turned * turned.transpose() - (1 + e) / 3 * Mat3::Identity()) * inverse_transposed;
    const Mat3 expected = plain->first_piola(F) + pull;
    CHECK((across->first_piola(F) - expected).norm() <= 1e-12 * expected.norm());
    CHECK((along->first_piola(F) - plain->first_piola(F)).norm() <= 1e-12 * expected.norm());
  }
}

// With the fibre along the third axis λ1 and λ2 are across it, and the closed form has its stretches in another order.
TEST_CASE("uniaxial stress of guccione across the fibre is its closed form") {
  Material across = sample_material("guccione");
  const Material along = across;
  across.fibre = Vec3::UnitZ();
  const auto point = make_material_point(across, false);
  for (const Stretches s : {Stretches{1.3L, 0.9L, 0.8L}, Stretches{0.7L, 1.2L, 1.1L}, Stretches{0.9L, 0.95L, 1.4L}}) {
    const Stress turned = closed_form(along, {s[2], s[0], s[1]});
    const Vec3 expected(static_cast<double>(turned[1]), static_cast<double>(turned[2]), static_cast<double>(turned[0]));
    const Mat3 F = Vec3(static_cast<double>(s[0]), static_cast<double>(s[1]), static_cast<double>(s[2])).asDiagonal();
    CHECK((point->first_piola(F).diagonal() - expected).norm() <= 1e-12 * expected.norm());
  }
}

// F = I + γ e1 e2ᵀ has E12 = γ/2 and E22 = γ²/2; W = C/2 (exp(Q) − 1) with J = 1 and trace of E not zero.
TEST_CASE("guccione in simple shear takes the components of the strain along its fibre") {
  Material material = sample_material("guccione");
  const auto [C, bf, bt, bfs] = std::array{material.parameters[0], 7.0, 2.5, 4.5};
  material.parameters = {C, bf, bt, bfs, 1e5};
  for (const double gamma : {-0.6, 0.2, 0.9}) {
    CAPTURE(gamma);
    const double shear = gamma * gamma / 4, long_way = gamma * gamma * gamma * gamma / 4;  // E12², E22²
    const Mat3 F = Mat3::Identity() + gamma * Vec3::UnitX() * Vec3::UnitY().transpose();
    const auto energy = [&](const Vec3& fibre) {
      material.fibre = fibre;
      return make_material_point(material, false)->energy(F);
    };
    const auto W = [C = C](double Q) { return C / 2 * std::expm1(Q); };
    CHECK(energy(Vec3::UnitX()) == doctest::Approx(W(bt * long_way + 2 * bfs * shear)).epsilon(1e-12));
    CHECK(energy(Vec3::UnitY()) == doctest::Approx(W(bf * long_way + 2 * bfs * shear)).epsilon(1e-12));
    CHECK(energy(Vec3::UnitZ()) == doctest::Approx(W(bt * (long_way + 2 * shear))).epsilon(1e-12));
  }
}

TEST_CASE("guccione with three equal exponents is isotropic") {
  Material material = sample_material("guccione");
  for (const std::size_t k : {1, 2, 3}) material.parameters[k] = 3;
  const auto along = make_material_point(material, false);
  material.fibre = Vec3(2, -1, 2) / 3;
  const auto oblique = make_material_point(material, false);
  Mat3 F;
  F << 1.2, 0.3, -0.1, 0.05, 0.9, 0.2, -0.15, 0.1, 1.1;
  const Mat3 P = along->first_piola(F);
  CHECK((oblique->first_piola(F) - P).norm() <= 1e-13 * P.norm());
}

TEST_CASE("whichever the volume term, constants at rest are the same") {
  for (const LawInfo& law : laws()) {
    if (!law.has_volume_term) continue;
    CAPTURE(law.name);
    Material material = sample_material(law.name);
    const SmallStrainModuli expected = small_strain_moduli(material);
    for (const VolumeTerm term : {VolumeTerm::logarithmic, VolumeTerm::simo_taylor}) {
      material.volume_term = term;
      CHECK(small_strain_moduli(material).shear == doctest::Approx(expected.shear).epsilon(1e-12));
      CHECK(small_strain_moduli(material).bulk == doctest::Approx(expected.bulk).epsilon(1e-12));
    }
  }
}

}  // namespace heml::closed_forms_test
