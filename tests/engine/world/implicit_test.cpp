#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <heml/world/facts.hpp>

#include "engine/materials/sample_materials.hpp"
#include "support.hpp"
#include "world_support.hpp"

namespace heml::implicit_test {

using namespace heml::test;

namespace {

/// A cantilever that falls from rest.
WorldSetup falling(Integrator integrator, double step) {
  WorldSetup setup = cantilever();
  setup.solver.integrator = integrator;
  setup.solver.step = step;
  return setup;
}

std::unique_ptr<World> run(const WorldSetup& setup, double until) {
  auto world = make_world(setup);
  run_until(*world, until);
  if (world->halt()) FAIL(world->halt()->message);
  return world;
}

}  // namespace

TEST_CASE("implicit: each method converges at its order on a falling beam, in positions and velocities") {
  // Under a load that grows, with damping: of what its start sets swinging, the stiff modes that no step here resolves
  // are gone by the end.
  constexpr double end = 0.4;
  WorldSetup smooth = falling(Integrator::verlet, 5e-5);
  smooth.solver.damping = 60;
  smooth.loads.push_back({});
  smooth.gravity.setZero();
  smooth.loads[0].nodes = nodes_where(smooth.mesh, [](const Vec3&) { return true; });
  smooth.loads[0].vector = Vec3(0, -0.4, 0);
  smooth.loads[0].ramp_time = 0.6;
  const auto exact = run(smooth, end);
  for (const Integrator integrator : implicit_integrators()) {
    const double order = info_of(integrator).order;
    CAPTURE(std::string(integrator_name(integrator)));
    std::vector<double> x_error, v_error;
    for (const double step : {0.01, 0.005, 0.0025}) {
      WorldSetup setup = smooth;
      setup.solver.integrator = integrator;
      setup.solver.step = step;
      setup.solver.tolerance = 1e-9;
      const auto world = run(setup, end);
      x_error.push_back(rms_difference(world->positions(), exact->positions()));
      v_error.push_back(rms_difference(world->velocities(), exact->velocities()));
    }
    CHECK(std::log2(x_error[1] / x_error[2]) == doctest::Approx(order).epsilon(0.05));
    CHECK(std::log2(v_error[1] / v_error[2]) >= 0.95 * order);  // of a nearly constant velocity less may be left
  }
}

TEST_CASE("implicit: backward Euler never gains energy, TR-BDF2 loses a few percent in a second") {
  const auto euler = make_world(falling(Integrator::backward_euler, 0.01));
  double before = total(euler->energies());
  for (int k = 0; k < 100; ++k) {
    euler->tick();
    REQUIRE_FALSE(euler->halt());
    const double now = total(euler->energies());
    CHECK(now <= before + 1e-6);
    before = now;
  }
  double swing = 0;
  const auto accurate = make_world(falling(Integrator::tr_bdf2, 0.005));
  for (int k = 0; k < 200; ++k) {
    accurate->tick();
    REQUIRE_FALSE(accurate->halt());
    swing = std::max(swing, std::abs(accurate->energies().potential));
  }
  const double lost = -total(accurate->energies()) / swing;
  MESSAGE("TR-BDF2 at 5 ms lost " << lost << " of what swings in a second");
  CHECK(lost > 0);
  CHECK(lost < 0.05);
}

TEST_CASE("implicit: follows a grasp, and constrained nodes moved at ten metres a second") {
  for (const Integrator integrator : implicit_integrators()) {
    WorldSetup setup = falling(integrator, 0.005);
    Boundary end{nodes_where(setup.mesh, [](const Vec3& X) { return X.x() > 0.0999; })};
    end.translate = Vec3(0.1, 0, 0);
    end.ramp_time = 0.01;
    setup.boundary.push_back(end);
    const auto world = run(setup, 0.1);
    for (const double J : world->volume_ratios()) CHECK(J > 0);

    WorldSetup constrained = falling(integrator, 0.01);
    constrained.gravity.setZero();
    constrained.solver.damping = 20;
    const auto grasped = make_world(constrained);
    const int tip =
        nodes_where(constrained.mesh, [](const Vec3& X) { return (X - Vec3(0.1, 0.02, 0.02)).norm() < 1e-9; })[0];
    CHECK(grasped->apply(Grasp{tip, 0.015}).ok());
    CHECK(grasped->apply(MoveTool{Vec3(0.1, 0.03, 0.02)}).ok());
    run_until(*grasped, 1.0);
    REQUIRE_FALSE(grasped->halt());
    // At rest the tool pulls with what the clamp holds.
    CHECK((tool_of<GraspState>(*grasped).force + grasped->reactions()[0]).norm() <=
          0.01 * tool_of<GraspState>(*grasped).force.norm());
    CHECK(tool_of<GraspState>(*grasped).grip.y() > 0.021);
  }
}

TEST_CASE("implicit: without a step given, a tick is one step") {
  WorldSetup setup = falling(Integrator::tr_bdf2, 0);
  setup.solver.step.reset();
  setup.solver.rate = 100;
  const auto world = run(setup, 0.1);
  CHECK(world->ticks() == 10);
  CHECK(world->steps() == 10);
}

TEST_CASE("implicit: a tolerance out of reach ends in a message, with the last good state") {
  WorldSetup setup = falling(Integrator::backward_euler, 0.01);
  setup.solver.tolerance = 1e-30;
  const auto world = make_world(setup);
  world->tick();
  CHECK(world->ticks() == 0);
  REQUIRE(world->halt());
  CHECK(world->halt()->cause == StopReason::Cause::not_converged);
  CHECK(world->time() == 0);
  CHECK(world->positions() == setup.mesh.nodes);
}

TEST_CASE("implicit: let go at a quarter of its volume, no law turns an element inside out on its way back") {
  for (const char* law : {"hgo", "fung_demiray", "mooney_rivlin", "neo_hookean"})
    for (const bool single : {false, true}) {
      CAPTURE(std::string(law));
      CAPTURE(single);
      WorldSetup setup = falling(Integrator::backward_euler, 0.01);
      setup.mesh = make_box(Vec3(0.1, 0.02, 0.02), {6, 2, 2});
      setup.boundary = {{nodes_where(setup.mesh, [](const Vec3& X) { return X.x() < 1e-9; })}};
      setup.materials[0].material = sample_material(law);
      setup.gravity.setZero();
      setup.solver.single_precision = single;
      for (const Vec3& X : setup.mesh.nodes)
        setup.initial_positions.push_back(X.x() < 1e-9 ? X : X.cwiseProduct(Vec3(1, 0.5, 0.5)));
      const auto world = run(setup, 0.1);
      for (const double J : world->volume_ratios()) CHECK(J > 0);
    }
}

TEST_CASE("implicit: wrung past where it buckles, a bar in float is solved on while steps at round-off add up") {
  WorldSetup setup = falling(Integrator::backward_euler, 0.02);
  setup.materials[0].material = {"mooney_rivlin", {1000, 923, 4167}, 1000};
  setup.gravity.setZero();
  setup.solver.single_precision = true;
  setup.solver.damping = 100;
  Boundary end{nodes_where(setup.mesh, [](const Vec3& X) { return X.x() > 0.0999; })};
  end.translate = Vec3(0.05, 0, 0);
  end.axis = Vec3::UnitX();
  end.origin = Vec3(0, 0.01, 0.01);
  end.degrees = 720;
  end.ramp_time = 1;
  setup.boundary.push_back(end);
  CHECK(run(setup, 1)->time() == doctest::Approx(1));
}

TEST_CASE("implicit: viscosity slows a swing like it does in small explicit steps") {
  const auto setup = [](Integrator integrator, double step) {
    WorldSetup result = falling(integrator, step);
    result.materials[0].material.viscosity = 50;
    return result;
  };
  const auto reference = run(setup(Integrator::verlet, 2e-5), 0.2);
  for (const Integrator integrator : implicit_integrators()) {
    CAPTURE(std::string(integrator_name(integrator)));
    WorldSetup implicit = setup(integrator, 5e-4);
    const auto world = run(implicit, 0.2);
    CHECK(rms_difference(world->positions(), reference->positions()) <=
          0.03 * rms_difference(reference->positions(), implicit.mesh.nodes));
  }
}

TEST_CASE("implicit: the same bits on every run, with any number of threads, in double and float") {
  for (const bool single : {false, true})
    for (const Integrator integrator : {Integrator::backward_euler, Integrator::tr_bdf2}) {
      std::vector<std::uint64_t> hashes;
      for (const int threads : {1, 2, 1}) {
        WorldSetup setup = falling(integrator, 0.01);
        setup.mesh = make_box(Vec3(0.1, 0.02, 0.02), {24, 7, 7});  // enough for more than one thread
        setup.boundary[0].nodes = nodes_where(setup.mesh, [](const Vec3& X) { return X.x() < 1e-9; });
        setup.solver.threads = threads;
        setup.solver.single_precision = single;
        hashes.push_back(run(setup, 0.03)->state_hash());
      }
      CHECK(hashes[0] == hashes[1]);
      CHECK(hashes[0] == hashes[2]);
    }
}

TEST_CASE("auto: explicit where that is fast enough, implicit where it is not") {
  const auto chosen = [](double young, std::optional<double> step) {
    WorldSetup setup = cantilever("neo_hookean", young);
    setup.solver.integrator = Integrator::automatic;
    setup.solver.step = step;
    return std::string(make_world(setup)->solver_stats().integrator);
  };
  CHECK(chosen(1e4, std::nullopt) == "verlet");
  CHECK(chosen(1e4, 1e-5) == "verlet");
  CHECK(chosen(1e4, 0.005) == "tr_bdf2");
  CHECK(chosen(1e9, 0.02) == "backward_euler");
}

TEST_CASE("auto weighs a step by its laws, its terms and its precision, until it is told") {
  const auto cost = [](const std::function<void(WorldSetup&)>& change) {
    WorldSetup setup = cantilever("neo_hookean_iso", 1e4);
    setup.materials.front().material = sample_material("neo_hookean_iso");
    change(setup);
    return make_world(setup)->facts().method.step_cost;
  };
  const double plain = cost([](WorldSetup&) {});
  CHECK(plain > 2e-9);
  CHECK(plain < 40e-9);
  CHECK(cost([](WorldSetup& setup) { setup.solver.single_precision = true; }) < plain);
  CHECK(cost([](WorldSetup& setup) { setup.solver.nodal_pressure = true; }) > plain);
  const auto with = [&](const auto& change) {
    return cost([&](WorldSetup& setup) { change(setup.materials.front().material); });
  };
  CHECK(with([](Material& material) { material = sample_material("ogden"); }) > 5 * plain);
  const double viscous = with([](Material& material) { material.viscosity = 1; });
  CHECK(viscous > plain);
  const double relaxing = with([](Material& material) { material.relaxation = {{0.3, 0.1}}; });
  CHECK(relaxing > viscous);
  CHECK(relaxing < 3 * plain);
  const double plastic = with([](Material& material) { material.plasticity = Plasticity{1e6, 0}; });
  CHECK(plastic > plain);
  CHECK(plastic < 2 * plain);
  CHECK(with([](Material& material) {
          material.plasticity = Plasticity{1e6, 0};
          material.relaxation = {{0.3, 0.1}};
        }) == doctest::Approx(plastic + relaxing - plain));
  WorldSetup setup = cantilever("neo_hookean", 1e4);
  const auto world = make_world(setup);
  world->apply(SetStepCost{25});
  CHECK(world->facts().method.step_cost == doctest::Approx(25e-9));
}

TEST_CASE("implicit: steps of second order that are long for what they pass gain no energy") {
  for (const Integrator integrator : {Integrator::bdf2, Integrator::tr_bdf2, Integrator::sdirk2})
    for (const double squeeze : {0.5, 2.5}) {
      CAPTURE(std::string(integrator_name(integrator)));
      CAPTURE(squeeze);
      WorldSetup setup = falling(integrator, 0.02);
      setup.gravity.setZero();
      setup.materials.front().material = sample_material("neo_hookean");
      for (const Vec3& X : setup.mesh.nodes) setup.initial_positions.push_back(Vec3(squeeze * X.x(), X.y(), X.z()));
      const auto world = make_world(setup);
      const auto energy = [&] {
        const Energies now = world->energies();
        return now.kinetic + now.elastic + now.potential;
      };
      const double start = energy();
      REQUIRE(start > 0);
      double before = start;
      for (int k = 0; k < 40; ++k) {
        world->tick();
        REQUIRE(!world->halt());
        CHECK(energy() <= before + 1e-8 * start);
        before = energy();
      }
    }
}

}  // namespace heml::implicit_test
