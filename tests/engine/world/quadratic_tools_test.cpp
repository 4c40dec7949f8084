// Bodies of quadratic elements in a person's hands: tables, pins, sutures, grasps, probes, undo and redo, against
// weight and momentum.
#include <doctest/doctest.h>

#include <cmath>
#include <heml/mesh/quadratic.hpp>
#include <limits>
#include <numbers>
#include <numeric>

#include "engine/materials/sample_materials.hpp"
#include "support.hpp"
#include "world_support.hpp"

namespace heml::quadratic_tools_test {

using namespace heml::test;

namespace {

constexpr double side = 0.04, density = 1000, g = 9.81;
constexpr double mass = side * side * side * density, weight = mass * g;
constexpr double diagonal = side * std::numbers::sqrt3;

/// A cube from the origin that nothing holds, of p2_pressure (or p2) elements.
WorldSetup cube(Integrator integrator, bool mean_dilatation, int cells = 2) {
  WorldSetup setup;
  setup.mesh = make_box(Vec3(side, side, side), {cells, cells, cells});
  setup.midedges = add_midedge_nodes(setup.mesh);
  setup.solver.quadratic = true;
  setup.solver.nodal_pressure = mean_dilatation;
  setup.materials = {{std::nullopt, sample_material(*find_law("neo_hookean_iso"), {1e4, 4e4})}};
  setup.materials[0].material.density = density;
  setup.gravity = Vec3(0, -g, 0);
  setup.solver.integrator = integrator;
  setup.solver.threads = 1;
  if (integrator == Integrator::static_equilibrium) setup.solver.tolerance = 1e-9;
  if (!is_explicit(integrator) && integrator != Integrator::static_equilibrium) setup.solver.step = 0.005;
  return setup;
}

int node_at(const WorldSetup& setup, const Vec3& place) {
  return nodes_where(setup.mesh, [&](const Vec3& X) { return (X - place).norm() < 1e-9; }).front();
}

/// Σ m a over the nodes, with lumped masses: 1/36 of an element's on a corner, 4/27 on a mid-edge node.
Vec3 weighted(const WorldSetup& setup, const std::vector<Vec3>& a) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t t = 0; t < setup.mesh.tets.size(); ++t) {
    const auto X = [&](std::size_t c) { return setup.mesh.nodes[static_cast<std::size_t>(setup.mesh.tets[t][c])]; };
    const double of_element = density * signed_volume(X(0), X(1), X(2), X(3));
    for (const int n : setup.mesh.tets[t]) sum += of_element / 36 * a[static_cast<std::size_t>(n)];
    for (const int n : setup.midedges[t]) sum += of_element * 4 / 27 * a[static_cast<std::size_t>(n)];
  }
  return sum;
}

double lowest(const World& world) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& x : world.positions()) least = std::min(least, x.y());
  return least;
}

/// Calls visit(integrator, mean dilatation) for explicit and implicit steps of both elements.
template <class Visit>
void each_method(const Visit& visit) {
  for (const Integrator integrator : {Integrator::verlet, Integrator::backward_euler})
    for (const bool mean_dilatation : {false, true}) {
      CAPTURE(integrator_name(integrator));
      CAPTURE(mean_dilatation);
      visit(integrator, mean_dilatation);
    }
}

}  // namespace

TEST_CASE("quadratic elements on a table: its weight in the end, and no node below") {
  each_method([](Integrator integrator, bool mean_dilatation) {
    WorldSetup setup = cube(integrator, mean_dilatation);
    for (Vec3& X : setup.mesh.nodes) X.y() += 0.001;
    setup.tables = {{Vec3::Zero(), Vec3::UnitY(), 0.4}};
    setup.solver.damping = 50;
    auto world = make_world(setup);
    run_until(*world, 0.4);
    REQUIRE_FALSE(world->halt());
    const TableState table = tool_of<TableState>(*world);
    CHECK((table.force - Vec3(0, weight, 0)).norm() <= 1e-3 * weight);
    CHECK(lowest(*world) >= (is_explicit(integrator) ? -1e-12 : -1e-4 * diagonal));
    CHECK(table.contact_count >= 3);
  });
  for (const bool mean_dilatation : {false, true}) {
    WorldSetup setup = cube(Integrator::static_equilibrium, mean_dilatation);
    setup.tables = {{Vec3::Zero(), Vec3::UnitY(), 0}};
    auto world = make_world(setup);
    world->load_to(1);
    REQUIRE_FALSE(world->halt());
    CHECK((tool_of<TableState>(*world).force - Vec3(0, weight, 0)).norm() <= 1e-6 * weight);
    CHECK(lowest(*world) >= -1e-4 * diagonal);
  }
}

