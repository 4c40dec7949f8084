// Several hands hold a body at once: each by its own springs, one beside the other.
#include <doctest/doctest.h>

#include "state_support.hpp"

namespace heml::hands_test {

using namespace heml::test;

namespace {

constexpr Integrator methods[] = {Integrator::symplectic_euler, Integrator::verlet, Integrator::backward_euler,
                                  Integrator::bdf2, Integrator::tr_bdf2};

void tick(World& world, int times) {
  for (int k = 0; k < times; ++k) world.tick();
}

void expect(const Status& status) { REQUIRE_MESSAGE(status.ok(), status.message()); }

const GraspState& held(const std::vector<ToolState>& tools, int hand) {
  const GraspState* grasp = find_grasp(tools, hand);
  REQUIRE(grasp);
  return *grasp;
}

/// A bar that nothing supports. Nodes tip and above_tip are at one end, 0 and 5 at the other.
WorldSetup free_bar(Integrator integrator, bool single) {
  WorldSetup setup = bar(sample_material("neo_hookean"), integrator, single);
  setup.boundary.clear();
  return setup;
}

}  // namespace

TEST_CASE("hands: two carry a body's weight between them") {
  for (const Integrator integrator : {Integrator::verlet, Integrator::backward_euler}) {
    CAPTURE(integrator_name(integrator));
    WorldSetup setup = free_bar(integrator, false);
    setup.solver.damping = 20;
    const auto world = make_world(setup);
    expect(world->apply(Grasp{tip, 0.015}));
    expect(world->apply(Grasp{0, 0.015, 1}));
    tick(*world, 400);
    const auto tools = world->tools();
    const double weight = 0.06 * 0.02 * 0.02 * setup.materials[0].material.density * 9.81;
    const Vec3 sum = held(tools, 0).force + held(tools, 1).force;
    CHECK((sum - Vec3(0, weight, 0)).norm() < 0.01 * weight);
    CHECK(held(tools, 0).force.y() > 0.3 * weight);
    CHECK(held(tools, 1).force.y() > 0.3 * weight);
    expect(world->apply(Release{1}));
    CHECK(find_grasp(world->tools(), 0));
    CHECK_FALSE(find_grasp(world->tools(), 1));
  }
}

TEST_CASE("hands: each is moved, replaced and released by itself") {
  const auto world = make_world(free_bar(Integrator::verlet, false));
  expect(world->apply(Grasp{tip, 0, 3}));
  expect(world->apply(Grasp{0, 0}));
  expect(world->apply(MoveTool{Vec3(1, 2, 3), 3}));
  CHECK(held(world->tools(), 3).target == Vec3(1, 2, 3));
  CHECK(held(world->tools(), 0).target == Vec3::Zero());
  expect(world->apply(Grasp{above_tip, 0.001, 3}));
  CHECK(held(world->tools(), 3).node == above_tip);
  CHECK(held(world->tools(), 3).radius == 0.001);
  CHECK(held(world->tools(), 0).node == 0);
  CHECK(world->apply(MoveTool{Vec3::Zero(), 2}).message() == "move: hand 2 holds nothing");
  CHECK(world->apply(Release{2}).ok());  // as of hand 0: nothing to let go of
  CHECK(world->tools().size() == 2);
  for (const int none : {-1, max_hands}) {
    CHECK_FALSE(world->apply(Grasp{tip, 0, none}).ok());
    CHECK_FALSE(world->apply(MoveTool{Vec3::Zero(), none}).ok());
    CHECK_FALSE(world->apply(Release{none}).ok());
  }
  expect(world->apply(Release{std::nullopt}));
  CHECK(world->tools().empty());
}

TEST_CASE("hands: what is handed over is held as before, to the bit") {
  for (const Integrator integrator : methods)
    for (const bool single : {false, true}) {
      CAPTURE(integrator_name(integrator));
      const WorldSetup setup = bar(sample_material("mooney_rivlin"), integrator, single);
      const auto one = make_world(setup), two = make_world(setup);
      for (World* each : {one.get(), two.get()}) {
        expect(each->apply(Grasp{tip, 0.012}));
        expect(each->apply(MoveTool{Vec3(0.07, 0.01, 0.005)}));
        tick(*each, 3);
      }
      expect(one->apply(Grasp{tip, 0.012}));     // by the same hand: as it is
      expect(two->apply(Grasp{tip, 0.012, 5}));  // left as a clamp
      CHECK_FALSE(find_grasp(two->tools(), 0));
      tick(*one, 3), tick(*two, 3);
      CHECK(one->state_hash() == two->state_hash());
      CHECK(held(one->tools(), 0).force == held(two->tools(), 5).force);
      for (World* each : {one.get(), two.get()}) {
        expect(each->apply(Grasp{tip, 0.012}));  // and taken up again
        expect(each->apply(MoveTool{Vec3(0.065, 0.02, 0)}));
      }
      tick(*one, 3), tick(*two, 3);
      CHECK(one->state_hash() == two->state_hash());
    }
}

TEST_CASE("hands: a clamp that was removed comes back by undo, and a grasp with its release stays one action") {
  const auto world = make_world(bar(sample_material("neo_hookean"), Integrator::verlet, false));
  const auto count = [&] { return world->actions().past.size(); };
  expect(world->apply(Grasp{tip, 0.012}));
  expect(world->apply(MoveTool{Vec3(0.07, 0.01, 0.005)}));
  tick(*world, 2);
  expect(world->apply(Grasp{tip, 0.012, 1}));
  tick(*world, 2);
  expect(world->apply(Grasp{13, 0.01}));
  expect(world->apply(Release{}));
  CHECK(count() == 3);
  const auto before = world->positions();
  const Vec3 force = held(world->tools(), 1).force;
  expect(world->apply(Release{1}));
  CHECK(count() == 4);
  tick(*world, 5);
  expect(world->apply(StepHistory{-1}));
  CHECK(world->positions() == before);
  CHECK(held(world->tools(), 1).force == force);
  expect(world->apply(StepHistory{1}));
  CHECK_FALSE(find_grasp(world->tools(), 1));
}

TEST_CASE("hands: a grasp of a device with its moves and its release is one action, beside that of the mouse") {
  const auto world = make_world(bar(sample_material("neo_hookean"), Integrator::verlet, false));
  const auto start = world->positions();
  for (const int hand : {first_device_hand, max_hands - 1, 0}) {
    expect(world->apply(Grasp{tip, 0.01 + 1e-3 * hand, hand}));
    expect(world->apply(MoveTool{Vec3(0.07, 0.01, 0.005), hand}));
    tick(*world, 2);
    expect(world->apply(Release{hand}));
  }
  CHECK(world->actions().past.size() == 3);
  const auto left = world->positions();
  for (int k = 0; k < 3; ++k) expect(world->apply(StepHistory{-1}));
  CHECK(world->positions() == start);
  expect(world->apply(Release{first_device_hand}));  // of what undo may have given back: redo stays
  for (int k = 0; k < 3; ++k) expect(world->apply(StepHistory{1}));
  CHECK(world->positions() == left);
}

TEST_CASE("hands: letting go of what undo gave back to hand 0 leaves redo as it is") {
  const auto world = make_world(bar(sample_material("neo_hookean"), Integrator::verlet, false));
  expect(world->apply(Grasp{tip, 0.012}));
  expect(world->apply(Grasp{tip, 0.012, 1}));
  tick(*world, 2);
  const auto left = world->positions();
  expect(world->apply(StepHistory{-1}));
  expect(world->apply(Release{}));  // as the window does: no button holds it
  expect(world->apply(StepHistory{1}));
  CHECK(world->positions() == left);
  CHECK(find_grasp(world->tools(), 1));
}

TEST_CASE("hands: an undone cut leaves grasps in the hands that they were given to since") {
  const auto world = make_world(bar(sample_material("neo_hookean"), Integrator::verlet, false));
  expect(world->apply(Grasp{tip, 0.012}));
  expect(world->apply(Grasp{above_tip, 0, 1}));
  tick(*world, 2);
  expect(world->apply(blade_at(0.034)));
  expect(world->apply(Grasp{above_tip, 0, 5}));
  expect(world->apply(Grasp{tip, 0.012, 7}));
  expect(world->apply(Undo{}));
  REQUIRE(world->tools().size() == 2);
  CHECK(held(world->tools(), 5).node == above_tip);
  CHECK(held(world->tools(), 7).node == tip);
  expect(world->apply(MoveTool{Vec3(0.07, 0, 0), 7}));
}

TEST_CASE("hands: an undone cut leaves those that have held ever since, with their tools where they are") {
  const auto world = make_world(bar(sample_material("neo_hookean"), Integrator::verlet, false));
  expect(world->apply(Grasp{tip, 0.012}));
  expect(world->apply(Grasp{above_tip, 0, 1}));
  tick(*world, 2);
  expect(world->apply(blade_at(0.034)));
  expect(world->apply(MoveTool{Vec3(0.07, 0, 0), 1}));
  expect(world->apply(Grasp{tip, 0.001}));  // another grasp than before the cut
  expect(world->apply(Grasp{14, 0, 2}));
  tick(*world, 2);
  expect(world->apply(Undo{}));
  REQUIRE(world->tools().size() == 1);
  CHECK(held(world->tools(), 1).target == Vec3(0.07, 0, 0));
  tick(*world, 5);
  CHECK_FALSE(world->halt());
}

TEST_CASE("hands: explicit steps stay stable when all of them hold the same node") {
  for (const bool single : {false, true}) {
    WorldSetup setup = free_bar(Integrator::verlet, single);
    setup.gravity.setZero();
    setup.solver.recovery = false;
    const auto world = make_world(setup);
    for (int hand = 0; hand < max_hands; ++hand) expect(world->apply(Grasp{tip, 1e-5 * (hand + 1), hand}));
    expect(world->apply(MoveTool{Vec3(0.061, 0, 0), 7}));
    tick(*world, 100);
    CHECK_FALSE(world->halt());
    CHECK(world->energies().kinetic < 1e-6);
    for (const Vec3& x : world->positions()) CHECK(x.norm() < 0.1);
  }
}

}  // namespace heml::hands_test
