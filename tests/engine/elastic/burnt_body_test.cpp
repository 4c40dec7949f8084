// Bodies whose rest shapes heat has shrunk: of every law, kernel, term and element.
#include <doctest/doctest.h>

#include <heml/elastic/error_estimate.hpp>
#include <heml/materials/point.hpp>

#include "small_body.hpp"

namespace heml::burnt_body_test {

using test::forces_of;
using test::largest;
using test::sample_material;
using test::SmallBody;

namespace {

void burn_evenly(TetMesh& mesh, double scale) { mesh.burns.assign(mesh.tets.size(), {1, 1 - scale, scale}); }

void burn_at_random(TetMesh& mesh, std::mt19937_64& random, double least) {
  mesh.burns.clear();
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    mesh.burns.push_back({1, 1 - least, test::uniform(random, least, 1)});
}

/// The largest difference relative to the largest value.
double difference(const std::vector<double>& a, const std::vector<double>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
  return worst / largest(b);
}

/// Of one material: linear, or quadratic, whose nodes are moved at random from x.
struct Bodies {
  TetMesh mesh;
  MidEdges midedges;
  std::vector<double> x;

  Bodies(std::mt19937_64& random, bool quadratic, double size) {
    const SmallBody small(random, 0);
    mesh = small.mesh;
    if (quadratic) midedges = add_midedge_nodes(mesh);
    for (const Vec3& X : mesh.nodes)
      for (const double value : Vec3(size * X + test::random_vector(random, 0.001))) x.push_back(value);
  }
  std::unique_ptr<ElasticBody<double>> of(const TetMesh& shape, const Material& material, bool nodal_pressure) const {
    return std::make_unique<ElasticBody<double>>(shape, std::vector<int>(shape.tets.size(), 0), std::vector{material},
                                                 BodyOptions{true, nodal_pressure}, midedges);
  }
};

}  // namespace

TEST_CASE("burns: a body shrunk evenly has the forces, the energy and the stresses of one meshed smaller, any law") {
  constexpr double scale = 0.83;
  std::mt19937_64 random(61);
  for (const LawInfo& law : laws())
    for (const bool quadratic : {false, true})
      for (const bool nodal_pressure : {false, true}) {
        if (quadratic && !law.is_continuum) continue;
        if (nodal_pressure && !law.has_volume_term) continue;
        CAPTURE(std::string(law.name));
        CAPTURE(quadratic);
        CAPTURE(nodal_pressure);
        const Bodies bodies(random, quadratic, 0.9);
        TetMesh burnt = bodies.mesh, smaller = bodies.mesh;
        burn_evenly(burnt, scale);
        for (Vec3& X : smaller.nodes) X *= scale;
        const Material material = sample_material(law.name);
        const auto body = bodies.of(burnt, material, nodal_pressure),
                   expected = bodies.of(smaller, material, nodal_pressure);
        CHECK(difference(forces_of(*body, bodies.x), forces_of(*expected, bodies.x)) <= 1e-11);
        ThreadTeam team(1);
        const double* x = bodies.x.data();
        CHECK(body->energy(x, team) == doctest::Approx(expected->energy(x, team)).epsilon(1e-11));
        const std::vector<Mat3> F = body->deformation_gradients(x), F_expected = expected->deformation_gradients(x);
        for (std::size_t t = 0; t < F.size(); ++t) CHECK((F[t] - F_expected[t]).norm() <= 1e-12);
        if (!law.is_continuum) continue;
        const std::vector<Mat3> P = body->stresses(x, team), P_expected = expected->stresses(x, team);
        double size = 0;
        for (const Mat3& of_one : P_expected) size = std::max(size, of_one.norm());
        for (std::size_t t = 0; t < P.size(); ++t) CHECK((P[t] - P_expected[t]).norm() <= 1e-10 * size);
        std::vector<ElementState<double>> states, states_expected;
        body->states(x, states);
        expected->states(x, states_expected);
        for (std::size_t t = 0; t < states.size(); ++t)
          CHECK(states[t].J == doctest::Approx(states_expected[t].J).epsilon(1e-11));
      }
}

TEST_CASE("burns: held in its shape, a body has the stress of its law at the inverse stretch, any law") {
  constexpr double scale = 0.85, h = 1e-5;
  std::mt19937_64 random(62);
  for (const auto law : test::law_names()) {
    CAPTURE(std::string(law));
    SmallBody small(random, 0);
    burn_evenly(small.mesh, scale);
    const Material material = sample_material(law);
    const auto point = make_material_point(material, true);
    const Mat3 F = Mat3::Identity() / scale;
    Mat3 expected;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const auto W = [&](double by) {
          Mat3 moved = F;
          moved(i, j) += by;
          return point->energy(moved);
        };
        expected(i, j) = (8 * (W(h) - W(-h)) - (W(2 * h) - W(-2 * h))) / (12 * h);
      }
    const auto body = small.of(material, true);
    ThreadTeam team(1);
    const std::vector<double> x = small.rest();
    for (const Mat3& P : body->stresses(x.data(), team)) CHECK((P - expected).norm() <= 1e-7 * expected.norm());
    for (const Mat3& of_one : body->deformation_gradients(x.data())) CHECK((of_one - F).norm() <= 1e-12);
  }
}

