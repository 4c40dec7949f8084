#include <doctest/doctest.h>

#include <heml/session/step_doubling_scheduler.hpp>
#include <thread>

#include "engine/world/world_support.hpp"

namespace heml::step_doubling_scheduler_test {

using namespace heml::test;

namespace {

/// Ticks until an error is told, or no longer; false: not within a minute of the body's time.
bool tick_until(World& world, StepDoublingScheduler& scheduler, bool told) {
  const double end = world.time() + 60;
  while (scheduler.latest().has_value() != told && world.time() < end) {
    world.tick();
    scheduler.ticked(world);
    std::this_thread::yield();  // to the thread that computes
  }
  return scheduler.latest().has_value() == told;
}

void apply(World& world, StepDoublingScheduler& scheduler, const Command& command) {
  REQUIRE(world.apply(command).ok());
  scheduler.carried_out(command);
}

}  // namespace

TEST_CASE("a cut body has no time error, and has one again once the cut is undone") {
  const auto world = make_world(cantilever());
  StepDoublingScheduler scheduler;
  REQUIRE(tick_until(*world, scheduler, true));
  const std::size_t whole = world->topology()->elements.size();
  const Vec3 tip = world->positions().back();
  apply(*world, scheduler, CutTissue{{{{tip + Vec3(-0.03, -1, -1), tip + Vec3(-0.03, -1, 1)},
                                       {tip + Vec3(-0.03, 1, -1), tip + Vec3(-0.03, 1, 1)}}}});
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

}  // namespace heml::step_doubling_scheduler_test
