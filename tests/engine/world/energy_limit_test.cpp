// What a step has gained in energy is taken from motion within bodies: not from that of bodies as a whole.
#include <doctest/doctest.h>

#include <cmath>

#include "world_support.hpp"

namespace heml::energy_limit_test {

using namespace heml::test;

namespace {

/// A box, stretched and sheared, that is let go with a velocity.
WorldSetup stretched(const Material& material, Integrator integrator) {
  WorldSetup setup;
  setup.mesh = make_box(Vec3(0.1, 0.06, 0.04), {3, 2, 2});
  setup.materials = {{std::nullopt, material}};
  setup.solver.integrator = integrator;
  setup.solver.threads = 1;
  setup.initial_velocity = Vec3(1, 0, 0);
  Mat3 F;
  F << 1.2, 0, 0, 0.2, 0.9, 0, 1.0 / 30, 0, 7.0 / 6;
  for (const Vec3& X : setup.mesh.nodes) setup.initial_positions.push_back(F * X);
  return setup;
}

Material relaxing() {
  Material material{"mooney_rivlin", {610, 200, 3e4}, 1000};
  material.relaxation = {{0.5, 0.05}};
  return material;
}

/// Σ m v / Σ m, m/s.
Vec3 mean_velocity(const World& world) {
  const WorldSetup& setup = world.setup();
  const auto v = world.velocities();
  Vec3 sum = Vec3::Zero();
  double mass = 0;
  for (const Tet& tet : setup.mesh.tets) {
    const auto X = [&](std::size_t c) { return setup.mesh.nodes[static_cast<std::size_t>(tet[c])]; };
    const double m = signed_volume(X(0), X(1), X(2), X(3)) / 4;
    for (const int n : tet) sum += m * v[static_cast<std::size_t>(n)];
    mass += 4 * m;
  }
  return sum / mass;
}

}  // namespace

TEST_CASE("long steps of a stretched body that is let go keep its momentum, of every implicit method") {
  for (const auto integrator : moving_integrators()) {
    if (is_explicit(integrator)) continue;
    for (const Material& material : {soft("stvk", 1e4, 0.4), Material{"fung_demiray", {3000, 3, 5e4}, 1000}}) {
      CAPTURE(std::string(integrator_name(integrator)));
      CAPTURE(material.law);
      WorldSetup setup = stretched(material, integrator);
      setup.solver.step = 0.05;
      auto world = make_world(setup);
      for (int k = 0; k < 20 && !world->halt(); ++k) world->tick();
      REQUIRE_FALSE(world->halt());
      CHECK((mean_velocity(*world) - Vec3(1, 0, 0)).norm() < 1e-3);
    }
  }
}

TEST_CASE("a body in free fall keeps its momentum under a budget of one iteration of backward Euler") {
  WorldSetup setup = stretched(soft("neo_hookean", 1e4, 0.4), Integrator::backward_euler);
  setup.solver.rate = 60;
  setup.gravity = Vec3(0, -9.81, 0);
  setup.solver.budget = Budget{};
  setup.solver.budget->iterations = 1;
  auto world = make_world(setup);
  for (int k = 0; k < 60; ++k) world->tick();
  REQUIRE_FALSE(world->halt());
  CHECK((mean_velocity(*world) - Vec3(1, -9.81, 0)).norm() < 1e-3);
}

TEST_CASE("a body at rest in itself falls under a budget, by its true weight and its heavier masses, of every method") {
  for (const auto integrator : moving_integrators())
    for (const bool quadratic : {false, true})
      for (const double scaling : {0.0, 0.05}) {
        if (is_explicit(integrator)) continue;
        CAPTURE(std::string(integrator_name(integrator)));
        CAPTURE(quadratic);
        CAPTURE(scaling);
        WorldSetup setup = stretched(soft("neo_hookean", 1e4, 0.4), integrator);
        setup.initial_positions.clear();
        setup.solver.quadratic = quadratic;
        if (quadratic) setup.midedges = add_midedge_nodes(setup.mesh);
        setup.solver.rate = 60;
        setup.solver.mass_scaling = scaling;
        setup.gravity = Vec3(0, -9.81, 0);
        setup.solver.budget = Budget{};
        setup.solver.budget->iterations = 1;
        auto world = make_world(setup);
        for (int k = 0; k < 30; ++k) world->tick();
        REQUIRE_FALSE(world->halt());
        CHECK(mean_velocity(*world).x() == doctest::Approx(1).epsilon(0.03));
        CHECK(mean_velocity(*world).y() == doctest::Approx(-9.81 * 0.5 / (1 + scaling)).epsilon(0.05));
      }
}

TEST_CASE("a body that falls on a table without friction slides on under a budget of one iteration") {
  WorldSetup setup;
  setup.mesh = make_box(Vec3::Constant(0.06), {3, 3, 3});
  setup.materials = {{std::nullopt, soft("neo_hookean", 1e4, 0.45)}};
  setup.solver.integrator = Integrator::backward_euler;
  setup.solver.rate = 60;
  setup.solver.threads = 1;
  setup.solver.budget = Budget{};
  setup.solver.budget->iterations = 1;
  setup.tables = {{Vec3(0, -0.05, 0), Vec3::UnitY(), 0}};
  setup.gravity = Vec3(0, -9.81, 0);
  setup.initial_velocity = Vec3(0.5, 0, 0);
  auto world = make_world(setup);
  for (int k = 0; k < 60; ++k) world->tick();
  REQUIRE_FALSE(world->halt());
  CHECK(mean_velocity(*world).x() == doctest::Approx(0.5).epsilon(1e-3));
  CHECK(std::abs(mean_velocity(*world).y()) < 0.05);
}

TEST_CASE("a body on a table without friction stays there under a budget, of every implicit method") {
  for (const Integrator integrator : implicit_integrators())
    for (const bool single : {false, true})
      for (const int iterations : {1, 2}) {
        WorldSetup setup;
        setup.mesh = make_box(Vec3::Constant(0.03), {1, 1, 1});
        setup.materials = {{std::nullopt, soft("neo_hookean", 3e4, 0.3)}};
        setup.solver.integrator = integrator;
        setup.solver.single_precision = single;
        setup.solver.threads = 1;
        setup.solver.budget = Budget{iterations, 0};
        setup.tables = {{Vec3::Zero(), Vec3::UnitY(), 0}};
        setup.gravity = Vec3(0, -9.81, 0);
        auto world = make_world(setup);
        while (world->time() < 4) world->tick();
        CAPTURE(std::string(integrator_name(integrator)));
        CAPTURE(single);
        REQUIRE_FALSE(world->halt());
        CHECK(rms_difference(world->positions(), setup.mesh.nodes) < 1e-3);
        CHECK(world->energies().kinetic < 1e-5);
      }
}

TEST_CASE("viscous and relaxing bodies that are let go dilated gain no energy, of every implicit method") {
  Material viscous = soft("neo_hookean", 4e4, 0.49), relaxing = viscous;
  viscous.viscosity = 14;
  relaxing.law = "neo_hookean_iso";
  relaxing.parameters = {6700, 6.6e5};
  relaxing.relaxation = {{0.4, 0.02}};
  for (const auto integrator : moving_integrators()) {
    if (is_explicit(integrator)) continue;
    for (const Material& material : {viscous, relaxing}) {
      CAPTURE(std::string(integrator_name(integrator)));
      CAPTURE(material.viscosity);
      WorldSetup setup;
      setup.mesh = make_box(Vec3::Constant(0.04), {1, 1, 1});
      setup.materials = {{std::nullopt, material}};
      setup.solver.integrator = integrator;
      setup.solver.rate = 100;
      setup.solver.threads = 1;
      for (const Vec3& X : setup.mesh.nodes) setup.initial_positions.push_back(1.05 * X);
      auto world = make_world(setup);
      const auto energy = [&] {
        const Energies now = world->energies();
        return now.kinetic + now.elastic;
      };
      const double start = energy();
      // Branches of relaxation have more stored than the law tells, and give it up on their way.
      const double stored = material.relaxation.empty() ? start : 1.4 * start;
      for (int k = 0; k < 20; ++k) {
        world->tick();
        REQUIRE_FALSE(world->halt());
        CHECK(energy() <= stored * (1 + 1e-8));
      }
      CHECK(energy() < 0.1 * start);
    }
  }
}

TEST_CASE("relaxing tissue that begins inside out gains no more energy than elastic tissue could") {
  for (const auto integrator : {Integrator::backward_euler, Integrator::bdf2, Integrator::tr_bdf2, Integrator::sdirk2})
    for (const double across : {0.6, 0.9, 1.4}) {
      WorldSetup setup;
      setup.mesh = make_box(Vec3::Constant(0.03), {2, 2, 2});
      setup.materials = {{std::nullopt, relaxing()}};
      setup.solver.integrator = integrator;
      setup.solver.rate = 60;
      setup.solver.threads = 1;
      setup.initial_positions = setup.mesh.nodes;
      setup.initial_positions[13] += across * Vec3(0.03, 0.02, 0.01);  // the node in the middle
      auto world = make_world(setup);
      REQUIRE(inverted(*world) > 0);
      const double start = world->energies().elastic;
      CAPTURE(std::string(integrator_name(integrator)));
      CAPTURE(across);
      for (int k = 0; k < 30; ++k) {
        world->tick();
        REQUIRE_FALSE(world->halt());
        // Branches begin relaxed: they store as much again as their part of the law.
        CHECK(world->energies().kinetic + world->energies().elastic <= 1.5 * start);
      }
    }
}

TEST_CASE("a hand that lets go turns no relaxing tissue inside out in one step") {
  WorldSetup setup = cantilever();
  setup.mesh = make_box(Vec3(0.1, 0.02, 0.02), {8, 2, 2});
  setup.boundary = {{nodes_where(setup.mesh, [](const Vec3& X) { return X.x() < 1e-9; })}};
  setup.materials = {{std::nullopt, relaxing()}};
  setup.solver.integrator = Integrator::tr_bdf2;
  setup.solver.rate = 60;
  setup.solver.damping = 3;
  auto world = make_world(setup);
  const int corner = static_cast<int>(setup.mesh.nodes.size()) - 1;
  for (int tick = 0; tick < 63; ++tick) {
    if (tick == 3) REQUIRE(world->apply(Grasp{corner, 0.012}).ok());
    if (tick == 13) REQUIRE(world->apply(MoveTool{Vec3(0.02, 0.05, 0.05)}).ok());
    if (tick == 23) REQUIRE(world->apply(MoveTool{Vec3(0.1, 0.02, 0.02)}).ok());
    if (tick == 33) REQUIRE(world->apply(Release{}).ok());
    world->tick();
    CHECK(inverted(*world) == 0);
    CHECK(world->energies().elastic < 0.05);  // J; 0.0086 while the hand pulls, in steps of Verlet
  }
  CHECK(world->solver_stats().unconverged_steps == 0);
}

TEST_CASE("after flow and an edit, steps still balance the forces of what is left") {
  Material material = soft();
  material.law = "fung_demiray";
  material.parameters = {1500, 3, 5e4};
  material.plasticity = Plasticity{1000, 200};
  WorldSetup setup = cantilever();
  setup.materials = {{std::nullopt, material}};
  setup.solver.integrator = Integrator::backward_euler;
  setup.solver.rate = 60;
  auto world = make_world(setup);
  for (int tick = 0; tick < 20; ++tick) world->tick();
  REQUIRE(world->apply(RemoveElements{{{}, {}, std::array{Vec3(0.04, -1, -1), Vec3(0.06, 1, 1)}, {}}}).ok());
  for (int tick = 0; tick < 10; ++tick) {
    world->tick();
    REQUIRE_FALSE(world->halt());
    CHECK(world->solver_stats().residual <= 1e-8);
  }
  CHECK(world->solver_stats().unconverged_steps == 0);
}

}  // namespace heml::energy_limit_test
