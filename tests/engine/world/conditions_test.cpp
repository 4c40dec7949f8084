// Boundary conditions and loads that are set while a world runs: as if it had been made with them, and taken back.
#include <algorithm>
#include <limits>

#include "state_support.hpp"

namespace heml::conditions_test {

using namespace heml::test;

namespace {

void tick(World& world, int times) {
  for (int k = 0; k < times; ++k) world.tick();
}

void expect(const Status& status) { REQUIRE_MESSAGE(status.ok(), status.message()); }

/// One end fixed, the other moved and pulled.
struct Conditions {
  std::vector<Boundary> boundary;
  std::vector<Load> loads;
};
Conditions conditions_of(const TetMesh& mesh) {
  const auto at = [&](double x) {
    return nodes_where(mesh, [x](const Vec3& X) { return std::abs(X.x() - x) < 1e-9; });
  };
  Boundary moved{at(0.06)};
  moved.translate = Vec3(0.002, 0, 0);
  moved.ramp_time = 0.02;
  return {{{at(0)}, moved},
          {{Load::Kind::force, at(0.03), Vec3(0, 0.02, 0)},
           {Load::Kind::traction, at(0.06), Vec3(0, 0, 20)},
           {Load::Kind::pressure, at(0.06), Vec3::Zero(), 15, 0.01}}};
}

}  // namespace

TEST_CASE("conditions: set before the first tick they give the bits of a world made with them") {
  for (const Integrator integrator : {Integrator::verlet, Integrator::backward_euler, Integrator::static_equilibrium})
    for (const bool quadratic : {false, true}) {
      if (quadratic && is_explicit(integrator)) continue;
      CAPTURE(integrator_name(integrator));
      CAPTURE(quadratic);
      WorldSetup setup = bar(sample_material("neo_hookean"), integrator, false);
      setup.boundary.clear();
      setup.solver.quadratic = quadratic;
      if (quadratic) setup.midedges = add_midedge_nodes(setup.mesh);
      const Conditions conditions = conditions_of(setup.mesh);
      WorldSetup with = setup;
      with.boundary = conditions.boundary;
      with.loads = conditions.loads;
      if (integrator == Integrator::static_equilibrium) setup.boundary = {{{0, 5, 10}}};  // not free altogether
      const auto made = make_world(with), set = make_world(setup);
      expect(set->apply(SetBoundary{conditions.boundary}));
      expect(set->apply(SetLoads{conditions.loads}));
      tick(*made, 6);
      tick(*set, 6);
      CHECK_FALSE(made->halt());
      CHECK(set->positions() == made->positions());
      CHECK(set->velocities() == made->velocities());
      CHECK(set->reactions() == made->reactions());
    }
}

TEST_CASE("conditions: a pin of listed corners holds the nodes between them, and a release lets them go") {
  WorldSetup setup = bar(sample_material("neo_hookean"), Integrator::verlet, false);
  const std::vector<int> corners = nodes_where(setup.mesh, [](const Vec3& X) { return X.x() < 1e-9; });
  setup.boundary.clear();
  setup.solver.quadratic = true;
  setup.midedges = add_midedge_nodes(setup.mesh);
  const std::vector<int> all = nodes_where(setup.mesh, [](const Vec3& X) { return X.x() < 1e-9; });
  REQUIRE(all.size() > corners.size());
  const auto world = make_world(setup);
  PinTissue pin;
  pin.nodes = corners;
  expect(world->apply(pin));
  tick(*world, 20);
  const auto moved = [&](int n) {
    return (world->positions()[static_cast<std::size_t>(n)] - setup.mesh.nodes[static_cast<std::size_t>(n)]).norm();
  };
  for (const int n : all) CHECK(moved(n) == 0);
  Unpin unpin;
  unpin.nodes = corners;
  expect(world->apply(unpin));
  tick(*world, 20);
  for (const int n : all) CHECK(moved(n) > 0);
}

TEST_CASE("conditions: nodes that are fixed go to their place at rest, and freed ones move on from there") {
  WorldSetup setup = bar(sample_material("neo_hookean"), Integrator::verlet, false);
  setup.boundary = {{nodes_where(setup.mesh, [](const Vec3& X) { return X.x() < 1e-9; })}};
  const auto world = make_world(setup);
  tick(*world, 10);
  const auto node = static_cast<std::size_t>(above_tip);
  const Vec3 rest = setup.mesh.nodes[node];
  CHECK(world->positions()[node].y() < rest.y() - 1e-5);
  std::vector<Boundary> more = setup.boundary;
  more.push_back({{above_tip}});
  expect(world->apply(SetBoundary{more}));
  CHECK(world->positions()[node] == rest);
  tick(*world, 10);
  CHECK(world->positions()[node] == rest);
  CHECK(world->reactions().size() == 2);
  CHECK(world->reactions()[1].norm() > 0);
  expect(world->apply(SetBoundary{setup.boundary}));
  tick(*world, 10);
  CHECK(world->positions()[node].y() < rest.y() - 1e-5);
}

TEST_CASE("conditions: undo and redo go back and forth to the bit") {
  const auto world = make_world(bar(sample_material("neo_hookean"), Integrator::verlet, false));
  tick(*world, 3);
  const auto plain = world->positions();
  const std::size_t entries = world->setup().boundary.size();
  expect(world->apply(example(SetBoundary{})));
  expect(world->apply(example(SetLoads{})));
  tick(*world, 4);
  const auto changed = world->positions();
  CHECK(changed != plain);
  expect(world->apply(StepHistory{-1}));
  CHECK(world->setup().loads.empty());
  expect(world->apply(StepHistory{-1}));
  CHECK(world->setup().boundary.size() == entries);
  CHECK(world->positions() == plain);
  const auto same = make_world(bar(sample_material("neo_hookean"), Integrator::verlet, false));
  tick(*same, 3);
  tick(*same, 5);
  tick(*world, 5);
  CHECK(world->positions() == same->positions());  // nothing is left of either
}

TEST_CASE("conditions: they outlast a reset, and a cut that is taken back or reset") {
  const auto boundary = std::get<SetBoundary>(example(SetBoundary{})).entries;
  const auto loads = std::get<SetLoads>(example(SetLoads{})).entries;
  for (const Command& end : {Command(Reset{}), Command(Undo{})}) {
    const auto world = make_world(bar(sample_material("neo_hookean"), Integrator::verlet, false));
    const std::size_t nodes = world->setup().mesh.nodes.size();
    expect(world->apply(blade_at(0.034)));
    expect(world->apply(SetBoundary{boundary}));
    Load on_new_node = loads.front();
    on_new_node.nodes.push_back(static_cast<int>(nodes));  // which the cut has made
    expect(world->apply(SetLoads{{on_new_node, loads.back()}}));
    tick(*world, 2);
    expect(world->apply(end));
    CHECK(world->setup().mesh.nodes.size() == nodes);
    CHECK(world->setup().boundary == boundary);
    CHECK(world->setup().loads == loads);
    tick(*world, 3);
    CHECK_FALSE(world->halt());
  }
  const auto world = make_world(bar(sample_material("neo_hookean"), Integrator::verlet, false));
  const auto before = world->setup().boundary;
  expect(world->apply(blade_at(0.034)));
  expect(world->apply(Reset{}));
  CHECK(world->setup().boundary == before);
}

TEST_CASE("conditions: wrong ones are refused and change nothing") {
  const auto world = make_world(bar(sample_material("neo_hookean"), Integrator::verlet, false));
  const auto hash = world->state_hash();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Boundary no_axis{{0}};
  no_axis.axis.setZero();
  for (const Command& wrong :
       {Command(SetBoundary{{{}}}), Command(SetBoundary{{{{-1}}}}), Command(SetBoundary{{{{0, 1000}}}}),
        Command(SetBoundary{{no_axis}}), Command(SetBoundary{{{{0}, Vec3(nan, 0, 0)}}}), Command(SetLoads{{{}}}),
        Command(SetLoads{{{Load::Kind::force, {1000}, Vec3::UnitX()}}}),
        Command(SetLoads{{{Load::Kind::force, {0}, Vec3(0, nan, 0)}}}),
        Command(SetLoads{{{Load::Kind::pressure, {0}, Vec3::Zero(), 1, -1}}})}) {
    const Status status = world->apply(wrong);
    CHECK_FALSE(status.ok());
    CHECK(status.message().find(std::holds_alternative<SetLoads>(wrong) ? "loads" : "boundary") == 0);
  }
  CHECK(world->setup().boundary.size() == 1);
  CHECK(world->setup().loads.empty());
  CHECK(world->state_hash() == hash);
}

}  // namespace heml::conditions_test
