// The reset of everything: as a world made anew of the same scene, and one action to undo.
#include "state_support.hpp"

namespace heml::reset_scene_test {

using namespace heml::test;

namespace {

void expect(const Status& status) { REQUIRE_MESSAGE(status.ok(), status.message()); }

void tick(World& world, int times) {
  for (int k = 0; k < times; ++k) world.tick();
}

/// What a reset puts back: all that can be read but the count of ticks.
std::vector<double> motion_of(World& world, int ticks) {
  std::vector<double> all;
  for (int k = 0; k < ticks; ++k) {
    world.tick();
    for (const auto& list : {world.positions(), world.velocities(), world.reactions()})
      for (const Vec3& v : list) add(all, v);
    const Energies energies = world.energies();
    all.insert(all.end(), {world.time(), world.stable_step(), energies.kinetic, energies.elastic, energies.potential});
  }
  return all;
}

}  // namespace

TEST_CASE("reset of the scene: after any command the world is as one made anew, to the bit") {
  for (const Integrator integrator : {Integrator::verlet, Integrator::backward_euler})
    for (const bool single : {false, true})
      for (const Command& command : examples()) {
        CAPTURE(command.index());
        CAPTURE(integrator_name(integrator));
        const WorldSetup setup = bar_in_contact(integrator, single);
        const auto fresh = make_world(setup), world = make_world(setup);
        for (const Command& first : before(command)) expect(world->apply(first));
        expect(world->apply(command));
        tick(*world, 3);
        const long ticks = world->ticks(), version = world->topology()->version;
        expect(world->apply(Reset{true}));
        CHECK(world->ticks() == ticks);
        CHECK(world->time() == 0);
        CHECK(world->topology()->version > version);
        CHECK(world->state_hash() == fresh->state_hash());
        CHECK(world->setup().mesh.regions == fresh->setup().mesh.regions);
        CHECK(world->setup().materials.size() == fresh->setup().materials.size());
        CHECK(world->setup().gravity == setup.gravity);
        CHECK(world->edits().empty());
        if (std::holds_alternative<SetStepCost>(command)) continue;  // of the clock: it stays
        CHECK(motion_of(*world, 4) == motion_of(*fresh, 4));
      }
}

TEST_CASE("reset of the scene: it is one action, which undo takes back to the bit") {
  const auto world = make_world(bar_in_contact(Integrator::verlet, false)),
             same = make_world(bar_in_contact(Integrator::verlet, false));
  for (World* one : {world.get(), same.get()}) {
    for (const Command& command : {example(TagRegion{}), example(SetGravity{}), example(SetBoundary{}),
                                   example(SetLoads{}), example(CutTissue{}), example(PinTissue{})})
      expect(one->apply(command));
    tick(*one, 3);
  }
  const std::size_t actions = world->actions().past.size();
  expect(world->apply(Reset{true}));
  CHECK(world->actions().past.size() == actions + 1);
  CHECK(world->setup().tagged.empty());
  CHECK(world->setup().loads.empty());
  tick(*world, 2);
  expect(world->apply(StepHistory{-1}));
  CHECK(world->state_hash() == same->state_hash());
  CHECK(world->setup().tagged == same->setup().tagged);
  CHECK(world->setup().loads == same->setup().loads);
  CHECK(motion_of(*world, 4) == motion_of(*same, 4));
}

TEST_CASE("reset of the scene: a world made from a snapshot goes back to what the first was made as") {
  const WorldSetup setup = bar(sample_material("neo_hookean"), Integrator::verlet, false);
  const auto first = make_world(setup), fresh = make_world(setup);
  expect(first->apply(example(SetGravity{})));
  expect(first->apply(example(TagRegion{})));
  tick(*first, 2);
  const auto other = make_world_from(*first->snapshot());
  expect(other->apply(Reset{true}));
  CHECK(motion_of(*other, 4) == motion_of(*fresh, 4));
}

TEST_CASE("reset of the scene: the state alone is put back without it, and settings stay") {
  const auto world = make_world(bar(sample_material("neo_hookean"), Integrator::verlet, false));
  expect(world->apply(example(SetGravity{})));
  expect(world->apply(example(TagRegion{})));
  tick(*world, 2);
  expect(world->apply(Reset{}));
  CHECK(world->time() == 0);
  CHECK(world->setup().gravity == Vec3(0, -5, 2));
  CHECK(world->setup().tagged.size() == 1);
}

TEST_CASE("reset of the scene: iterations that a budget in milliseconds came to are of the clock, and stay") {
  WorldSetup setup = bar(sample_material("neo_hookean"), Integrator::backward_euler, false);
  setup.solver.budget = Budget{0, 5, 0};
  const auto world = make_world(setup);
  expect(world->apply(SetBudget{3}));
  expect(world->apply(Reset{true}));
  CHECK(world->setup().solver.budget->iterations == 3);
  CHECK(world->setup().solver.budget->milliseconds == 5);
}

}  // namespace heml::reset_scene_test