TEST_CASE("quadratic elements on a table: what it bears in a fall is weight and momentum") {
  each_method([](Integrator integrator, bool mean_dilatation) {
    WorldSetup setup = cube(integrator, mean_dilatation, 1);
    for (Vec3& X : setup.mesh.nodes) X.y() += 0.01;
    setup.tables = {{Vec3::Zero(), Vec3::UnitY(), 0.4}};
    auto world = make_world(setup);
    const double start = total(world->energies());
    double borne = 0, before = 0;
    while (world->time() < 0.3 - 1e-9) {
      world->tick();
      REQUIRE_FALSE(world->halt());
      borne += tool_of<TableState>(*world).force.y() * (world->time() - before);
      before = world->time();
      CHECK(total(world->energies()) <= start + 1e-3 * weight * 0.01);
    }
    const double momentum = weighted(setup, world->velocities()).y();
    CHECK(borne > 0.5 * weight * 0.3);
    CHECK(borne == doctest::Approx(weight * before + momentum).epsilon(1e-6));
  });
}

TEST_CASE("quadratic elements on a slope: friction holds a block below its angle, and lets it slide above") {
  const double friction = 0.4;
  for (const double degrees : {15.0, 35.0}) {
    WorldSetup setup = cube(Integrator::verlet, false);
    const double angle = degrees * std::numbers::pi / 180;
    setup.gravity = g * Vec3(std::sin(angle), -std::cos(angle), 0);
    setup.tables = {{Vec3::Zero(), Vec3::UnitY(), friction}};
    auto world = make_world(setup);
    run_until(*world, 0.1);
    const double before = weighted(setup, world->velocities()).x() / mass;
    run_until(*world, 0.3);
    REQUIRE_FALSE(world->halt());
    const double gained = (weighted(setup, world->velocities()).x() / mass - before) / 0.2;
    const double expected = std::max(0.0, g * (std::sin(angle) - friction * std::cos(angle)));
    CHECK(std::abs(gained - expected) <= 0.03 * g);
  }
}

TEST_CASE("quadratic elements: a pin holds its patch exactly, bears the weight, and lets go") {
  each_method([](Integrator integrator, bool mean_dilatation) {
    WorldSetup setup = cube(integrator, mean_dilatation);
    setup.solver.damping = 40;
    auto world = make_world(setup);
    const int middle = node_at(setup, Vec3(side / 2, side, side / 4));  // of an edge
    REQUIRE(middle >= 27);
    REQUIRE(world->apply(PinTissue{middle, 0.025}).ok());
    const PinState pin = tool_of<PinState>(*world);
    CHECK(pin.nodes.size() > 6);
    run_until(*world, 0.3);
    REQUIRE_FALSE(world->halt());
    for (const int n : pin.nodes)
      CHECK(world->positions()[static_cast<std::size_t>(n)] == setup.mesh.nodes[static_cast<std::size_t>(n)]);
    CHECK((tool_of<PinState>(*world).force - Vec3(0, weight, 0)).norm() <= 0.01 * weight);
    REQUIRE(world->apply(Unpin{middle}).ok());
    CHECK_FALSE(has_tool<PinState>(*world));
    run_until(*world, 0.35);
    CHECK(world->positions()[static_cast<std::size_t>(middle)].y() < side - 1e-3);
  });
}

TEST_CASE("quadratic elements: a suture between nodes in the middle of edges draws them together") {
  each_method([](Integrator integrator, bool mean_dilatation) {
    WorldSetup setup = cube(integrator, mean_dilatation);
    setup.gravity.setZero();
    setup.solver.damping = 20;
    auto world = make_world(setup);
    const int a = node_at(setup, Vec3(side / 4, side, side / 2)),
              b = node_at(setup, Vec3(3 * side / 4, side, side / 2));
    REQUIRE(std::min(a, b) >= 27);
    REQUIRE(world->apply(SutureTissue{{a, b}, 0.012, 0.05}).ok());
    run_until(*world, 0.2);
    REQUIRE_FALSE(world->halt());
    const SutureState suture = tool_of<SutureState>(*world);
    CHECK((suture.ends[0] - suture.ends[1]).norm() == doctest::Approx(0.012).epsilon(5e-3));
    CHECK(suture.force.norm() > 0);
    double speeds = 0;
    for (const Vec3& v : world->velocities()) speeds = std::max(speeds, v.norm());
    CHECK(weighted(setup, world->velocities()).norm() <= 1e-6 * mass * std::max(speeds, 1e-3));
    REQUIRE(world->apply(CutSutures{}).ok());
    run_until(*world, 0.35);
    const auto x = world->positions();
    CHECK((x[static_cast<std::size_t>(a)] - x[static_cast<std::size_t>(b)]).norm() > 0.018);
  });
}

