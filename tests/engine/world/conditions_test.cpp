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

/// A bar at rest that nothing but its conditions acts on.
WorldSetup resting_bar(Integrator integrator, bool quadratic) {
  WorldSetup setup = bar(sample_material("neo_hookean"), integrator, false);
  setup.boundary.clear();
  setup.gravity.setZero();
  setup.solver.quadratic = quadratic;
  if (quadratic) setup.midedges = add_midedge_nodes(setup.mesh);
  return setup;
}

/// Those of conditions_of(), slow enough for a dozen ticks.
Conditions slow_conditions(const TetMesh& mesh) {
  Conditions conditions = conditions_of(mesh);
  conditions.boundary.back().ramp_time = 0.05;
  for (std::size_t k = 0; k < conditions.loads.size(); ++k)
    conditions.loads[k].ramp_time = 0.03 + 0.01 * static_cast<double>(k);
  return conditions;
}

}  // namespace

TEST_CASE("conditions: set late, ramps begin then: the body moves as one that had them from its start") {
  for (const Integrator integrator : {Integrator::symplectic_euler, Integrator::verlet, Integrator::backward_euler,
                                      Integrator::bdf2, Integrator::tr_bdf2})
    for (const bool quadratic : {false, true}) {
      CAPTURE(integrator_name(integrator));
      CAPTURE(quadratic);
      WorldSetup setup = resting_bar(integrator, quadratic);
      const Conditions conditions = slow_conditions(setup.mesh);
      setup.boundary = {conditions.boundary.front()};
      WorldSetup with = setup;
      with.boundary = conditions.boundary;
      with.loads = conditions.loads;
      const auto early = make_world(with), late = make_world(setup);
      tick(*late, 20);
      expect(late->apply(SetBoundary{conditions.boundary}));
      expect(late->apply(SetLoads{conditions.loads}));
      for (const int ticks : {2, 10}) {  // within the ramps and after them
        tick(*early, ticks);
        tick(*late, ticks);
        double moved = 0;
        for (std::size_t n = 0; n < setup.mesh.nodes.size(); ++n)
          moved = std::max(moved, (early->positions()[n] - setup.mesh.nodes[n]).norm());
        REQUIRE(moved > 1e-5);
        CHECK(rms_difference(late->positions(), early->positions()) < 1e-6 * moved);
      }
    }
}

TEST_CASE("conditions: entries that are listed again go on with their ramps, on fewer nodes too, and others begin") {
  WorldSetup setup = resting_bar(Integrator::verlet, false);
  const Conditions conditions = slow_conditions(setup.mesh);
  setup.boundary = conditions.boundary;
  setup.loads = conditions.loads;
  const auto plain = make_world(setup), listed = make_world(setup);
  tick(*plain, 3), tick(*listed, 3);
  const double time = listed->time();
  std::vector<Load> loads = conditions.loads;
  std::reverse(loads.begin(), loads.end());
  Load none;  // of no size, beside them
  none.nodes = {7};
  none.ramp_time = 1;
  loads.push_back(none);
  expect(listed->apply(SetLoads{loads}));
  expect(listed->apply(SetBoundary{conditions.boundary}));
  tick(*plain, 12), tick(*listed, 12);
  CHECK(rms_difference(listed->positions(), plain->positions()) < 1e-12);
  CHECK(listed->setup().loads.back().ramp_start == time);

  loads = conditions.loads;
  loads[0].nodes.pop_back();  // each other node bears what it did
  loads[0].vector *= static_cast<double>(loads[0].nodes.size()) / static_cast<double>(loads[0].nodes.size() + 1);
  loads[1].nodes.erase(loads[1].nodes.begin());
  loads[2].pressure += 1;
  expect(listed->apply(SetLoads{loads}));
  CHECK(listed->setup().loads[0].ramp_start == 0);
  CHECK(listed->setup().loads[1].ramp_start == 0);
  CHECK(listed->setup().loads[2].ramp_start == listed->time());
  expect(listed->apply(SetLoads{{conditions.loads[0], conditions.loads[0]}}));  // on more nodes again: both are new
  for (const Load& load : listed->setup().loads) CHECK(load.ramp_start == listed->time());
}

TEST_CASE(
    "conditions: half a ramp is taken back, brought back and kept in snapshots to the bit, and a reset begins anew") {
  WorldSetup setup = resting_bar(Integrator::verlet, false);
  const Conditions conditions = slow_conditions(setup.mesh);
  setup.boundary = {conditions.boundary.front()};
  const auto world = make_world(setup), other = make_world(setup);
  tick(*world, 4);
  expect(world->apply(SetBoundary{conditions.boundary}));
  expect(world->apply(SetLoads{conditions.loads}));
  tick(*world, 3);
  const auto half = world->snapshot();
  tick(*world, 3);
  const auto expected = world->positions();
  REQUIRE(other->restore(*half).ok());
  tick(*other, 3);
  CHECK(other->positions() == expected);

  REQUIRE(world->restore(*half).ok());
  expect(world->apply(SetLoads{{}}));
  tick(*world, 2);
  CHECK(world->positions() != expected);
  expect(world->apply(StepHistory{-1}));
  tick(*world, 3);
  CHECK(world->positions() == expected);

  expect(world->apply(Reset{}));
  WorldSetup with = setup;
  with.boundary = conditions.boundary;
  with.loads = conditions.loads;
  const auto made = make_world(with);
  tick(*world, 5), tick(*made, 5);
  CHECK(world->positions() == made->positions());
}

TEST_CASE(
    "conditions: a load on faces that its nodes do not hold is refused, unless it acted before they were removed") {
  const WorldSetup setup = resting_bar(Integrator::verlet, false);
  const auto world = make_world(setup);
  const std::vector<int> one_edge{4, 9};
  for (const Load::Kind kind : {Load::Kind::traction, Load::Kind::pressure}) {
    const Status status =
        world->apply(SetLoads{{{Load::Kind::force, {tip}, Vec3::UnitX()}, {kind, one_edge, Vec3::UnitX(), 10}}});
    CHECK(status.message() ==
          "loads[1]: its 2 nodes hold no face of the surface (select all three nodes of at least one)");
  }
  CHECK(world->setup().loads.empty());

  const Load pressure{Load::Kind::pressure, nodes_where(setup.mesh, [](const Vec3& X) { return X.x() > 0.0599; }),
                      Vec3::Zero(), 10};
  expect(world->apply(SetLoads{{pressure}}));
  RemoveElements ends;
  for (std::size_t t = 0; t < setup.mesh.tets.size(); ++t)
    for (const int n : setup.mesh.tets[t])
      if (setup.mesh.nodes[static_cast<std::size_t>(n)].x() > 0.0599) {
        ends.which.tets.push_back(static_cast<int>(t));
        break;
      }
  expect(world->apply(ends));
  const std::vector<Load> left = world->setup().loads;
  expect(world->apply(SetLoads{left}));
  CHECK_FALSE(world->apply(SetLoads{{{Load::Kind::pressure, pressure.nodes, Vec3::Zero(), 20}}}).ok());
}

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
