// Pins: what they hold stays, what they feel is told, and a release gives it back.
#include <doctest/doctest.h>

#include <algorithm>
#include <heml/base/error.hpp>
#include <limits>

#include "world_support.hpp"

namespace heml::pin_test {

using namespace heml::test;

namespace {

int node_at(const TetMesh& mesh, const Vec3& place) {
  return nodes_where(mesh, [&](const Vec3& X) { return (X - place).norm() < 1e-9; }).front();
}

/// A block that nothing but its pins holds.
WorldSetup free_block(Integrator integrator) {
  WorldSetup setup = cantilever();
  setup.boundary.clear();
  setup.solver.integrator = integrator;
  setup.solver.damping = 20;
  if (!is_explicit(integrator)) setup.solver.step = 0.01;
  return setup;
}

}  // namespace

TEST_CASE("pin: the patch stays where it is under every method, and a release lets it go") {
  for (const auto integrator : moving_integrators()) {
    CAPTURE(integrator_name(integrator));
    auto world = make_world(free_block(integrator));
    const int node = node_at(world->setup().mesh, Vec3(0.1, 0.01, 0.01));
    REQUIRE(world->apply(PinTissue{node, 0.012}).ok());
    const auto pinned = tools_of<PinState>(world->tools()).front().nodes;
    CHECK(pinned.size() > 3);
    const auto before = world->positions();
    run_until(*world, 0.1);
    for (const int n : pinned) {
      CHECK(world->positions()[static_cast<std::size_t>(n)] == before[static_cast<std::size_t>(n)]);
      CHECK(world->velocities()[static_cast<std::size_t>(n)] == Vec3(Vec3::Zero()));
    }
    CHECK(world->positions()[0].y() < before[0].y() - 1e-3);
    REQUIRE(world->apply(Unpin{node}).ok());
    CHECK(tools_of<PinState>(world->tools()).empty());
    run_until(*world, 0.12);
    CHECK(world->positions()[static_cast<std::size_t>(node)].y() < before[static_cast<std::size_t>(node)].y());
  }
}

TEST_CASE("pin: hidden regions are left out, and what they cover is surface") {
  WorldSetup setup = free_block(Integrator::verlet);
  const TetMesh& mesh = setup.mesh;
  const double middle = 0.05;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    Vec3 centroid = Vec3::Zero();
    for (const int n : mesh.tets[t]) centroid += mesh.nodes[static_cast<std::size_t>(n)] / 4;
    setup.mesh.regions[t] = centroid.x() < middle ? 1 : 2;
  }
  const auto world = make_world(setup);
  const int node = node_at(mesh, Vec3(middle, 0.01, 0.01));
  const auto pinned = [&](const std::vector<int>& hidden) {
    REQUIRE(world->apply(PinTissue{node, 0.012, hidden}).ok());
    const std::vector<int> nodes = tools_of<PinState>(world->tools()).front().nodes;
    REQUIRE(world->apply(Unpin{}).ok());
    return nodes;
  };
  const auto within = [&](const auto& takes) {
    return nodes_where(mesh, [&](const Vec3& X) {
      return (X - Vec3(middle, 0.01, 0.01)).norm() <= 0.012 && takes(X);
    });
  };
  const auto is_outside = [](const Vec3& X) {
    return X.y() < 1e-9 || X.y() > 0.02 - 1e-9 || X.z() < 1e-9 || X.z() > 0.02 - 1e-9;
  };
  const auto is_middle = [&](const Vec3& X) { return std::abs(X.x() - middle) < 1e-9; };
  const auto sorted = [](std::vector<int> nodes) {
    std::sort(nodes.begin(), nodes.end());
    return nodes;
  };
  const auto is_centre = [&](const Vec3& X) { return (X - Vec3(middle, 0.01, 0.01)).norm() < 1e-9; };
  CHECK(sorted(pinned({})) == within([&](const Vec3& X) { return is_outside(X) || is_centre(X); }));
  CHECK(sorted(pinned({1})) ==
        within([&](const Vec3& X) { return is_middle(X) || (X.x() > middle && is_outside(X)); }));
  CHECK(sorted(pinned({2})) ==
        within([&](const Vec3& X) { return is_middle(X) || (X.x() < middle && is_outside(X)); }));
}

TEST_CASE("pin: at rest two pins together carry the weight") {
  WorldSetup setup = free_block(Integrator::backward_euler);
  setup.solver.tolerance = 1e-9;
  setup.solver.damping = 100;
  auto world = make_world(setup);
  const TetMesh& mesh = world->setup().mesh;
  REQUIRE(world->apply(PinTissue{node_at(mesh, Vec3(0, 0.01, 0.01)), 0.015}).ok());
  REQUIRE(world->apply(PinTissue{node_at(mesh, Vec3(0.1, 0.01, 0.01)), 0.015}).ok());
  run_until(*world, 5);
  const double weight = 0.1 * 0.02 * 0.02 * 1000 * 9.81;
  const Vec3 left = tools_of<PinState>(world->tools())[0].force, right = tools_of<PinState>(world->tools())[1].force;
  CHECK((left + right - Vec3(0, weight, 0)).norm() <= 1e-6 * weight);
  CHECK(left.y() == doctest::Approx(weight / 2).epsilon(0.02));
}

