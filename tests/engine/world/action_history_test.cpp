// Undo and redo of all that a person does: the states are those of before and of when they were left, to the bit.
#include <doctest/doctest.h>

#include <random>

#include "state_support.hpp"

namespace heml::action_history_test {

using namespace heml::test;

namespace {

/// Without ticks and time, which go on and back.
std::vector<double> state_of(World& world) {
  std::vector<double> all = readings_of(world);
  all.push_back(world.setup().solver.damping);
  for (const RegionMaterial& entry : world.setup().materials)
    for (const double value : entry.material.parameters) all.push_back(value);
  const std::size_t ticks = 6 * world.positions().size() + 3 * world.reactions().size() + 5;
  all[ticks] = 0;
  return all;
}

void tick(World& world, int times) {
  for (int k = 0; k < times; ++k) world.tick();
}

void expect(const Status& status) { REQUIRE_MESSAGE(status.ok(), status.message()); }

}  // namespace

TEST_CASE("history: every action is taken back and brought back to the bit, and the body goes on as it would have") {
  for (const Command& action : examples())
    for (const Integrator integrator : {Integrator::verlet, Integrator::backward_euler, Integrator::bdf2})
      for (const bool single : {false, true}) {
        if (!is_action(action)) continue;
        CAPTURE(action.index());
        CAPTURE(integrator_name(integrator));
        const WorldSetup setup = bar_in_contact(integrator, single);
        const auto world = make_world(setup), undisturbed = make_world(setup);
        for (World* each : {world.get(), undisturbed.get()}) {
          tick(*each, 3);
          for (const Command& earlier : before(action)) expect(each->apply(earlier));
          tick(*each, 1);
        }
        const auto then = state_of(*world);
        REQUIRE(then == state_of(*undisturbed));
        expect(world->apply(action));
        tick(*world, 3);
        const auto left = state_of(*world);
        const double time_left = world->time();
        expect(world->apply(StepHistory{-1}));
        CHECK(world->ticks() == undisturbed->ticks() + 3);
        CHECK(world->time() == undisturbed->time());
        CHECK(state_of(*world) == then);
        expect(world->apply(StepHistory{1}));
        CHECK(state_of(*world) == left);
        CHECK(world->time() == time_left);
        expect(world->apply(StepHistory{-1}));
        tick(*world, 4), tick(*undisturbed, 4);
        CHECK(state_of(*world) == state_of(*undisturbed));
      }
}

TEST_CASE("history: several actions, back to the start and forth again") {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    const auto world = make_world(bar_in_contact(seed % 2 ? Integrator::verlet : Integrator::automatic, seed % 3 == 0));
    std::vector<std::vector<double>> states;
    for (int k = 0; k < 10; ++k) {
      const std::vector<Command> all = examples();
      const Command& action = all[random() % all.size()];
      const std::size_t past = world->actions().past.size();
      const auto then = state_of(*world);
      if (std::holds_alternative<StepHistory>(action) || !world->apply(action).ok()) continue;
      if (world->actions().past.size() > past) states.push_back(then);
      tick(*world, static_cast<int>(random() % 3));
    }
    while (states.size() > world->actions().past.size()) states.erase(states.begin());
    REQUIRE(states.size() == world->actions().past.size());
    const auto last = state_of(*world);
    for (std::size_t k = states.size(); k-- > 0;) {
      expect(world->apply(StepHistory{-1}));
      CHECK(state_of(*world) == states[k]);
    }
    CHECK(world->apply(StepHistory{-1}).message() == "history: there is nothing to undo");
    for (std::size_t k = 1; k < states.size(); ++k) {
      expect(world->apply(StepHistory{1}));
      CHECK(state_of(*world) == states[k]);
    }
    if (!states.empty()) expect(world->apply(StepHistory{1}));
    CHECK(state_of(*world) == last);
    CHECK(world->apply(StepHistory{1}).message() == "history: there is nothing to redo");
  }
}

