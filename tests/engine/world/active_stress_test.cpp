// Muscle in worlds: a block that shortens as on paper by every method, energy, commands, cuts.
#include <doctest/doctest.h>

#include <cmath>
#include <heml/materials/match_moduli.hpp>
#include <heml/mesh/quadratic.hpp>

#include "world_support.hpp"

namespace heml::active_stress_test {

using namespace heml::test;

namespace {

constexpr double young = 1e4, length = 0.1, stress = 1800;

/// A block along x, held at x = 0, with fibres along it; at Poisson's ratio 0 of a law that is linear in the strain it
/// stays homogeneous. Of quadratic elements, or linear ones.
WorldSetup block(Integrator integrator, bool quadratic, double active_stress = stress) {
  WorldSetup setup;
  setup.mesh = make_box(Vec3(length, 0.02, 0.02), {5, 1, 1});
  if (quadratic) setup.midedges = add_midedge_nodes(setup.mesh), setup.solver.quadratic = true;
  Material material = soft("stvk", young, 0);
  material.fibre = Vec3::UnitX();
  material.active_stress = active_stress;
  setup.materials = {{std::nullopt, material}};
  setup.boundary.push_back({nodes_where(setup.mesh, [](const Vec3& X) { return X.x() < 1e-9; })});
  setup.solver.integrator = integrator;
  setup.solver.threads = 1;
  return setup;
}

/// E (a² − 1)/2 + Ta = 0.
double stretch_under(double active_stress) { return std::sqrt(1 - 2 * active_stress / young); }

/// Largest distance from the block shortened by a.
double distance_to(const World& world, const WorldSetup& setup, double a) {
  double worst = 0;
  const std::vector<Vec3> x = world.positions();
  for (std::size_t n = 0; n < x.size(); ++n)
    worst = std::max(
        worst, (x[n] - Vec3(a * setup.mesh.nodes[n].x(), setup.mesh.nodes[n].y(), setup.mesh.nodes[n].z())).norm());
  return worst;
}

void expect(const Status& status) {
  CAPTURE(status.ok() ? std::string() : status.message());
  CHECK(status.ok());
}

}  // namespace

TEST_CASE("active stress: a static block shortens to sqrt(1 - 2 Ta/E), ramped with the load") {
  for (const bool quadratic : {false, true})
    for (const bool single : {false, true}) {
      CAPTURE(quadratic);
      CAPTURE(single);
      WorldSetup setup = block(Integrator::static_equilibrium, quadratic);
      setup.solver.single_precision = single;
      setup.solver.tolerance = single ? 1e-4 : 1e-9;
      const double close = single ? 2e-6 : 1e-9;
      const auto world = make_world(setup);
      for (const double part : {0.25, 0.5, 1.0}) {
        world->load_to(part);
        REQUIRE(!world->halt());
        CHECK(distance_to(*world, setup, stretch_under(part * stress)) < close);
      }
    }
}

TEST_CASE("active stress: implicit steps come to rest there, and let go again") {
  for (const bool quadratic : {false, true}) {
    WorldSetup setup = block(Integrator::backward_euler, quadratic);
    setup.solver.rate = 20;
    setup.solver.damping = 20;
    const auto world = make_world(setup);
    for (int k = 0; k < 100; ++k) world->tick();
    CHECK(distance_to(*world, setup, stretch_under(stress)) < 1e-5);
    expect(world->apply(SetActiveStress{std::nullopt, 600}));
    for (int k = 0; k < 100; ++k) world->tick();
    CHECK(distance_to(*world, setup, stretch_under(600)) < 1e-5);
    expect(world->apply(SetActiveStress{std::nullopt, 0}));
    for (int k = 0; k < 100; ++k) world->tick();
    CHECK(distance_to(*world, setup, 1) < 1e-5);
  }
}

TEST_CASE("active stress: explicit steps keep the energy of law and muscle together") {
  for (const bool quadratic : {false, true}) {
    WorldSetup setup = block(Integrator::verlet, quadratic);
    setup.solver.step = 1e-4;
    const auto world = make_world(setup);
    double largest = 0, drift = 0, shortest = length;
    for (int k = 0; k < 2000; ++k) {
      world->tick();
      REQUIRE(!world->halt());
      const Energies e = world->energies();
      largest = std::max(largest, e.kinetic);
      drift = std::max(drift, std::abs(e.kinetic + e.elastic));  // 0 at the start: at rest, unstrained
      shortest = std::min(shortest, world->positions()[5].x());
    }
    CHECK(shortest < 0.75 * length);
    CHECK(drift < 1e-3 * largest);
  }
}

TEST_CASE("active stress: what cannot be is refused and changes nothing") {
  const auto world = make_world(block(Integrator::verlet, false, 0));
  CHECK_FALSE(world->apply(SetActiveStress{std::nullopt, -1}).ok());
  CHECK_FALSE(world->apply(SetActiveStress{std::nullopt, std::nan("")}).ok());
  CHECK_FALSE(world->apply(SetActiveStress{7, 100}).ok());
  CHECK(world->setup().materials[0].material.active_stress == 0);
  WorldSetup plain = block(Integrator::verlet, false, 0);
  plain.materials[0].material.fibre = Vec3::Zero();
  const auto other = make_world(plain);
  CHECK(other->apply(SetActiveStress{std::nullopt, 100}).message().find("no fibre") != std::string::npos);
}

TEST_CASE("active stress: a muscle with a field of fibres takes other numbers and laws, and no other field") {
  const auto muscle = [](const char* law, double active) {
    WorldSetup setup = block(Integrator::verlet, false, active);
    Material& material = setup.materials[0].material;
    material = match_moduli(material, *find_law(material.law), *find_law(law));
    material.fibre = Vec3::Zero();
    material.fibre_field = "f";
    ElementField field{"f", 3, {}};
    for (std::size_t t = 0; t < setup.mesh.tets.size(); ++t)
      field.values.insert(field.values.end(),
                          {std::cos(0.3 * static_cast<double>(t)), 0, std::sin(0.3 * static_cast<double>(t))});
    setup.mesh.fields.push_back(field);
    return setup;
  };
  const auto positions = [](World& world) {
    for (int k = 0; k < 50; ++k) world.tick();
    CHECK_FALSE(world.halt());
    return world.positions();
  };
  for (const char* law : {"guccione", "hgo", "stvk", "neo_hookean"}) {
    CAPTURE(law);
    const auto direct = make_world(muscle(law, 2000));
    const auto switched = make_world(muscle(law == std::string("hgo") ? "yeoh" : "hgo", 2000));
    Material material = direct->setup().materials[0].material;
    expect(switched->apply(SetMaterial{std::nullopt, material}));
    CHECK(positions(*switched) == positions(*direct));
    material.fibre_field = "g";
    CHECK(switched->apply(SetMaterial{std::nullopt, material}).message().find("material.fibre") == 0);
  }
}

TEST_CASE("active stress: the pieces of a cut muscle pull as the whole did, with fibres of a field") {
  for (const bool quadratic : {false, true}) {
    CAPTURE(quadratic);
    WorldSetup setup = block(Integrator::verlet, quadratic);
    Material& material = setup.materials[0].material;
    material.fibre = Vec3::Zero();
    material.fibre_field = "f";
    ElementField field{"f", 3, {}};
    for (std::size_t t = 0; t < setup.mesh.tets.size(); ++t) {
      const double angle = 0.3 * static_cast<double>(t);
      field.values.insert(field.values.end(), {std::cos(angle), std::sin(angle), 0});
    }
    setup.mesh.fields.push_back(field);
    const auto world = make_world(setup);
    for (int k = 0; k < 20; ++k) world->tick();
    const double before = world->energies().elastic;
    const std::size_t elements = world->topology()->elements.size();
    expect(world->apply(blade_at(0.051)));
    CHECK(world->topology()->elements.size() > elements);
    CHECK(std::abs(before) > 1e-6);
    CHECK(world->energies().elastic == doctest::Approx(before).epsilon(quadratic ? 1e-2 : 1e-9));
    for (int k = 0; k < 20; ++k) world->tick();
    CHECK(!world->halt());
  }
}

TEST_CASE("active stress: the estimate of the error is relative to the energy of the law alone") {
  for (const bool quadratic : {false, true}) {
    CAPTURE(quadratic);
    const WorldSetup setup = block(Integrator::static_equilibrium, quadratic);
    const auto world = make_world(setup);
    world->load_to(1);
    REQUIRE(!world->halt());
    CHECK(world->energies().elastic < 0);
    const double strain = -stress / young, volume = length * 0.02 * 0.02;
    REQUIRE(world->error_estimate());
    CHECK(world->error_estimate()->stored == doctest::Approx(young / 2 * strain * strain * volume).epsilon(1e-6));
    WorldSetup held = setup;  // at its sides too: its end bulges
    held.materials[0].material = soft("neo_hookean", young, 0.45);
    held.materials[0].material.fibre = Vec3::UnitX();
    held.materials[0].material.active_stress = stress;
    const auto bulging = make_world(held);
    bulging->load_to(1);
    REQUIRE(!bulging->halt());
    const double error = bulging->error_estimate()->relative();
    CHECK(error > 0.02);
    CHECK(error < 0.8);
  }
}

}  // namespace heml::active_stress_test