TEST_CASE("pin: constrains a static world and carries its load") {
  WorldSetup setup = free_block(Integrator::static_equilibrium);
  setup.solver.step.reset();
  setup.solver.tolerance = 1e-10;
  auto world = make_world(setup);
  REQUIRE(world->apply(PinTissue{node_at(world->setup().mesh, Vec3(0, 0.01, 0.01)), 0.015}).ok());
  world->load_to(1);
  REQUIRE_FALSE(world->halt());
  CHECK(tools_of<PinState>(world->tools())[0].force.y() ==
        doctest::Approx(0.1 * 0.02 * 0.02 * 1000 * 9.81).epsilon(1e-6));
}

TEST_CASE("pin: undoing a cut brings back the pins of then, and a reset takes all away") {
  auto world = make_world(cantilever());
  const int node = node_at(world->setup().mesh, Vec3(0.1, 0.01, 0.01));
  REQUIRE(world->apply(PinTissue{node, 0.012}).ok());
  const std::size_t held = tools_of<PinState>(world->tools())[0].nodes.size();
  run_until(*world, 0.01);
  const auto before = world->state_hash();
  CutTissue cut;
  cut.sweep.blades = {{Vec3(0.085, -0.01, 0.0108), Vec3(0.12, -0.01, 0.0108)},
                      {Vec3(0.085, 0.03, 0.0108), Vec3(0.12, 0.03, 0.0108)}};
  REQUIRE(world->apply(cut).ok());
  REQUIRE(world->edits().size() == 1);
  CHECK(tools_of<PinState>(world->tools())[0].nodes.size() >
        held);  // nodes that the cut made within the patch are of it
  run_until(*world, 0.02);
  const auto pinned = tools_of<PinState>(world->tools())[0].nodes;
  for (const int n : pinned) CHECK(world->velocities()[static_cast<std::size_t>(n)] == Vec3(Vec3::Zero()));
  REQUIRE(world->apply(Unpin{}).ok());
  REQUIRE(world->apply(Undo{}).ok());
  CHECK(world->state_hash() == before);
  REQUIRE(tools_of<PinState>(world->tools()).size() == 1);
  CHECK(tools_of<PinState>(world->tools())[0].nodes.size() == held);
  REQUIRE(world->apply(Reset{}).ok());
  CHECK(tools_of<PinState>(world->tools()).empty());
}

TEST_CASE("pin: a list of nodes is one pin, inner ones too, and one action") {
  auto world = make_world(cantilever());
  const TetMesh& mesh = world->setup().mesh;
  const int inner = node_at(mesh, Vec3(0.05, 0.01, 0.01)), corner = node_at(mesh, Vec3(0.1, 0.02, 0.02)),
            edge = node_at(mesh, Vec3(0.1, 0.02, 0)), fixed = node_at(mesh, Vec3(0, 0, 0));
  REQUIRE(world->apply(PinTissue{0, 0, {}, {corner, fixed, inner, corner}}).ok());
  REQUIRE(world->apply(PinTissue{edge, 0}).ok());
  const auto nodes_of = [&](std::size_t pin) {
    std::vector<int> nodes = tools_of<PinState>(world->tools()).at(pin).nodes;
    std::sort(nodes.begin(), nodes.end());
    return nodes;
  };
  std::vector<int> both{inner, corner};
  std::sort(both.begin(), both.end());
  CHECK(nodes_of(0) == both);  // fixed is constrained already
  run_until(*world, 0.01);
  for (const int n : {inner, corner, edge}) CHECK(world->positions()[std::size_t(n)] == mesh.nodes[std::size_t(n)]);

  const auto hash = world->state_hash();
  REQUIRE(world->apply(Unpin{{}, {corner, edge, 7}}).ok());  // of two pins
  REQUIRE(tools_of<PinState>(world->tools()).size() == 1);
  CHECK(nodes_of(0) == std::vector{inner});
  CHECK(tools_of<PinState>(world->tools())[0].node == inner);
  run_until(*world, 0.02);
  CHECK(world->positions()[std::size_t(corner)] != mesh.nodes[std::size_t(corner)]);
  CHECK(world->positions()[std::size_t(inner)] == mesh.nodes[std::size_t(inner)]);
  REQUIRE(world->apply(StepHistory{-1}).ok());
  CHECK(tools_of<PinState>(world->tools()).size() == 2);
  CHECK(world->state_hash() == hash);
  REQUIRE(world->apply(StepHistory{-1}).ok());
  REQUIRE(world->apply(StepHistory{-1}).ok());
  CHECK(tools_of<PinState>(world->tools()).empty());

  CHECK_FALSE(world->apply(PinTissue{0, 0, {}, {fixed}}).ok());
  CHECK_FALSE(world->apply(PinTissue{0, 0, {}, {corner, 1 << 20}}).ok());
  CHECK_FALSE(world->apply(Unpin{{}, {corner}}).ok());
}

TEST_CASE("pin: wrong pins and releases are refused and change nothing") {
  auto world = make_world(cantilever());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const int free = node_at(world->setup().mesh, Vec3(0.1, 0.01, 0.01));
  for (const Command& wrong : {Command(PinTissue{-1, 0}), Command(PinTissue{1 << 20, 0}), Command(PinTissue{free, nan}),
                               Command(PinTissue{free, -1}), Command(PinTissue{0, 0}), Command(Unpin{free})})
    CHECK_FALSE(world->apply(wrong).ok());
  CHECK(tools_of<PinState>(world->tools()).empty());
}

}  // namespace heml::pin_test