TEST_CASE("history: a grasp with its moves, a stroke, a probe's way and a dragged slider are one action each") {
  const auto world = make_world(bar_in_contact(Integrator::verlet, false));
  const auto count = [&] { return world->actions().past.size(); };
  expect(world->apply(example(Grasp{})));
  for (int k = 0; k < 5; ++k) expect(world->apply(example(MoveTool{}))), tick(*world, 1);
  expect(world->apply(Release{}));
  CHECK(count() == 1);
  CutTissue further = blade_at(0.034);
  expect(world->apply(further));
  further.continues_stroke = true;
  for (auto& blade : further.sweep.blades)
    for (Vec3& end : blade) end.z() += 0.2;
  expect(world->apply(further));
  CHECK(count() == 2);
  expect(world->apply(example(MoveProbe{})));
  tick(*world, 2);
  expect(world->apply(example(MoveProbe{})));
  CHECK(count() == 3);
  for (const double damping : {1.0, 2.0, 3.0}) expect(world->apply(SetDamping{damping})), tick(*world, 1);
  CHECK(count() == 4);
  tick(*world, 110);  // more than half a second
  expect(world->apply(SetDamping{4}));
  CHECK(count() == 5);
  CHECK(world->setup().solver.damping == 4);
  expect(world->apply(StepHistory{-1}));
  CHECK(world->setup().solver.damping == 3);
  expect(world->apply(StepHistory{-1}));
  CHECK(world->setup().solver.damping == 0);
  CHECK(world->actions().future.size() == 2);
  expect(world->apply(SetDamping{7}));  // another way on: what was taken back is gone
  CHECK(world->actions().future.empty());
}

TEST_CASE("history: edits are undone as they stood at the moment that came back") {
  const auto world = make_world(bar_in_contact(Integrator::verlet, false));
  const auto elements = [&] { return world->topology()->elements.size(); };
  const std::size_t whole = elements();
  expect(world->apply(RemoveElements{{{0}, {}, {}, {}}}));
  expect(world->apply(RemoveElements{{{1}, {}, {}, {}}}));
  REQUIRE(elements() == whole - 2);
  expect(world->apply(StepHistory{-1}));
  expect(world->apply(Undo{}));
  CHECK(elements() == whole);
  CHECK(!world->apply(Undo{}).ok());
  expect(world->apply(StepHistory{-1}));
  CHECK(elements() == whole - 1);
  expect(world->apply(Undo{}));
  CHECK(elements() == whole);
}

TEST_CASE("history: is bounded, refuses other numbers, and is not kept where no one asks for it") {
  WorldSetup setup = bar_in_contact(Integrator::verlet, false);
  const auto world = make_world(setup);
  for (int k = 0; k < 30; ++k) expect(world->apply(example(SutureTissue{})));
  CHECK(world->actions().past.size() == 20);
  for (int k = 0; k < 20; ++k) expect(world->apply(StepHistory{-1}));
  const std::vector<ToolState> tools = world->tools();
  CHECK(tools_of<SutureState>(tools).size() == 10);
  CHECK(!world->apply(StepHistory{2}).ok());
  setup.keeps_actions = false;
  const auto other = make_world(setup);
  expect(other->apply(example(PinTissue{})));
  CHECK(other->actions().past.empty());
  CHECK(!other->apply(StepHistory{-1}).ok());
}

TEST_CASE("history: a refused command is no action, and keeps what can be brought back") {
  const auto world = make_world(bar_in_contact(Integrator::verlet, false));
  expect(world->apply(example(PinTissue{})));
  expect(world->apply(StepHistory{-1}));
  CHECK(!world->apply(PinTissue{100000, 0}).ok());
  CHECK(world->actions().past.empty());
  CHECK(world->actions().future.size() == 1);
}

TEST_CASE("history: takes back what broke the body, and it steps on") {
  WorldSetup setup = bar_in_contact(Integrator::verlet, false);
  setup.solver.continuation = false;
  setup.materials.front().material = sample_material("neo_hookean");
  setup.solver.step = 1e-4;
  const auto world = make_world(setup);
  tick(*world, 3);
  SetGravity violent;
  violent.gravity = Vec3(0, -1e7, 0);
  expect(world->apply(violent));
  tick(*world, 200);
  REQUIRE(world->halt());
  expect(world->apply(StepHistory{-1}));
  CHECK(!world->halt());
  tick(*world, 10);
  CHECK(!world->halt());
}

}  // namespace heml::action_history_test
