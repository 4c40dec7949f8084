// Tissue that is cut while it lives.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "support.hpp"
#include "world_support.hpp"

namespace heml::cut_test {

using namespace heml::test;

namespace {

/// A blade along z from one place to another, of the plane z = 0.
CutTissue stroke(const Vec3& from, const Vec3& to, bool continues_stroke = false) {
  const Vec3 below(0, 0, -1), above(0, 0, 1);
  return {{{{from + below, from + above}, {to + below, to + above}}}, continues_stroke};
}

/// A cantilever stretched and bent by hand, in motion.
WorldSetup moving(Integrator integrator = Integrator::verlet) {
  WorldSetup setup = cantilever();
  setup.solver.integrator = integrator;
  setup.solver.continuation = true;
  setup.initial_velocity = Vec3(0.1, 0, 0.2);
  for (const Vec3& X : setup.mesh.nodes)
    setup.initial_positions.push_back(Vec3(1.1 * X.x(), X.y() - 2 * X.x() * X.x(), X.z()));
  return setup;
}

double mass_of(const World& world) {
  const WorldSetup& setup = world.setup();
  double mass = 0;
  for (const int t : world.topology()->elements) {
    const Tet& tet = setup.mesh.tets[static_cast<std::size_t>(t)];
    const auto X = [&](std::size_t c) { return setup.mesh.nodes[static_cast<std::size_t>(tet[c])]; };
    mass += 1000 * signed_volume(X(0), X(1), X(2), X(3));
  }
  return mass;
}

/// Σ m v with lumped masses, kg m/s.
Vec3 momentum_of(const World& world) {
  const WorldSetup& setup = world.setup();
  const auto v = world.velocities();
  Vec3 sum = Vec3::Zero();
  for (const int t : world.topology()->elements) {
    const Tet& tet = setup.mesh.tets[static_cast<std::size_t>(t)];
    const auto X = [&](std::size_t c) { return setup.mesh.nodes[static_cast<std::size_t>(tet[c])]; };
    const double mass = 1000 * signed_volume(X(0), X(1), X(2), X(3));
    for (const int n : tet) sum += mass / 4 * v[static_cast<std::size_t>(n)];
  }
  return sum;
}

}  // namespace

TEST_CASE("what a cut has laid bare rests on a table") {
  constexpr double cut_at = 0.052, table = 0.045;  // m, between two layers of nodes, and below
  for (const Integrator integrator : {Integrator::verlet, Integrator::backward_euler}) {
    CAPTURE(integrator_name(integrator));
    WorldSetup setup = cantilever();
    setup.solver.integrator = integrator;
    setup.solver.damping = 20;
    setup.gravity = Vec3(-9.81, 0, 0);
    setup.boundary.clear();
    setup.tables = {{Vec3(table, 0, 0), Vec3::UnitX(), 0.4}};
    const auto world = make_world(setup);
    REQUIRE(world->apply(stroke(Vec3(cut_at, -1, 0), Vec3(cut_at, 1, 0))).ok());
    REQUIRE(world->apply(RemoveElements{{{}, {}, std::array{Vec3(-1, -1, -1), Vec3(cut_at, 1, 1)}, {}}}).ok());
    run_until(*world, 0.3);
    REQUIRE_FALSE(world->halt());
    const auto x = world->positions();
    double lowest = 1;
    for (const int t : world->topology()->elements)
      for (const int n : world->setup().mesh.tets[static_cast<std::size_t>(t)])
        lowest = std::min(lowest, x[static_cast<std::size_t>(n)].x());
    CHECK(lowest >= table - (is_explicit(integrator) ? 1e-12 : 1e-5));
    CHECK(lowest <= table + 1e-3);
  }
}

TEST_CASE("a cut keeps mass, momentum and elastic energy, and is reported") {
  for (const bool single : {false, true}) {
    WorldSetup setup = moving();
    setup.boundary.clear();
    setup.solver.single_precision = single;
    const auto world = make_world(setup);
    run_until(*world, 0.02);
    const double mass = mass_of(*world);
    const Energies before = world->energies();
    const Vec3 momentum = momentum_of(*world);
    const double noise = single ? 1e-5 : 1e-12;
    REQUIRE(world->apply(stroke(Vec3(0.047, -1, 0), Vec3(0.047, 1, 0))).ok());
    CHECK(mass_of(*world) == doctest::Approx(mass).epsilon(1e-12));
    CHECK((momentum_of(*world) - momentum).norm() <= 10 * noise * momentum.norm());
    const Energies after = world->energies();
    CHECK(after.elastic == doctest::Approx(before.elastic).epsilon(10 * noise));
    CHECK(after.potential == doctest::Approx(before.potential).epsilon(10 * noise));
    // Lumped masses move within an element when it is split: what there is of vibration may change a little.
    CHECK(after.kinetic == doctest::Approx(before.kinetic).epsilon(0.02));
    REQUIRE(world->edits().size() == 1);
    const EditReport& report = world->edits()[0];
    CHECK(report.tick == 20);
    CHECK(report.removed == 0);
    CHECK(report.mass == 0);
    CHECK(report.split > 0);
    CHECK(report.pieces >= report.split);
    CHECK(report.area == doctest::Approx(0.02 * 0.02).epsilon(0.5));
    CHECK(report.min_angle >= 8);
    CHECK(report.step_before > 0);
    CHECK(report.step_after <= report.step_before);
    CHECK(report.before.elastic == before.elastic);
    CHECK(report.after.elastic == after.elastic);
    CHECK(world->positions().size() == world->setup().mesh.nodes.size());
    run_until(*world, 0.1);
    CHECK_FALSE(world->halt());
  }
}

TEST_CASE("a severed part falls and the constrained part stays, under every integrator") {
  for (const Integrator integrator : moving_integrators()) {
    CAPTURE(integrator_name(integrator));
    WorldSetup setup = cantilever();
    setup.solver.integrator = integrator;
    if (!is_explicit(integrator)) setup.solver.rate = 200;
    setup.solver.damping = 2;
    const auto world = make_world(setup);
    run_until(*world, 0.05);
    REQUIRE(world->apply(stroke(Vec3(0.047, -1, 0), Vec3(0.047, 1, 0))).ok());
    run_until(*world, 0.35);
    REQUIRE_FALSE(world->halt());
    const auto x = world->positions();
    const double fall = 0.5 * 9.81 * 0.3 * 0.3;
    for (const std::size_t end : {std::size_t(10), x.size()}) {  // of the free end; any of the held part
      if (end == 10) CHECK(x[10].y() < -0.6 * fall);
      if (end == 10) CHECK(x[0] == setup.mesh.nodes[0]);
    }
    CHECK(x[2].y() > -0.02);
  }
}

TEST_CASE("a cut opens under tension") {
  WorldSetup setup = cantilever("neo_hookean", 1e4);
  setup.gravity.setZero();
  Boundary pulled{nodes_where(setup.mesh, [](const Vec3& X) { return X.x() > 0.0999; })};
  pulled.translate = Vec3(0.02, 0, 0);
  setup.boundary.push_back(pulled);
  setup.solver.damping = 20;
  const auto world = make_world(setup);
  run_until(*world, 0.3);
  REQUIRE(world->apply(stroke(Vec3(0.055, 0.1, 0), Vec3(0.055, 0.0105, 0))).ok());  // half through, from above
  const auto nodes = world->setup().mesh.nodes.size();
  CHECK(nodes > setup.mesh.nodes.size());
  run_until(*world, 0.8);
  REQUIRE_FALSE(world->halt());
  // Two nodes that were one at rest, at the upper face, are apart; the body still hangs together.
  const auto& rest = world->setup().mesh.nodes;
  const auto x = world->positions();
  double widest = 0;
  for (std::size_t a = 0; a < nodes; ++a)
    for (std::size_t b = a + 1; b < nodes; ++b)
      if (rest[a] == rest[b]) widest = std::max(widest, (x[a] - x[b]).norm());
  MESSAGE("the cut is " << 1e3 * widest << " mm wide");
  CHECK(widest > 2e-3);
  const double force = world->reactions()[1].x();
  CHECK(force > 0.1 * 1e4 * 0.2 * 4e-4);
  CHECK(force < 1e4 * 0.2 * 4e-4);
}

TEST_CASE("a stroke in many sweeps is one edit, and undo brings back what was before it") {
  const auto world = make_world(moving());
  const auto untouched = make_world(moving());
  run_until(*world, 0.02);
  run_until(*untouched, 0.02);
  const auto before = world->positions();
  const auto elements = world->topology()->elements;
  const long version = world->topology()->version;
  for (int k = 0; k < 8; ++k) {
    const auto at = [](int m) { return Vec3(0.052, 0.03 - 0.06 * m / 8, 0); };
    REQUIRE(world->apply(stroke(at(k), at(k + 1), k > 0)).ok());
    if (!world->edits().empty()) world->tick();
  }
  CHECK(world->edits().size() == 1);
  CHECK(world->setup().mesh.nodes.size() > before.size());
  REQUIRE(world->apply(Undo{}).ok());
  CHECK(world->edits().empty());
  CHECK(world->positions() == before);
  CHECK(world->velocities() == untouched->velocities());
  CHECK(world->topology()->elements == elements);
  CHECK(world->topology()->version > version);
  CHECK(world->setup().mesh.nodes.size() == before.size());
  CHECK(world->energies().elastic == untouched->energies().elastic);
  CHECK(world->apply(Undo{}).message().find("nothing was cut") != std::string::npos);
  // Removals are undone too, one after the other.
  REQUIRE(world->apply(RemoveElements{{{1, 2, 3}, {}, {}, {}}}).ok());
  REQUIRE(world->apply(RemoveElements{{{7}, {}, {}, {}}}).ok());
  REQUIRE(world->apply(Undo{}).ok());
  CHECK(removed_count(*world) == 3);
  REQUIRE(world->apply(Reset{}).ok());
  CHECK(removed_count(*world) == 0);
  CHECK(world->topology()->elements == elements);
}

TEST_CASE("constrained nodes stay constrained on both sides of a cut, and loads keep their sum") {
  WorldSetup setup = cantilever();
  Load force;
  force.nodes = nodes_where(setup.mesh, [](const Vec3& X) { return X.x() > 0.0999; });
  force.vector = Vec3(0, 0, 0.01);
  Load traction;
  traction.kind = Load::Kind::traction;
  traction.nodes = nodes_where(setup.mesh, [](const Vec3& X) { return X.y() > 0.0199; });
  traction.vector = Vec3(0, 0, 5);
  setup.gravity.setZero();
  setup.loads = {force, traction};
  setup.solver.integrator = Integrator::backward_euler;
  setup.solver.rate = 100;
  setup.solver.damping = 10;
  const auto world = make_world(setup);
  // Lengthwise, through the held face and the loaded one: z = 0.009 over all of x, and on to z = 1.
  const CutTissue lengthwise{{{{Vec3(-1, -1, 0.009), Vec3(-1, 1, 0.009)}, {Vec3(1, -1, 0.009), Vec3(1, 1, 0.009)}}},
                             false};
  REQUIRE(world->apply(lengthwise).ok());
  CHECK(world->setup().boundary[0].nodes.size() > setup.boundary[0].nodes.size());
  for (int k = 0; k < 300; ++k) world->tick();
  REQUIRE_FALSE(world->halt());
  CHECK(world->reactions()[0].z() == doctest::Approx(-(0.01 + 5 * 0.1 * 0.02)).epsilon(1e-3));
  const auto x = world->positions();
  for (const int n : world->setup().boundary[0].nodes)
    CHECK((x[static_cast<std::size_t>(n)] - world->setup().mesh.nodes[static_cast<std::size_t>(n)]).norm() <= 1e-15);
}

TEST_CASE("a blade through the air does nothing, and one that makes no sense is refused") {
  const auto world = make_world(cantilever());
  const auto version = world->topology()->version;
  CHECK(world->apply(stroke(Vec3(5, 0, 0), Vec3(5, 1, 0))).ok());
  CHECK(world->topology()->version == version);
  CHECK(world->edits().empty());
  CHECK(world->apply(CutTissue{}).message().find("two times") != std::string::npos);
  CHECK(world->apply(stroke(Vec3(NAN, 0, 0), Vec3(5, 1, 0))).message().find("not finite") != std::string::npos);
}

TEST_CASE("a body can be cut during recovery, when grasped and in statics") {
  WorldSetup setup = moving(Integrator::backward_euler);
  setup.solver.rate = 100;
  setup.solver.recovery = true;
  for (Vec3& x : setup.initial_positions)
    if (x.x() > 0.05) x.x() = 0.1 - x.x();
  const auto crushed = make_world(setup);
  crushed->tick();
  REQUIRE(crushed->recovery());
  REQUIRE(crushed->apply(stroke(Vec3(0.03, -1, 0), Vec3(0.03, 1, 0))).ok());
  for (int k = 0; k < 200 && !crushed->recovery()->ended; ++k) crushed->tick();
  CHECK(crushed->recovery()->ended);

  const auto grasped = make_world(cantilever());
  REQUIRE(grasped->apply(Grasp{98, 0.012}).ok());
  REQUIRE(grasped->apply(MoveTool{Vec3(0.13, 0.02, 0.02)}).ok());
  run_until(*grasped, 0.05);
  REQUIRE(grasped->apply(stroke(Vec3(0.052, -1, 0), Vec3(0.052, 1, 0))).ok());
  run_until(*grasped, 0.3);
  CHECK_FALSE(grasped->halt());
  CHECK(has_tool<GraspState>(*grasped));

  WorldSetup still = cantilever("neo_hookean", 1e5);
  still.solver.integrator = Integrator::static_equilibrium;
  const auto at_rest = make_world(still);
  at_rest->load_to(1);
  REQUIRE_FALSE(at_rest->halt());
  REQUIRE(at_rest->apply(stroke(Vec3(0.052, 1, 0), Vec3(0.052, 0.0105, 0))).ok());  // not through
  at_rest->load_to(1);
  CHECK_FALSE(at_rest->halt());
}

}  // namespace heml::cut_test
