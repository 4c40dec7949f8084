#include <doctest/doctest.h>

#include <chrono>
#include <heml/session/step_doubling_scheduler.hpp>
#include <thread>

#include "engine/world/world_support.hpp"

namespace heml::step_doubling_scheduler_test {

using namespace heml::test;

namespace {

/// Ticks until an error is told, or no longer; false: not within two minutes.
bool tick_until(World& world, StepDoublingScheduler& scheduler, bool told) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::minutes(2);
  while (scheduler.latest().has_value() != told && Clock::now() < end) {
    world.tick();
    scheduler.ticked(world);
    std::this_thread::sleep_for(std::chrono::microseconds(100));  // for the thread that computes
  }
  return scheduler.latest().has_value() == told;
}

void apply(World& world, StepDoublingScheduler& scheduler, const Command& command) {
  REQUIRE(world.apply(command).ok());
  scheduler.carried_out(command);
}

}  // namespace

TEST_CASE("a cut body has no time error, and has one again once the cut is undone") {
  WorldSetup setup = cantilever();
  setup.gravity = Vec3::Zero();  // it stays where it is cut, however long the first error takes
  const auto world = make_world(setup);
  StepDoublingScheduler scheduler;
  REQUIRE(tick_until(*world, scheduler, true));
  const std::size_t whole = world->topology()->elements.size();
  apply(*world, scheduler,
        CutTissue{{{{Vec3(0.046, -1, -1), Vec3(0.046, -1, 1)}, {Vec3(0.046, 1, -1), Vec3(0.046, 1, 1)}}}});
  REQUIRE(world->topology()->elements.size() > whole);
  CHECK(tick_until(*world, scheduler, false));
  for (int k = 0; k < 2000; ++k) {
    world->tick();
    scheduler.ticked(*world);
  }
  CHECK_FALSE(scheduler.latest());
  apply(*world, scheduler, Undo{});
  REQUIRE(world->topology()->elements.size() == whole);
  CHECK(tick_until(*world, scheduler, true));
}

TEST_CASE("the time error of a burnt body is of its shrunken rest shape") {
  WorldSetup setup = cantilever();
  setup.solver.damping = 20;  // 1/s: it comes to rest, where steps err by nothing
  const auto world = make_world(setup);
  StepDoublingScheduler scheduler;
  const Vec3 tip = world->positions().back();
  apply(*world, scheduler, CauterizeTissue{{{{tip, tip}}}, {0.05, 0.2}});
  for (int k = 0; k < 3000; ++k) {  // it shrinks for 0.1 s
    world->tick();
    scheduler.ticked(*world);
  }
  REQUIRE(tick_until(*world, scheduler, true));
  CHECK(scheduler.latest()->rms < 1e-6);  // m; the tip shrinks by some 10 mm
}

}  // namespace heml::step_doubling_scheduler_test