TEST_CASE("quadratic elements: a grasp bears the weight where it holds, and what is released falls freely") {
  each_method([](Integrator integrator, bool mean_dilatation) {
    WorldSetup setup = cube(integrator, mean_dilatation);
    setup.solver.damping = 40;
    auto world = make_world(setup);
    const int node = node_at(setup, Vec3(side / 2, side, side / 2));
    REQUIRE(world->apply(Grasp{node, 0.025}).ok());
    REQUIRE(world->apply(MoveTool{Vec3(side / 2, side + 0.005, side / 2)}).ok());
    run_until(*world, 0.4);
    REQUIRE_FALSE(world->halt());
    CHECK((tool_of<GraspState>(*world).force - Vec3(0, weight, 0)).norm() <= 0.01 * weight);
    REQUIRE(world->apply(SetDamping{0}).ok());
    REQUIRE(world->apply(Release{}).ok());
    CHECK_FALSE(has_tool<GraspState>(*world));
    const Vec3 before = weighted(setup, world->velocities());
    const double time = world->time();
    run_until(*world, 0.45);
    const Vec3 gained = weighted(setup, world->velocities()) - before;
    CHECK((gained - Vec3(0, -weight * (world->time() - time), 0)).norm() <= 1e-6 * weight * 0.05);
  });
}

TEST_CASE("quadratic elements: a probe does not pass, and presses as hard as supports press back") {
  each_method([](Integrator integrator, bool mean_dilatation) {
    WorldSetup setup = cube(integrator, mean_dilatation);
    setup.gravity.setZero();
    setup.boundary.push_back({nodes_where(setup.mesh, [](const Vec3& X) { return X.y() < 1e-9; })});
    setup.solver.damping = 60;
    auto world = make_world(setup);
    MoveProbe probe;
    probe.radius = 0.012;
    probe.path = {Vec3(side / 2, side + 0.013, side / 2), Vec3(side / 2, side + 0.009, side / 2)};
    probe.speed = 0.1;
    REQUIRE(world->apply(probe).ok());
    run_until(*world, 0.2);
    Vec3 probed = Vec3::Zero(), reaction = Vec3::Zero();  // means: explicit contact chatters
    for (; world->time() < 0.25 - 1e-9; world->tick()) {
      probed += tool_of<ProbeState>(*world).force;
      reaction += world->reactions()[0];
      CHECK(tool_of<ProbeState>(*world).max_penetration <= 1e-4 * diagonal);
    }
    REQUIRE_FALSE(world->halt());
    CHECK(probed.y() < 0);
    CHECK((reaction + probed).norm() <= 3e-3 * probed.norm());
    const int under = node_at(setup, Vec3(side / 2, side, side / 2));
    CHECK(world->positions()[static_cast<std::size_t>(under)].y() <= side - 0.003 + 1e-4 * diagonal);
    REQUIRE(world->apply(WithdrawProbe{}).ok());
    run_until(*world, 0.45);
    CHECK(rms_difference(world->positions(), setup.mesh.nodes) <= 1e-4 * side);
  });
}

TEST_CASE("quadratic elements: actions are undone and redone to the bit, time included") {
  each_method([](Integrator integrator, bool mean_dilatation) {
    WorldSetup setup = cube(integrator, mean_dilatation, 1);
    setup.boundary.push_back({nodes_where(setup.mesh, [](const Vec3& X) { return X.y() < 1e-9; })});
    setup.tables = {{Vec3(0, -0.001, 0), Vec3::UnitY(), 0.4}};
    const auto plain = make_world(setup), world = make_world(setup);
    const auto tick = [](World& w) {
      for (int k = 0; k < 4; ++k) w.tick();
    };
    const int top = node_at(setup, Vec3(side / 2, side, side));
    Material stiffer = setup.materials[0].material;
    stiffer.parameters[0] *= 3;
    for (const Command& action :
         std::vector<Command>{Grasp{top, 0.02}, PinTissue{top, 0.02}, SutureTissue{{0, top}, 0.02, 0.1},
                              SetMaterial{std::nullopt, stiffer}, SetGravity{Vec3(3, 0, 0)}, Reset{}}) {
      CAPTURE(action.index());
      tick(*plain), tick(*world);
      const std::uint64_t hash = world->state_hash();
      const double time = world->time();
      REQUIRE(hash == plain->state_hash());
      REQUIRE(world->apply(action).ok());
      tick(*world);
      const std::uint64_t after = world->state_hash();
      REQUIRE(world->apply(StepHistory{-1}).ok());
      CHECK(world->state_hash() == hash);
      CHECK(world->time() == time);
      REQUIRE(world->apply(StepHistory{1}).ok());
      CHECK(world->state_hash() == after);
      REQUIRE(world->apply(StepHistory{-1}).ok());
      tick(*plain), tick(*world);
      CHECK(world->state_hash() == plain->state_hash());
    }
  });
}

}  // namespace heml::quadratic_tools_test
