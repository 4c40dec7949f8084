#include <doctest/doctest.h>

#include <limits>

#include "support.hpp"
#include "world_support.hpp"

namespace heml::rate_test {

using namespace heml::test;

TEST_CASE("rate: a world whose rate is set before its first tick is one made with it, to the bit") {
  WorldSetup setup = cantilever();
  setup.solver.step.reset();
  setup.solver.integrator = Integrator::backward_euler;
  setup.solver.rate = 1000;
  const auto changed = make_world(setup);
  setup.solver.rate = 60;
  const auto made = make_world(setup);
  REQUIRE(changed->apply(SetRate{60}).ok());
  for (int k = 0; k < 10; ++k) {
    changed->tick();
    made->tick();
  }
  CHECK(changed->state_hash() == made->state_hash());
  CHECK(changed->time() == made->time());
}

TEST_CASE("rate: ticks have another length from then on, through a reset too") {
  WorldSetup setup = cantilever();
  setup.solver.step = 0.001;
  const auto world = make_world(setup);
  for (int k = 0; k < 10; ++k) world->tick();
  REQUIRE(world->apply(SetRate{50}).ok());
  CHECK_FALSE(world->setup().solver.step);
  for (int k = 0; k < 5; ++k) world->tick();
  CHECK(world->ticks() == 15);
  CHECK(world->time() == doctest::Approx(0.11).epsilon(1e-12));
  CHECK(world->elapsed() == doctest::Approx(0.11).epsilon(1e-12));
  world->apply(Reset{});
  for (int k = 0; k < 5; ++k) world->tick();
  CHECK(world->time() == doctest::Approx(0.1).epsilon(1e-12));
  CHECK(world->elapsed() == doctest::Approx(0.21).epsilon(1e-12));
}

TEST_CASE("rate: what is no rate is refused") {
  const auto world = make_world(cantilever());
  CHECK_FALSE(world->apply(SetRate{0}).ok());
  CHECK_FALSE(world->apply(SetRate{-60}).ok());
  CHECK_FALSE(world->apply(SetRate{std::numeric_limits<double>::infinity()}).ok());
  WorldSetup at_rest = cantilever();
  at_rest.solver.step.reset();
  at_rest.solver.integrator = Integrator::static_equilibrium;
  CHECK_FALSE(make_world(at_rest)->apply(SetRate{60}).ok());
}

TEST_CASE("budget: a bound of linear iterations keeps a step cheap and the body whole") {
  const auto iterations = [](int linear) {
    WorldSetup setup = cantilever();
    setup.mesh = make_box(Vec3(0.2, 0.06, 0.06), {20, 6, 6});
    setup.boundary = {{nodes_where(setup.mesh, [](const Vec3& X) { return X.x() < 1e-9; })}};
    setup.solver.step.reset();
    setup.solver.rate = 10;
    setup.solver.integrator = Integrator::backward_euler;
    setup.solver.preconditioner = Preconditioner::block_jacobi;
    setup.solver.continuation = true;
    setup.solver.budget = Budget{1, 0, linear};
    const auto world = make_world(setup);
    for (int k = 0; k < 5; ++k) world->tick();
    CHECK(!world->halt());
    return world->solver_stats().linear.iterations;
  };
  CHECK(iterations(7) <= 5 * 7);
  CHECK(iterations(0) > 5 * 7);
}

}  // namespace heml::rate_test
