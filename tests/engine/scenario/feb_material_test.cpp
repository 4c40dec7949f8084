#include <doctest/doctest.h>

#include <cmath>
#include <heml/materials/point.hpp>
#include <heml/scenario/feb_material.hpp>

#include "engine/mesh/files.hpp"
#include "support.hpp"

namespace heml::feb_material_test {

namespace {

/// Energy density of FEBio's Theory Manual in principal stretches.
using Energy = double (*)(const Vec3& l);

double volume_ratio(const Vec3& l) { return l.prod(); }
Vec3 isochoric_part(const Vec3& l) { return l / std::cbrt(l.prod()); }
double first(const Vec3& l) { return l.squaredNorm(); }
double second(const Vec3& l) {
  const Vec3 c = l.cwiseAbs2();
  return c[0] * c[1] + c[1] * c[2] + c[2] * c[0];
}
double log_volume(const Vec3& l) { return std::log(volume_ratio(l)); }
double power_sum(const Vec3& l, double m) { return std::pow(l[0], m) + std::pow(l[1], m) + std::pow(l[2], m) - 3; }

struct Case {
  const char* name;
  const char* text;
  Energy energy;
};

constexpr double lambda = 1000 * 0.3 / (1.3 * 0.4), mu = 1000 / 2.6;

const Case cases[] = {
    {"neo-Hookean", "type=\"neo-Hookean\"><E>1000</E><v>0.3</v>",
     [](const Vec3& l) {
       return mu / 2 * (first(l) - 3) - mu * log_volume(l) + lambda / 2 * log_volume(l) * log_volume(l);
     }},
    {"isotropic elastic", "type=\"isotropic elastic\"><E>1000</E><v>0.3</v>",
     [](const Vec3& l) {
       const Vec3 E = (l.cwiseAbs2() - Vec3::Ones()) / 2;
       return lambda / 2 * E.sum() * E.sum() + mu * E.squaredNorm();
     }},
    {"incomp neo-Hookean", "type=\"incomp neo-Hookean\"><G>300</G><k>9000</k>",
     [](const Vec3& l) { return 150 * (first(isochoric_part(l)) - 3) + 4500 * log_volume(l) * log_volume(l); }},
    {"Mooney-Rivlin", "type=\"Mooney-Rivlin\"><c1>200</c1><c2>50</c2><k>1e4</k>",
     [](const Vec3& l) {
       const Vec3 i = isochoric_part(l);
       return 200 * (first(i) - 3) + 50 * (second(i) - 3) + 5000 * log_volume(l) * log_volume(l);
     }},
    {"Mooney-Rivlin without c2, with Abaqus' pressure",
     "type=\"Mooney-Rivlin\"><c1>200</c1><k>1e4</k><pressure_model>Abaqus</pressure_model>",
     [](const Vec3& l) {
       const double J = volume_ratio(l);
       return 200 * (first(isochoric_part(l)) - 3) + 5000 * (J - 1) * (J - 1);
     }},
    {"Veronda-Westmann with NIKE3D's pressure",
     "type=\"Veronda-Westmann\"><c1>100</c1><c2>0.7</c2><k>8000</k><pressure_model>NIKE3D</pressure_model>",
     [](const Vec3& l) {
       const Vec3 i = isochoric_part(l);
       const double J = volume_ratio(l);
       return 100 * (std::exp(0.7 * (first(i) - 3)) - 1) - 35 * (second(i) - 3) + 2000 * (J * J - 1 - 2 * std::log(J));
     }},
    {"Yeoh", "type=\"Yeoh\"><c1>100</c1><c2>20</c2><c3>3</c3><k>8000</k>",
     [](const Vec3& l) {
       const double a = first(isochoric_part(l)) - 3;
       return 100 * a + 20 * a * a + 3 * a * a * a + 4000 * log_volume(l) * log_volume(l);
     }},
    {"Gent", "type=\"Gent\"><G>300</G><Jm>12</Jm><k>8000</k>",
     [](const Vec3& l) {
       return -300 * 12 / 2.0 * std::log(1 - (first(isochoric_part(l)) - 3) / 12) +
              4000 * log_volume(l) * log_volume(l);
     }},
    {"Holmes-Mow", "type=\"Holmes-Mow\"><E>1000</E><v>0.3</v><beta>0.8</beta>",
     [](const Vec3& l) {
       const double Q = 0.8 / (lambda + 2 * mu) * ((2 * mu - lambda) * (first(l) - 3) + lambda * (second(l) - 3));
       return (lambda + 2 * mu) / 3.2 * (std::exp(Q) / std::pow(volume_ratio(l), 1.6) - 1);
     }},
    {"Ogden", "type=\"Ogden\"><c1>300</c1><m1>2.5</m1><c3>80</c3><m3>-2</m3><k>8000</k>",
     [](const Vec3& l) {
       const Vec3 i = isochoric_part(l);
       return 300 / 6.25 * power_sum(i, 2.5) + 80 / 4.0 * power_sum(i, -2) + 4000 * log_volume(l) * log_volume(l);
     }},
    {"coupled Mooney-Rivlin", "type=\"coupled Mooney-Rivlin\"><c1>200</c1><c2>50</c2><k>3000</k>",
     [](const Vec3& l) {
       return 200 * (first(l) - 3) + 50 * (second(l) - 3) - 600 * log_volume(l) + 1500 * log_volume(l) * log_volume(l);
     }},
    {"Ogden unconstrained", "type=\"Ogden unconstrained\"><cp>2000</cp><c1>300</c1><m1>2.5</m1><c2>40</c2><m2>-3</m2>",
     [](const Vec3& l) {
       const double J = volume_ratio(l);
       return 1000 * (J - 1) * (J - 1) + 300 / 6.25 * (power_sum(l, 2.5) - 2.5 * std::log(J)) +
              40 / 9.0 * (power_sum(l, -3) + 3 * std::log(J));
     }},
};

struct Read {
  std::optional<Material> material;
  std::string refused;
  std::vector<std::string> notes;
};

Read read(const std::string& text, const FebUnits& units = {}) {
  const std::string whole = "<material id=\"1\" name=\"m\" " + text + "</material>";
  const XmlDocument document("a.feb", whole);
  FebFindings findings;
  const auto material = feb_material(document.root(), units, findings);
  return {material, refusal([&] { findings.throw_refused("a.feb"); }), findings.notes()};
}

bool refuses(const std::string& text, const std::string& part) {
  const Read result = read(text);
  if (!result.material && result.refused.find(part) != std::string::npos) return true;
  MESSAGE("'", result.refused, "' does not say '", part, "'");
  return false;
}

}  // namespace

TEST_CASE("energies and stresses of imported laws are FEBio's") {
  std::mt19937_64 random(11);
  for (const Case& each : cases) {
    CAPTURE(each.name);
    const Read result = read(each.text);
    REQUIRE(result.material);
    CHECK(result.notes.empty());
    const auto point = make_material_point(*result.material, false);
    for (int k = 0; k < 10; ++k) {
      const Vec3 l(test::uniform(random, 0.7, 1.4), test::uniform(random, 0.7, 1.4), test::uniform(random, 0.7, 1.4));
      const Mat3 Q = test::random_rotation(random);
      const double W = each.energy(l);
      CHECK(point->energy(Q * l.asDiagonal()) == doctest::Approx(W).epsilon(1e-10));
      const Mat3 P = Q.transpose() * point->first_piola(Q * l.asDiagonal());
      for (int i = 0; i < 3; ++i) {
        const double h = 1e-5;
        const double slope = (each.energy(l + h * Vec3::Unit(i)) - each.energy(l - h * Vec3::Unit(i))) / (2 * h);
        CHECK(P(i, i) == doctest::Approx(slope).epsilon(1e-6).scale(1000));
      }
    }
  }
}

TEST_CASE("moduli and density are converted from the file's units") {
  const FebUnits millimetres{"mm-N-s", 1e-3, 1};
  const Read read_mm = read("type=\"Ogden\"><density>1.1e-9</density><c1>0.3</c1><m1>3</m1><k>5</k>", millimetres);
  REQUIRE(read_mm.material);
  CHECK(read_mm.material->density == doctest::Approx(1100));  // t/mm³
  CHECK(read_mm.material->parameters[0] == doctest::Approx(0.1e6));
  CHECK(read_mm.material->parameters[1] == 3);
  CHECK(read_mm.material->parameters[2] == doctest::Approx(5e6));
  CHECK(read("type=\"neo-Hookean\"><E>1</E><v>0</v>").material->density == 1);  // FEBio's own
}

TEST_CASE("what no law computes exactly is refused by name and line") {
  CHECK(
      refuses("type=\"Fung orthotropic\">", "line 1: <material> 'm' of type Fung orthotropic is no law that is known"));
  CHECK(refuses("type=\"rigid body\">", "of type rigid body"));
  CHECK(refuses("type=\"neo-Hookean\"><E>1</E>", "has no <v>"));
  CHECK(refuses("type=\"neo-Hookean\"><E>1</E><v>0.5</v>", "has v: incompressible"));
  CHECK(refuses("type=\"neo-Hookean\"><E>-1</E><v>0.3</v>", "has E: must be greater than 0"));
  CHECK(refuses("type=\"neo-Hookean\"><E type=\"map\">stiff</E><v>0.3</v>", "varies from place to place"));
  CHECK(refuses("type=\"neo-Hookean\"><E lc=\"1\">1</E><v>0.3</v>", "changes <E> over time"));
  CHECK(refuses("type=\"neo-Hookean\"><E>1</E><v>0.3</v><solid type=\"x\"/>", "has <solid>"));
  CHECK(refuses("type=\"Mooney-Rivlin\"><c1>-1</c1><k>1</k>", "becomes the law mooney_rivlin, whose K1"));
  CHECK(refuses("type=\"Mooney-Rivlin\"><c1>1</c1><k>1</k><pressure_model>other</pressure_model>", "'other'"));
  CHECK(refuses("type=\"Yeoh\"><c1>1</c1><c4>1</c4><k>1</k>", "has c4"));
  CHECK(refuses("type=\"Ogden\"><k>1</k>", "has no term"));
  CHECK(refuses("type=\"Holmes-Mow\"><E>1</E><v>0.3</v><beta>0</beta>", "has beta"));
  CHECK(refuses("type=\"Holmes-Mow\"><E>1</E><v>0.3</v>", "has no <beta>"));
  CHECK(refuses("type=\"Ogden\"><c1>1</c1><m1>0</m1><k>1</k>", "has m1 = 0"));
}

TEST_CASE("axes of an isotropic law are told of and have no effect") {
  const Read result = read("type=\"neo-Hookean\"><E>1</E><v>0.3</v><mat_axis type=\"local\">1,2,3</mat_axis>");
  CHECK(result.material);
  REQUIRE(result.notes.size() == 1);
  CHECK(result.notes[0].find("<mat_axis> has no effect") != std::string::npos);
}

}  // namespace heml::feb_material_test
