// Ticks whose implicit steps do not converge: explicit substeps or the best iterate end them.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <chrono>
#include <cmath>
#include <thread>

#include "world_support.hpp"

namespace heml::step_rescue_test {

using namespace heml::test;

namespace {

/// No step converges to such a tolerance.
constexpr double out_of_reach = 1e-30;

/// young: Pa; 1e4 allows explicit substeps, 1e9 would need more than max_explicit_substeps.
WorldSetup hopeless(Integrator integrator, double young = 1e4) {
  WorldSetup setup = cantilever("neo_hookean", young);
  setup.solver.integrator = integrator;
  setup.solver.rate = 60;
  setup.solver.tolerance = out_of_reach;
  return setup;
}

/// A block that lies on another, turned about the vertical.
WorldSetup blocks(Integrator integrator, double friction) {
  constexpr double side = 0.04;
  WorldSetup setup;
  setup.mesh = make_box(Vec3(side, 0.75 * side, side), {4, 3, 4});
  Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
  place.translate(Vec3(side / 2, 0.75 * side + 2e-4, side / 2));
  place.rotate(Eigen::AngleAxisd(0.4, Vec3::UnitY()));
  place.translate(Vec3(-0.4 * side, 0, -0.4 * side));
  add(setup.mesh, make_box(Vec3(0.8 * side, side / 2, 0.8 * side), {5, 2, 4}), place);
  setup.materials = {{std::nullopt, soft("neo_hookean", 2e4, 0.45)}};
  setup.boundary.push_back({nodes_where(setup.mesh, [](const Vec3& X) { return X.y() < 1e-6; })});
  setup.gravity = Vec3(0, -9.81, 0);
  setup.self_contact = SelfContactSettings{friction};
  setup.solver.integrator = integrator;
  setup.solver.rate = 60;
  setup.solver.threads = 1;
  return setup;
}

/// Along a slanted plane, through both blocks.
const CutTissue through_both{
    {{{Vec3(0.008, 0.051, -1), Vec3(0.008, 0.051, 1)}, {Vec3(0.032, 0.006, -1), Vec3(0.032, 0.006, 1)}}}, false};

}  // namespace

TEST_CASE("step rescue: explicit substeps end a tick that does not converge, as Verlet would") {
  for (const auto integrator :
       {Integrator::backward_euler, Integrator::bdf2, Integrator::tr_bdf2, Integrator::sdirk2}) {
    CAPTURE(std::string(integrator_name(integrator)));
    const auto world = make_world(hopeless(integrator));
    WorldSetup verlet = hopeless(Integrator::verlet);
    verlet.solver.tolerance.reset();
    const auto reference = make_world(verlet);
    for (World* each : {world.get(), reference.get()}) run_until(*each, 0.25);
    REQUIRE_FALSE(world->halt());
    CHECK(world->time() == doctest::Approx(0.25));
    const SolverStats stats = world->solver_stats();
    CHECK(stats.explicit_rescues == world->ticks());
    CHECK(stats.unconverged_steps == 0);
    CHECK(stats.residual == 0);  // of explicit steps, not of the last that failed
    CHECK(std::string(stats.integrator) == integrator_name(integrator));
    CHECK(rms_difference(world->positions(), reference->positions()) < 5e-4);
    CHECK(rescue_message(stats).find("explicit substeps ended 15 of the ticks") != std::string::npos);
  }
}

TEST_CASE("step rescue: an interrupt leaves the tick unfinished, wherever it comes") {
  using Clock = std::chrono::steady_clock;
  const WorldSetup setup = hopeless(Integrator::backward_euler, 1e9);
  const auto start = Clock::now();
  make_world(setup)->tick();
  const Clock::duration whole = Clock::now() - start;
  constexpr int moments = 60;
  for (int k = 0; k < moments; ++k) {
    CAPTURE(k);
    const auto world = make_world(setup);
    std::thread user([&] {
      std::this_thread::sleep_for(whole * k / moments);
      world->interrupt();
    });
    world->tick();
    user.join();
    CHECK_FALSE(world->halt());
    CHECK(world->unfinished() == (world->ticks() == 0));
    CHECK(world->solver_stats().unconverged_steps == world->ticks());
  }
}

TEST_CASE("step rescue: where substeps would be too many, the best iterate is taken and no energy gained") {
  WorldSetup setup = hopeless(Integrator::backward_euler, 1e9);
  const auto world = make_world(setup);
  const double start = total(world->energies());
  double most = start;
  for (int tick = 0; tick < 15; ++tick) {
    world->tick();
    most = std::max(most, total(world->energies()));
  }
  REQUIRE_FALSE(world->halt());
  const SolverStats stats = world->solver_stats();
  CHECK(stats.unconverged_steps == 15);
  CHECK(stats.explicit_rescues == 0);
  CHECK(stats.unconverged_residual > 0);
  CHECK(most <= start + 1e-10);
  setup.solver.tolerance.reset();
  const auto converged = make_world(setup);
  run_until(*converged, 0.25);
  CHECK(rms_difference(world->positions(), converged->positions()) < 1e-8);
}

TEST_CASE("step rescue: steps that converge are counted as such") {
  WorldSetup setup = hopeless(Integrator::backward_euler);
  setup.solver.tolerance.reset();
  const auto world = make_world(setup);
  run_until(*world, 0.25);
  CHECK(world->solver_stats().explicit_rescues == 0);
  CHECK(world->solver_stats().unconverged_steps == 0);
  CHECK(rescue_message(world->solver_stats()).empty());
}

TEST_CASE("step rescue: a given step is obeyed, and halts where it does not converge") {
  for (const double young : {1e4, 1e9}) {
    WorldSetup setup = hopeless(Integrator::backward_euler, young);
    setup.solver.step = 1.0 / 60;
    const auto world = make_world(setup);
    world->tick();
    REQUIRE(world->halt());
    CHECK(world->halt()->cause == StopReason::Cause::not_converged);
    CHECK(world->solver_stats().explicit_rescues + world->solver_stats().unconverged_steps == 0);
  }
}

TEST_CASE("step rescue: a law that supports leave no room for halts, unless it is continued") {
  WorldSetup setup = hopeless(Integrator::backward_euler);
  setup.solver.tolerance.reset();
  setup.gravity.setZero();
  // Every corner of the elements at the clamp is held: once the second layer of nodes is through it, they are inverted.
  setup.boundary.push_back({nodes_where(setup.mesh, [](const Vec3& X) { return X.x() > 1e-9 && X.x() < 0.05; })});
  setup.boundary.back().translate = Vec3(-0.015, 0, 0);
  setup.boundary.back().ramp_time = 0.1;
  const auto halted = make_world(setup);
  run_until(*halted, 0.2);
  REQUIRE(halted->halt());
  CHECK(halted->halt()->cause == StopReason::Cause::out_of_range);
  for (const double J : halted->volume_ratios()) CHECK(J > 0);
  setup.solver.continuation = true;
  const auto continued = make_world(setup);
  run_until(*continued, 0.2);
  CHECK_FALSE(continued->halt());
}

TEST_CASE("step rescue: recovery begins first where the body is in bad shape") {
  WorldSetup setup = hopeless(Integrator::backward_euler);
  setup.solver.recovery = setup.solver.continuation = true;
  setup.gravity.setZero();
  for (const Vec3& X : setup.mesh.nodes) setup.initial_positions.push_back(Vec3(X.x() * 0.2, X.y(), X.z()));
  const auto bad = make_world(setup);
  bad->tick();
  CHECK(bad->recoveries() == 1);
  CHECK(bad->solver_stats().explicit_rescues == 0);
  setup.initial_positions.clear();
  setup.gravity = Vec3(0, -9.81, 0);
  const auto good = make_world(setup);
  good->tick();
  CHECK(good->recoveries() == 0);
  CHECK(good->solver_stats().explicit_rescues == 1);
  CHECK_FALSE(good->halt());
}

TEST_CASE("step rescue: any number of threads and a reset give the same bits, with what elements remember") {
  for (const double young : {1e4, 1e9}) {
    WorldSetup setup = hopeless(Integrator::tr_bdf2, young);
    setup.materials[0].material.viscosity = 1;
    const auto one = make_world(setup);
    setup.solver.threads = 2;
    const auto two = make_world(setup);
    for (World* each : {one.get(), two.get()}) run_until(*each, 0.1);
    REQUIRE_FALSE(one->halt());
    CHECK(one->state_hash() == two->state_hash());
    const auto hash = one->state_hash();
    one->apply(Reset{});
    run_until(*one, 0.1);
    CHECK(one->state_hash() == hash);
  }
}

TEST_CASE("step rescue: blocks cut through where they bear on each other end the tick, with friction too") {
  for (const double friction : {0.0, 0.3, 0.8}) {
    CAPTURE(friction);
    WorldSetup setup = blocks(Integrator::tr_bdf2, friction);
    long iterations = 0;  // of the tick after the cut
    const auto run = [&](const WorldSetup& of) {
      auto world = make_world(of);
      run_until(*world, 0.2);
      REQUIRE_FALSE(world->halt());
      world->apply(through_both);
      REQUIRE(world->edits().size() == 1);
      iterations = world->solver_stats().iterations;
      world->tick();
      iterations = world->solver_stats().iterations - iterations;
      return world;
    };
    const auto world = run(setup);
    MESSAGE(iterations << " iterations");
    const bool may_lock = friction > 0.5;  // friction raises the forces that bound it
    CHECK(iterations < (may_lock ? 500 : 200));
    REQUIRE_FALSE(world->halt());
    CHECK(world->ticks() == 13);
    CHECK(world->solver_stats().explicit_rescues <= (may_lock ? 1 : 0));
    const Energies energies = world->energies();
    CHECK(energies.kinetic + energies.elastic < 2e-3);  // what the pieces can fall
    for (const double J : world->volume_ratios()) CHECK(J > 0.3);
    setup.solver.step = 1.0 / 60;
    const auto given = run(setup);
    CHECK_FALSE(given->halt());
  }
}

}  // namespace heml::step_rescue_test
