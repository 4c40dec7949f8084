// Quadratic tissue against tissue: weight, momentum, friction, cuts, against the laws of mechanics.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <heml/mesh/quadratic.hpp>
#include <numbers>

#include "engine/materials/sample_materials.hpp"
#include "support.hpp"
#include "world_support.hpp"

namespace heml::quadratic_contact_test {

using namespace heml::test;

namespace {

constexpr double side = 0.04, density = 1000, g = 9.81;
constexpr double weight = side * side * side * density * g;

struct Bodies {
  WorldSetup setup;
  int corners_below, corners;  ///< nodes of the first body, of both; then the middles of edges
};

/// A body and another at a place, of p2_pressure (or p2) elements.
Bodies bodies(const TetMesh& below, const TetMesh& above, const Vec3& place, Integrator integrator, double friction,
              bool mean_dilatation = false) {
  Bodies made;
  WorldSetup& setup = made.setup;
  setup.mesh = below;
  add(setup.mesh, above, Eigen::Isometry3d(Eigen::Translation3d(place)));
  made.corners_below = static_cast<int>(below.nodes.size());
  made.corners = static_cast<int>(setup.mesh.nodes.size());
  setup.midedges = add_midedge_nodes(setup.mesh);
  setup.solver.quadratic = true;
  setup.solver.nodal_pressure = mean_dilatation;
  setup.materials = {{std::nullopt, sample_material(*find_law("neo_hookean_iso"), {4e3, 2e4})}};
  setup.materials[0].material.density = density;
  setup.self_contact = SelfContactSettings{friction};
  setup.solver.integrator = integrator;
  setup.solver.threads = 1;
  if (is_implicit(integrator)) setup.solver.rate = 100;
  return made;
}

/// A cube, and one of other cells upon it.
Bodies stack(Integrator integrator, double friction, bool mean_dilatation, double apart = 0) {
  return bodies(make_box(Vec3::Constant(side), {2, 2, 2}), make_box(Vec3::Constant(side), {1, 1, 1}),
                Vec3(0, side + apart, 0), integrator, friction, mean_dilatation);
}

/// Nodes of the elements whose corners are all below a number.
std::vector<int> nodes_below(const WorldSetup& setup, int corners) {
  std::vector<int> nodes;
  for (std::size_t t = 0; t < setup.mesh.tets.size(); ++t)
    if (setup.mesh.tets[t][0] < corners)
      for (const int n : quadratic_nodes(setup.mesh.tets[t], setup.midedges[t])) nodes.push_back(n);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

Vec3 mean(const std::vector<Vec3>& values, int from, int to) {
  Vec3 sum = Vec3::Zero();
  for (int n = from; n < to; ++n) sum += values[static_cast<std::size_t>(n)];
  return sum / (to - from);
}

/// Σ m v and Σ m x × v, with the lumped masses of ten-node tetrahedra.
std::pair<Vec3, Vec3> moments(const World& world) {
  const WorldSetup& setup = world.setup();
  const auto x = world.positions(), v = world.velocities();
  Vec3 momentum = Vec3::Zero(), moment = Vec3::Zero();
  for (std::size_t t = 0; t < setup.mesh.tets.size(); ++t) {
    const std::array<int, 10> nodes = quadratic_nodes(setup.mesh.tets[t], setup.midedges[t]);
    const auto X = [&](std::size_t c) { return setup.mesh.nodes[static_cast<std::size_t>(nodes[c])]; };
    const double mass = density * signed_volume(X(0), X(1), X(2), X(3));
    for (std::size_t a = 0; a < 10; ++a) {
      const auto n = static_cast<std::size_t>(nodes[a]);
      const Vec3 p = (a < 4 ? 1.0 / 36 : 4.0 / 27) * mass * v[n];
      momentum += p;
      moment += x[n].cross(p);
    }
  }
  return {momentum, moment};
}

/// Nodes that lie deeper than a depth, m, in a linear tetrahedron of the eight of an element that they are no corner of.
int overlapping(const World& world, double depth) {
  const WorldSetup& setup = world.setup();
  TetMesh whole = setup.mesh;
  MidEdges midedges;
  whole.tets.clear();
  for (const int t : world.topology()->elements) {
    whole.tets.push_back(setup.mesh.tets[static_cast<std::size_t>(t)]);
    midedges.push_back(setup.midedges[static_cast<std::size_t>(t)]);
  }
  whole.regions.clear(), whole.fields.clear();
  const auto x = world.positions();
  int found = 0;
  for (const Tet& tet : subdivided(whole, midedges).tets) {
    std::array<Vec3, 4> y;
    for (std::size_t c = 0; c < 4; ++c) y[c] = x[static_cast<std::size_t>(tet[c])];
    for (std::size_t n = 0; n < x.size(); ++n) {
      bool inside = std::find(tet.begin(), tet.end(), static_cast<int>(n)) == tet.end();
      for (std::size_t c = 0; c < 4 && inside; ++c) {
        const Vec3 &a = y[(c + 1) % 4], &b = y[(c + 2) % 4], &d = y[(c + 3) % 4];
        Vec3 out = (b - a).cross(d - a).normalized();
        if (out.dot(y[c] - a) > 0) out = -out;
        inside = out.dot(x[n] - a) < -depth;
      }
      found += inside ? 1 : 0;
    }
  }
  return found;
}

}  // namespace

TEST_CASE("quadratic contact: a stack at rest bears its weight, of every method, of p2 and p2_pressure") {
  for (const bool mean_dilatation : {false, true})
    for (const Integrator integrator : moving_integrators()) {
      CAPTURE(mean_dilatation);
      CAPTURE(std::string(integrator_name(integrator)));
      WorldSetup setup = stack(integrator, 0.3, mean_dilatation).setup;
      setup.tables = {{Vec3::Zero(), Vec3::UnitY(), 0.3}};
      setup.gravity = Vec3(0, -g, 0);
      setup.solver.damping = 50;
      const auto world = make_world(setup);
      run_until(*world, 0.4);
      REQUIRE_FALSE(world->halt());
      CHECK(tool_of<SelfContactState>(*world).force == doctest::Approx(weight).epsilon(0.01));
      CHECK(tools_of<TableState>(world->tools())[0].force.y() == doctest::Approx(2 * weight).epsilon(0.01));
      CHECK(tool_of<SelfContactState>(*world).max_penetration <= 2e-3 * side);
    }
}

TEST_CASE("quadratic contact: at equilibrium what is pressed bears on what presses it") {
  WorldSetup setup = stack(Integrator::static_equilibrium, 0, false).setup;
  for (const double y : {0.0, 2 * side}) {
    setup.boundary.push_back({nodes_where(setup.mesh, [=](const Vec3& X) { return std::abs(X.y() - y) < 1e-9; })});
    setup.boundary.back().translate = Vec3(0, y > 0 ? -0.002 : 0, 0);
  }
  setup.solver.tolerance = 1e-8;
  const auto world = make_world(setup);
  world->load_to(1);
  REQUIRE_FALSE(world->halt());
  const double below = world->reactions()[0].y(), above = -world->reactions()[1].y();
  CHECK(below > 0.4);
  CHECK(below == doctest::Approx(above).epsilon(1e-6));
  CHECK(tool_of<SelfContactState>(*world).force == doctest::Approx(below).epsilon(1e-3));
}

TEST_CASE("quadratic contact: boxes that collide keep momentum and moment to round-off, and gain no energy") {
  Bodies two = bodies(make_box(Vec3::Constant(side), {2, 2, 2}), make_box(Vec3(0.03, 0.03, 0.05), {2, 2, 3}),
                      Vec3(0.007, side + 0.002, -0.003), Integrator::verlet, 0);
  WorldSetup& setup = two.setup;
  setup.initial_positions = setup.mesh.nodes;
  for (Vec3& x : setup.initial_positions)  // the lower one begins flat, and jumps
    if (x.y() < side + 1e-6) x.y() = side - 0.6 * (side - x.y());
  setup.initial_velocity = Vec3(0.2, 0.1, -0.3);
  const auto world = make_world(setup);
  const auto [momentum, moment] = moments(*world);
  const double energy = total(world->energies());
  double max_force = 0, max_energy = 0;
  for (int tick = 0; tick < 150; ++tick) {
    world->tick();
    max_force = std::max(max_force, tool_of<SelfContactState>(*world).force);
    max_energy = std::max(max_energy, total(world->energies()));
    CHECK(overlapping(*world, 1e-4) == 0);
  }
  REQUIRE_FALSE(world->halt());
  const auto [last_momentum, last_moment] = moments(*world);
  CHECK(max_force > 0.1);
  CHECK((last_momentum - momentum).norm() <= 1e-11 * momentum.norm());
  CHECK((last_moment - moment).norm() <= 1e-10 * moment.norm());
  CHECK(max_energy <= energy * (1 + 5e-4));  // the method's own ripple
  const Vec3 above = mean(world->velocities(), two.corners_below, two.corners);
  CHECK((above - setup.initial_velocity).y() > 0.02);  // it was hit
}

TEST_CASE("quadratic contact: on a slope a block sticks or slides as Coulomb says") {
  const double angle = 25 * std::numbers::pi / 180;
  for (const Integrator integrator : {Integrator::verlet, Integrator::backward_euler})
    for (const double friction : {0.2, 0.6}) {
      CAPTURE(std::string(integrator_name(integrator)));
      CAPTURE(friction);
      Bodies two = bodies(make_box(Vec3(0.12, 0.01, 0.04), {9, 1, 3}), make_box(Vec3(0.03, 0.01, 0.03), {2, 1, 2}),
                          Vec3(0.01, 0.01, 0.005), integrator, friction);
      WorldSetup& setup = two.setup;
      setup.gravity = g * Vec3(std::sin(angle), -std::cos(angle), 0);
      setup.boundary.push_back({nodes_below(setup, two.corners_below)});
      const auto world = make_world(setup);
      run_until(*world, 0.1);
      REQUIRE_FALSE(world->halt());
      const auto x = world->positions();
      const double slides = std::max(0.0, g * (std::sin(angle) - friction * std::cos(angle)));
      if (slides > 0)
        CHECK(mean(world->velocities(), two.corners_below, two.corners).x() ==
              doctest::Approx(slides * 0.1).epsilon(0.05));
      else
        CHECK((mean(x, two.corners_below, two.corners) - mean(setup.mesh.nodes, two.corners_below, two.corners)).x() <
              3e-4);
    }
}

TEST_CASE("quadratic contact: at 1 m/s nothing tunnels through a layer of one element") {
  for (const Integrator integrator : {Integrator::verlet, Integrator::backward_euler}) {
    CAPTURE(std::string(integrator_name(integrator)));
    Bodies two = bodies(make_box(Vec3(0.08, 0.008, 0.08), {5, 1, 5}), make_box(Vec3::Constant(0.02), {1, 1, 1}),
                        Vec3(0.03, 0.03, 0.031), integrator, 0);
    two.setup.boundary.push_back({nodes_where(two.setup.mesh, [](const Vec3& X) { return X.y() < 1e-9; })});
    two.setup.initial_velocity = Vec3(0, -1, 0);
    two.setup.solver.continuation = true;
    const auto world = make_world(two.setup);
    double lowest = 1, touched = 0;
    for (; world->time() < 0.12;) {
      world->tick();
      REQUIRE_FALSE(world->halt());
      touched = std::max(touched, tool_of<SelfContactState>(*world).force);
      const auto x = world->positions();
      lowest = std::min(lowest, mean(x, two.corners_below, two.corners).y() - mean(x, 0, two.corners_below).y());
    }
    CHECK(touched > 0);
    CHECK(lowest > 0.004);
    CHECK(overlapping(*world, 1e-3) == 0);
    CHECK(mean(world->velocities(), two.corners_below, two.corners).y() > -0.02);  // stopped, or thrown back
  }
}

TEST_CASE("quadratic contact: a cut opens as freely as without, and closes no further than it was") {
  const auto run = [](bool with, double pull) {
    WorldSetup setup;
    setup.mesh = make_box(Vec3(0.1, 0.02, 0.02), {10, 2, 2});
    setup.midedges = add_midedge_nodes(setup.mesh);
    setup.solver.quadratic = true;
    setup.materials = {{std::nullopt, soft()}};
    setup.boundary.push_back({nodes_where(setup.mesh, [](const Vec3& X) { return X.x() < 1e-9; })});
    if (with) setup.self_contact = SelfContactSettings{};
    const auto end = nodes_where(setup.mesh, [](const Vec3& X) { return X.x() > 0.1 - 1e-9; });
    setup.loads.push_back({Load::Kind::force, end, Vec3(pull, 0, 0)});
    setup.solver.damping = 20;
    auto world = make_world(setup);
    world->apply(CutTissue{
        {{{Vec3(0.047, -1, -1), Vec3(0.047, -1, 1)}, {Vec3(0.047, 0.012, -1), Vec3(0.047, 0.012, 1)}}}, false});
    REQUIRE(world->edits().size() == 1);
    run_until(*world, 0.4);
    REQUIRE_FALSE(world->halt());
    return world;
  };
  const auto opened = run(true, 0.2), free = run(false, 0.2);
  CHECK(rms_difference(opened->positions(), free->positions()) < 1e-6);
  const auto closed = run(true, -0.2), passed = run(false, -0.2);
  CHECK(tool_of<SelfContactState>(*closed).force > 0.02);
  CHECK(overlapping(*closed, 2e-4) == 0);
  CHECK(overlapping(*passed, 2e-4) > 20);
}

TEST_CASE("quadratic contact: a stack that comes to rest takes implicit steps that converge") {
  Bodies made = bodies(make_box(Vec3::Constant(side), {3, 3, 3}), make_box(Vec3::Constant(side), {2, 2, 2}),
                       Vec3(0, side, 0), Integrator::backward_euler, 0);
  made.setup.tables = {{Vec3::Zero(), Vec3::UnitY(), 0}};
  made.setup.gravity = Vec3(0, -g, 0);
  made.setup.solver.damping = 10;
  const auto world = make_world(made.setup);
  run_until(*world, 0.12);
  CHECK(world->solver_stats().explicit_rescues == 0);
  CHECK(world->solver_stats().unconverged_steps == 0);
  CHECK(world->solver_stats().iterations < 300);
}

TEST_CASE("quadratic contact: the same bits for any number of threads, after a reset, an undo and a snapshot") {
  for (const Integrator integrator : {Integrator::verlet, Integrator::backward_euler})
    for (const bool single : {false, true}) {
      CAPTURE(std::string(integrator_name(integrator)));
      CAPTURE(single);
      WorldSetup setup = stack(integrator, 0.4, true, 0.0002).setup;
      setup.tables = {{Vec3::Zero(), Vec3::UnitY(), 0.3}};
      setup.gravity = Vec3(1, -g, 0.5);
      setup.solver.single_precision = single;
      const auto one = make_world(setup);
      setup.solver.threads = 3;
      const auto three = make_world(setup);
      for (const auto& world : {one.get(), three.get()}) run_until(*world, 0.02);
      CHECK(tool_of<SelfContactState>(*one).contact_count > 0);
      CHECK(one->state_hash() == three->state_hash());
      const auto hash = one->state_hash();
      const auto kept = one->snapshot();
      one->apply(CutTissue{{{{Vec3(0.019, 0.041, -1), Vec3(0.019, 0.041, 1)}, {Vec3(0.019, 1, -1), Vec3(0.019, 1, 1)}}},
                           false});
      REQUIRE(one->edits().size() == 1);
      run_until(*one, 0.03);
      CHECK_FALSE(one->halt());
      one->apply(Undo{});
      CHECK(one->state_hash() == hash);
      REQUIRE(one->restore(*kept).ok());
      for (const auto& world : {one.get(), three.get()}) run_until(*world, 0.03);
      CHECK(one->state_hash() == three->state_hash());
      one->apply(Reset{});
      run_until(*one, 0.02);
      CHECK(one->state_hash() == hash);
    }
}

}  // namespace heml::quadratic_contact_test
