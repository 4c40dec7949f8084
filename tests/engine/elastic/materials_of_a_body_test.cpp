// Options of a material besides its law: parameters and fibres per element, other volume terms, several materials in a
// body.
#include <doctest/doctest.h>

#include <heml/materials/point.hpp>

#include "quadratic_body.hpp"
#include "small_body.hpp"

namespace heml::materials_of_a_body_test {

using test::forces_of;
using test::largest;
using test::sample_material;
using test::SmallBody;

TEST_CASE("parameters from a field act as one material an element") {
  std::mt19937_64 random(31);
  for (const auto law : test::law_names()) {
    CAPTURE(std::string(law));
    SmallBody small(random, 0.1);
    const Material sample = sample_material(law);
    const std::size_t varied = law == "ogden" ? sample.parameters.size() - 1 : 0;
    // One material per element ...
    std::vector<Material> materials;
    std::vector<int> material_of;
    ElementField field{"stiffness", 1, {}};
    for (std::size_t t = 0; t < small.mesh.tets.size(); ++t) {
      materials.push_back(sample);
      materials.back().parameters[varied] *= test::uniform(random, 0.5, 2);
      field.values.push_back(materials.back().parameters[varied]);
      material_of.push_back(static_cast<int>(t));
    }
    ElasticBody<double> each(small.mesh, material_of, materials, {});
    // ... equals one material with a field.
    small.mesh.fields.push_back(field);
    Material with_field = sample;
    with_field.fields = {{varied, "stiffness"}};
    auto body = small.of(with_field, false);
    const auto f = forces_of(*body, small.x), expected = forces_of(each, small.x);
    for (std::size_t i = 0; i < f.size(); ++i) CHECK(std::abs(f[i] - expected[i]) <= 1e-12 * largest(expected));
    CHECK(test::stiffness_error(*body, small.x, random) <= 1e-5);
    ThreadTeam team(1);
    CHECK(body->frequency_bound(small.x.data(), team) >= test::highest_eigenvalue(*body, small.x));
  }
}

TEST_CASE("fibres of each element come from a field") {
  std::mt19937_64 random(32);
  SmallBody small(random, 0.1);
  std::vector<Material> materials;
  std::vector<int> material_of;
  ElementField field{"fibre", 3, {}};
  for (std::size_t t = 0; t < small.mesh.tets.size(); ++t) {
    materials.push_back(sample_material("hgo"));
    materials.back().fibre = test::random_vector(random, 1).normalized();
    for (const double value : Vec3(2 * materials.back().fibre)) field.values.push_back(value);  // not normalised
    material_of.push_back(static_cast<int>(t));
  }
  ElasticBody<double> each(small.mesh, material_of, materials, {});
  small.mesh.fields.push_back(field);
  Material with_field = sample_material("hgo");
  with_field.fibre_field = "fibre";
  auto body = small.of(with_field, false);
  const auto f = forces_of(*body, small.x), expected = forces_of(each, small.x);
  for (std::size_t i = 0; i < f.size(); ++i) CHECK(std::abs(f[i] - expected[i]) <= 1e-12 * largest(expected));
}

TEST_CASE("other volume terms: forces and stiffness are derivatives, values the formulas'") {
  std::mt19937_64 random(33);
  for (const VolumeTerm term : {VolumeTerm::logarithmic, VolumeTerm::simo_taylor})
    for (const bool continuation : {false, true}) {
      SmallBody small(random, continuation ? 0.6 : 0.08);
      Material material = sample_material("mooney_rivlin");
      material.volume_term = term;
      auto body = small.of(material, continuation);
      CHECK(test::gradient_error(*body, small.x) <= 1e-6);
      CHECK(test::stiffness_error(*body, small.x, random) <= 1e-5);
      const double J = 1.3, s = std::cbrt(J), kappa = material.parameters.back();
      const double W = make_material_point(material, continuation)->energy(s * Mat3::Identity());
      const double l = std::log(J);
      CHECK(W == doctest::Approx(term == VolumeTerm::logarithmic ? kappa / 2 * l * l : kappa / 4 * (J * J - 1 - 2 * l))
                     .epsilon(1e-12));
    }
}

TEST_CASE("laws may be mixed in one body, and share its nodes") {
  std::mt19937_64 random(34);
  SmallBody small(random, 0.08);
  std::vector<Material> materials;
  for (const auto law : test::law_names(true)) materials.push_back(sample_material(law));
  std::vector<int> material_of;
  for (std::size_t t = 0; t < small.mesh.tets.size(); ++t)
    material_of.push_back(static_cast<int>(t % materials.size()));
  ElasticBody<double> body(small.mesh, material_of, materials, {});
  CHECK(test::gradient_error(body, small.x) <= 1e-6);
  CHECK(test::stiffness_error(body, small.x, random) <= 1e-5);
}

TEST_CASE("a material that is replaced loses its internal state, the other materials keep theirs") {
  std::mt19937_64 random(35);
  SmallBody small(random, 0.15, Mat3(Vec3(1.15, 0.9, 1).asDiagonal()));
  Material viscous = sample_material("neo_hookean_iso"), plastic = sample_material("mooney_rivlin"),
           relaxing = sample_material("ogden");
  viscous.viscosity = 3;
  plastic.plasticity = Plasticity{50, 20};
  relaxing.relaxation = {{0.4, 0.02}, {0.3, 0.2}};
  std::vector<Material> materials{viscous, plastic, relaxing};
  std::vector<int> material_of;
  for (std::size_t t = 0; t < small.mesh.tets.size(); ++t) material_of.push_back(static_cast<int>(t % 3));
  const auto states_of = [&](const ElasticBody<double>& body) {
    std::vector<ElementState<double>> states;
    body.states(small.x.data(), states);
    return states;
  };
  for (const std::size_t replaced : {0, 1, 2}) {
    CAPTURE(replaced);
    ElasticBody<double> body(small.mesh, material_of, materials, {});
    auto further = small.rest();
    for (std::size_t i = 0; i < further.size(); ++i) further[i] += 1.2 * (small.x[i] - further[i]);
    for (int k = 0; k < 3; ++k) {
      body.begin_step(0.01);
      body.commit(further.data());
    }
    body.begin_step(0.01);
    const double work = body.plastic_work();
    REQUIRE(work > 0);
    const auto before = states_of(body);
    Material stiffer = materials[replaced];
    for (double& parameter : stiffer.parameters) parameter *= 1.5;
    body.set_material(replaced, stiffer, small.x.data());
    const auto after = states_of(body);

    std::vector<Material> now = materials;
    now[replaced] = stiffer;
    ElasticBody<double> made(small.mesh, material_of, now, {});  // relaxed at x
    made.reset_history(small.x.data());
    made.begin_step(0.01);
    const auto relaxed = states_of(made);
    bool others_differ_from_relaxed = false;
    for (std::size_t t = 0; t < after.size(); ++t)
      if (static_cast<std::size_t>(material_of[t]) == replaced) {
        CHECK(after[t].von_mises == relaxed[t].von_mises);
      } else {
        CHECK(after[t].von_mises == before[t].von_mises);
        others_differ_from_relaxed = others_differ_from_relaxed || after[t].von_mises != relaxed[t].von_mises;
      }
    CHECK(others_differ_from_relaxed);
    CHECK(body.plastic_work() == work);
  }
}

}  // namespace heml::materials_of_a_body_test
