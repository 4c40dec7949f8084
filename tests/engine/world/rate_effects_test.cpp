// Viscosity, relaxation, plasticity and other laws in motion, at the live stable step.
#include <doctest/doctest.h>

#include "engine/materials/sample_materials.hpp"
#include "support.hpp"
#include "world_support.hpp"

namespace heml::rate_effects_test {

using namespace heml::test;

namespace {

/// A free cube of one material.
WorldSetup cube(const Material& material) {
  WorldSetup setup;
  setup.mesh = make_box(Vec3(0.1, 0.1, 0.1), {3, 3, 3});
  setup.materials = {{std::nullopt, material}};
  setup.solver.threads = 1;
  return setup;
}

std::vector<int> nodes_where(const TetMesh& mesh, int axis, double value) {
  std::vector<int> nodes;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    if (std::abs(mesh.nodes[n][axis] - value) < 1e-9) nodes.push_back(static_cast<int>(n));
  return nodes;
}

/// The cube with one end held and the other moved along x.
WorldSetup pulled_cube(const Material& material, double by, double ramp_time) {
  WorldSetup setup = cube(material);
  Boundary fixed, moved;
  fixed.nodes = nodes_where(setup.mesh, 0, 0);
  moved.nodes = nodes_where(setup.mesh, 0, 0.1);
  moved.translate = Vec3(by, 0, 0);
  moved.ramp_time = ramp_time;
  setup.boundary = {fixed, moved};
  return setup;
}

}  // namespace

TEST_CASE("every law moves a stretched free cube, keeps its momentum and most of its energy") {
  for (const LawInfo& law : laws()) {
    CAPTURE(std::string(law.name));
    if (law.name.starts_with("paper_")) continue;  // not at rest to begin with
    WorldSetup setup = cube(sample_material(law.name));
    setup.solver.continuation = false;
    for (const Vec3& X : setup.mesh.nodes) setup.initial_positions.push_back(Vec3(1.1 * X.x(), X.y(), 0.95 * X.z()));
    // All of it is in the fastest modes at first, where the energy of Verlet swings with (hω)²: a small step.
    setup.solver.step = make_world(setup)->stable_step() / 8;
    const auto world = make_world(setup);
    const double before = world->energies().elastic;
    run_until(*world, 0.05);
    REQUIRE_FALSE(world->halt());
    const Energies after = world->energies();
    CHECK(after.elastic + after.kinetic == doctest::Approx(before).epsilon(1e-3));
    Vec3 momentum = Vec3::Zero();
    for (const Vec3& v : world->velocities()) momentum += v;
    CHECK(momentum.norm() <= 1e-8 * static_cast<double>(setup.mesh.nodes.size()));
  }
}

TEST_CASE("viscosity takes the energy of a swing, never adds any, and is stable however strong") {
  for (const double viscosity : {1.0, 10.0, 300.0}) {
    Material material = sample_material("mooney_rivlin");
    material.viscosity = viscosity;
    WorldSetup setup = cube(material);
    for (const Vec3& X : setup.mesh.nodes) setup.initial_positions.push_back(Vec3(1.15 * X.x(), X.y(), 0.9 * X.z()));
    const auto world = make_world(setup);
    double energy = world->energies().elastic;
    const double first = energy;
    for (int k = 1; k <= 20; ++k) {
      run_until(*world, 0.005 * k);
      REQUIRE_FALSE(world->halt());
      const Energies e = world->energies();
      CHECK(e.elastic + e.kinetic <= energy + 1e-6 * first);
      energy = e.elastic + e.kinetic;
    }
    CHECK(energy < 0.9 * first);
  }
}

TEST_CASE("the pull of a stretched body relaxes to its long-term value") {
  Material elastic = sample_material("neo_hookean_iso");
  Material material = elastic;
  material.relaxation = {{1.0, 0.05}};
  const auto pull = [&](const Material& m, double time) {
    WorldSetup setup = pulled_cube(m, 0.02, 0.005);
    setup.solver.damping = 60;
    const auto world = make_world(setup);
    run_until(*world, time);
    REQUIRE_FALSE(world->halt());
    return world->reactions()[1].x();
  };
  const double settled = pull(elastic, 0.5);
  CHECK(pull(material, 0.5) == doctest::Approx(settled).epsilon(2e-3));
  CHECK(pull(material, 0.06) > 1.15 * settled);
}

TEST_CASE("a body pulled beyond yield keeps a set when it is let go, a reset takes it back") {
  Material material = sample_material("neo_hookean_iso");
  material.plasticity = Plasticity{60, 0};
  WorldSetup setup = pulled_cube(material, 0.04, 0.2);
  setup.solver.damping = 40;
  auto world = make_world(setup);
  run_until(*world, 0.3);
  REQUIRE_FALSE(world->halt());
  const double held = world->reactions()[1].x();
  Material without = material;
  without.plasticity.reset();
  WorldSetup plain = setup;
  plain.materials[0].material = without;
  auto other = make_world(plain);
  run_until(*other, 0.3);
  CHECK(held < 0.6 * other->reactions()[1].x());
  REQUIRE(world->apply(Reset{}).ok());
  run_until(*world, 0.3);
  CHECK(world->reactions()[1].x() == held);  // the same bits as the first time
}

TEST_CASE("rate effects are the same bits for any number of threads") {
  Material material = sample_material("mooney_rivlin");
  material.relaxation = {{0.5, 0.02}};
  material.viscosity = 1;
  material.plasticity = Plasticity{80, 10};
  std::uint64_t hash = 0;
  for (const int threads : {1, 2, 5}) {
    WorldSetup setup = pulled_cube(material, 0.03, 0.05);
    setup.solver.threads = threads;
    const auto world = make_world(setup);
    run_until(*world, 0.03);
    REQUIRE_FALSE(world->halt());
    if (threads == 1)
      hash = world->state_hash();
    else
      CHECK(world->state_hash() == hash);
  }
}

TEST_CASE("plastic flow within implicit steps is the same bits for any number of threads, in double and float") {
  Material material = sample_material("neo_hookean_iso");
  material.plasticity = Plasticity{60, 10};
  for (const bool single : {false, true}) {
    std::uint64_t hash = 0, of_elastic = 0;
    for (const int threads : {1, 2, 3}) {
      WorldSetup setup = pulled_cube(material, 0.03, 0.05);
      setup.mesh = make_box(Vec3(0.1, 0.1, 0.1), {10, 10, 10});  // enough for more than one thread
      setup.boundary[0].nodes = nodes_where(setup.mesh, 0, 0);
      setup.boundary[1].nodes = nodes_where(setup.mesh, 0, 0.1);
      setup.solver.integrator = single ? Integrator::backward_euler : Integrator::tr_bdf2;
      setup.solver.step = 0.01;
      setup.solver.single_precision = single;
      setup.solver.threads = threads;
      const auto world = make_world(setup);
      run_until(*world, 0.02);
      REQUIRE_FALSE(world->halt());
      if (threads == 1) {
        hash = world->state_hash();
        setup.materials[0].material.plasticity.reset();
        const auto elastic = make_world(setup);
        run_until(*elastic, 0.02);
        of_elastic = elastic->state_hash();
      }
      CHECK(world->state_hash() == hash);
    }
    CHECK(hash != of_elastic);  // it has flown
  }
}

TEST_CASE("plastic flow is part of an implicit step: one long step ends on the yield surface") {
  constexpr double shear = 0.05, yield = 40;
  for (const char* law : {"neo_hookean_iso", "mooney_rivlin", "ogden"})
    for (const Integrator integrator : {Integrator::backward_euler, Integrator::bdf2, Integrator::sdirk2}) {
      CAPTURE(law);
      Material material = sample_material(law);
      material.plasticity = Plasticity{yield, 0};
      WorldSetup setup = cube(material);
      for (std::size_t n = 0; n < setup.mesh.nodes.size(); ++n) {
        const Vec3& X = setup.mesh.nodes[n];
        if ((X.array() > 1e-9).all() && (X.array() < 0.1 - 1e-9).all()) continue;
        Boundary boundary;
        boundary.nodes = {static_cast<int>(n)};
        boundary.translate = Vec3(shear * X.y(), 0, 0);
        setup.boundary.push_back(boundary);
      }
      setup.solver.integrator = integrator;
      setup.solver.step = 10;  // without inertia
      auto world = make_world(setup);
      world->tick();
      REQUIRE_FALSE(world->halt());
      double stress = 0;
      const auto reactions = world->reactions();
      for (std::size_t b = 0; b < reactions.size(); ++b)
        stress += reactions[b].x() * setup.mesh.nodes[static_cast<std::size_t>(setup.boundary[b].nodes[0])].y() / 1e-3;
      CHECK(stress == doctest::Approx(yield / std::sqrt(3.0)).epsilon(0.01));
      CHECK(world->solver_stats().lagging_flow_steps == 0);
    }
}

TEST_CASE("an implicit step far beyond yield that does not converge is taken with the flow after it, and told") {
  Material material = sample_material("fung_demiray");
  material.plasticity = Plasticity{1e-4, 0};
  WorldSetup setup = pulled_cube(material, 0.1, 0.5);
  setup.solver.integrator = Integrator::backward_euler;
  setup.solver.step = 0.25;
  auto world = make_world(setup);
  for (int k = 0; k < 2 && !world->halt(); ++k) world->tick();
  REQUIRE_FALSE(world->halt());
  CHECK(world->solver_stats().lagging_flow_steps > 0);
  CHECK(world->steps() == 2);
}

}  // namespace heml::rate_effects_test