TEST_CASE("burns: where heat varies, forces and stiffness are derivatives of the energy, any law") {
  std::mt19937_64 random(63);
  for (const auto law : test::law_names(true)) {
    CAPTURE(std::string(law));
    SmallBody small(random, 0.04, 0.85 * Mat3::Identity());
    burn_at_random(small.mesh, random, 0.8);
    const auto body = small.of(law, true);
    CHECK(test::gradient_error(*body, small.x) <= 2e-6);
    CHECK(test::stiffness_error(*body, small.x, random) <= 1e-5);
    const double bound = [&] {
      ThreadTeam team(1);
      return body->frequency_bound(small.x.data(), team);
    }();
    CHECK(std::isfinite(bound));
  }
}

TEST_CASE("burns: heat takes no mass, to the bit") {
  std::mt19937_64 random(64);
  for (const bool quadratic : {false, true}) {
    const Bodies bodies(random, quadratic, 1);
    const Material material = sample_material("neo_hookean");
    TetMesh burnt = bodies.mesh;
    burn_at_random(burnt, random, 0.6);
    const auto cold = bodies.of(bodies.mesh, material, false), hot = bodies.of(burnt, material, false);
    CHECK(hot->masses() == cold->masses());
    CHECK(hot->consistent_masses() == cold->consistent_masses());
    cold->set_burns(burnt.burns);
    CHECK(cold->masses() == hot->masses());
  }
}

TEST_CASE("burns: set on a body in several passes they make the body that is made with them, any law") {
  std::mt19937_64 random(65);
  for (const LawInfo& law : laws())
    for (const bool quadratic : {false, true})
      for (const bool nodal_pressure : {false, true}) {
        if (quadratic && !law.is_continuum) continue;
        if (nodal_pressure && !law.has_volume_term) continue;
        CAPTURE(std::string(law.name));
        CAPTURE(quadratic);
        CAPTURE(nodal_pressure);
        const Bodies bodies(random, quadratic, 0.9);
        TetMesh burnt = bodies.mesh;
        burn_at_random(burnt, random, 0.7);
        const Material material = sample_material(law.name);
        const auto body = bodies.of(bodies.mesh, material, nodal_pressure),
                   expected = bodies.of(burnt, material, nodal_pressure);
        std::vector<Burn> part = burnt.burns;
        for (std::size_t t = 0; t < part.size(); t += 2) part[t] = {};
        body->set_burns(part);
        body->set_burns(burnt.burns);
        CHECK(difference(forces_of(*body, bodies.x), forces_of(*expected, bodies.x)) <= 1e-11);
        ThreadTeam team(1);
        CHECK(body->frequency_bound(bodies.x.data(), team) ==
              doctest::Approx(expected->frequency_bound(bodies.x.data(), team)).epsilon(1e-9));
      }
}

TEST_CASE("burns: what elements remember stays, and the flow of plasticity with its volume") {
  std::mt19937_64 random(66);
  SmallBody small(random, 0.1);
  for (const bool plastic : {false, true}) {
    CAPTURE(plastic);
    Material material = sample_material("mooney_rivlin");
    material.viscosity = 2;
    material.relaxation = {{0.5, 0.1}};
    if (plastic) material.plasticity = Plasticity{60, 10};
    const auto body = small.of(material, true);
    body->begin_step(0.01);
    body->commit(small.x.data());
    const auto before = body->internal_state();
    burn_at_random(small.mesh, random, 0.8);
    body->set_burns(small.mesh.burns);
    const auto after = body->internal_state();
    CHECK(after.plastic_work == before.plastic_work);
    REQUIRE(after.values.size() == before.values.size());
    std::size_t same = 0;
    for (std::size_t k = 0; k < after.values.size(); ++k) same += after.values[k] == before.values[k] ? 1 : 0;
    // Of plasticity, the six of A are those of the smaller rest shape.
    CHECK(same == after.values.size() - (plastic ? 6 : 0));
    // What it forgets, flow too, it forgets in the smaller shape.
    const auto expected = small.of(material, true);
    expected->begin_step(0.01);
    for (auto* one : {body.get(), expected.get()}) one->reset_history(small.x.data());
    CHECK(difference(forces_of(*body, small.x), forces_of(*expected, small.x)) <= 1e-11);
  }
}

TEST_CASE("burns: edits of a burnt body give the body made of what is left") {
  std::mt19937_64 random(67);
  SmallBody small(random, 0.05);
  for (const auto law : {"neo_hookean", "hgo", "ogden", "mass_spring"}) {
    CAPTURE(std::string(law));
    TetMesh burnt = small.mesh;
    burn_at_random(burnt, random, 0.7);
    const auto body = small.of(law, true);
    body->set_burns(burnt.burns);
    std::vector<int> left;
    for (std::size_t t = 0; t < burnt.tets.size(); ++t)
      if (t % 5 != 0) left.push_back(static_cast<int>(t));
    body->keep_elements(left);
    const TetMesh rest = with_elements(burnt, left);
    ElasticBody<double> expected(rest, std::vector<int>(rest.tets.size(), 0), {sample_material(law)}, {true, false});
    CHECK(difference(forces_of(*body, small.x), forces_of(expected, small.x)) <= 1e-11);
    const auto snapshot = body->snapshot();
    const auto f = forces_of(*body, small.x);
    body->set_burns(std::vector<Burn>(rest.tets.size(), {1, 0.4, 0.6}));
    CHECK(difference(forces_of(*body, small.x), f) > 0.01);
    body->restore(snapshot, small.x.data());
    CHECK(forces_of(*body, small.x) == f);
  }
}

}  // namespace heml::burnt_body_test
