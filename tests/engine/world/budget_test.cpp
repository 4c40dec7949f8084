#include <doctest/doctest.h>

#include <cmath>

#include "engine/elastic/small_body.hpp"
#include "support.hpp"
#include "world_support.hpp"

namespace heml::budget_test {

using namespace heml::test;

namespace {

/// A beam that is let go from a shape it was forced into.
WorldSetup let_go(const std::string& shape) {
  WorldSetup setup = cantilever();
  setup.gravity.setZero();
  setup.initial_positions = setup.mesh.nodes;
  std::mt19937_64 random(5);
  for (Vec3& x : setup.initial_positions) {
    const double along = x.x() / 0.1;
    if (shape == "stretched") x.x() *= 2;
    if (shape == "compressed") x.x() *= 0.5;
    if (shape == "twisted") {
      const Vec3 from(x.x(), x.y() - 0.01, x.z() - 0.01);
      const double c = std::cos(3 * along), s = std::sin(3 * along);
      x = Vec3(from.x(), c * from.y() - s * from.z() + 0.01, s * from.y() + c * from.z() + 0.01);
    }
    if (shape == "shaken" && along > 1e-9) x += random_vector(random, 0.003);
  }
  setup.solver.continuation = true;
  setup.solver.step = 0.01;
  return setup;
}

}  // namespace

TEST_CASE("budget: whatever it is, no step gains energy") {
  double worst = 0;
  for (const char* shape : {"stretched", "compressed", "twisted", "shaken"})
    for (const Integrator integrator : implicit_integrators())
      for (const Minimiser minimiser : {Minimiser::newton, Minimiser::lbfgs})
        for (const int iterations : {1, 3}) {
          CAPTURE(std::string(shape));
          CAPTURE(std::string(integrator_name(integrator)));
          CAPTURE(iterations);
          WorldSetup setup = let_go(shape);
          setup.solver.integrator = integrator;
          setup.solver.minimiser = minimiser;
          setup.solver.budget = Budget{iterations, 0};
          const auto world = make_world(setup);
          const double first = total(world->energies());
          double before = first;
          for (int k = 0; k < 15; ++k) {
            world->tick();
            REQUIRE(!world->halt());
            const double now = total(world->energies());
            worst = std::max(worst, (now - before) / first);
            before = now;
          }
        }
  CHECK(worst <= 1e-6);
}

TEST_CASE("budget: energy rises by no more than gravity's work, and with enough iterations a budget changes nothing") {
  WorldSetup setup = cantilever();
  setup.solver.integrator = Integrator::backward_euler;
  setup.solver.step = 0.01;
  const auto free = make_world(setup);
  setup.solver.budget = Budget{1000, 0};
  const auto ample = make_world(setup);
  setup.solver.budget = Budget{1, 0};
  const auto tight = make_world(setup);
  for (int k = 0; k < 20; ++k) {
    free->tick();
    ample->tick();
    tight->tick();
  }
  CHECK(free->state_hash() == ample->state_hash());
  CHECK(tight->solver_stats().iterations == 20);
  const double fallen = rms_difference(free->positions(), setup.mesh.nodes);
  CHECK(rms_difference(free->positions(), tight->positions()) <= 0.1 * fallen);
}

TEST_CASE("budget: one iteration a stage follows a swing, where forces left unbalanced would start each step") {
  std::mt19937_64 random(7);
  WorldSetup setup = cantilever();
  setup.mesh = irregular_box(random, {10, 8, 6});
  setup.boundary = {{nodes_where(setup.mesh, [](const Vec3& X) { return X.x() < 0.006; })}};
  setup.materials = {{std::nullopt, soft("neo_hookean", 3e3, 0.45)}};
  setup.solver.integrator = Integrator::tr_bdf2;
  setup.solver.step = 0.01;
  setup.solver.continuation = true;
  const auto solved = make_world(setup);
  setup.solver.budget = Budget{1, 0};
  const auto few = make_world(setup);
  double largest = 0;
  for (int k = 0; k < 60; ++k) {
    solved->tick();
    few->tick();
    largest = std::max(largest, rms_difference(few->positions(), solved->positions()));
  }
  CHECK(largest < 1e-3);  // m, of a swing of 0.11; 0.05 with the acceleration of all forces
}

TEST_CASE("budget: what one iteration leaves in the velocity after a jerk is damped, and the motion goes on") {
  WorldSetup setup = cantilever();
  setup.solver.integrator = Integrator::tr_bdf2;
  setup.solver.step = 0.01;
  setup.solver.continuation = true;
  setup.solver.budget = Budget{1, 0};
  const auto world = make_world(setup);
  for (int k = 0; k < 10; ++k) world->tick();
  CHECK(world->solver_stats().damped_steps == 0);  // a swing that the step resolves is left to the method
  // As noise would be: neighbours fly apart.
  REQUIRE(world->apply(Grasp{static_cast<int>(setup.mesh.nodes.size()) - 1, 0.004}).ok());
  REQUIRE(world->apply(MoveTool{world->positions().back() + Vec3(0.01, 0.02, 0.03)}).ok());
  world->tick();
  REQUIRE(world->apply(Release{}).ok());
  for (int k = 0; k < 3; ++k) world->tick();
  CHECK(world->solver_stats().damped_steps > 0);
}

TEST_CASE("budget: milliseconds are turned into iterations by a fixed model, or by the command that says how many") {
  WorldSetup setup = cantilever();
  setup.solver.integrator = Integrator::tr_bdf2;
  setup.solver.budget = Budget{0, 1e-6};
  const auto world = make_world(setup);
  CHECK(world->solver_stats().budget == 1);
  CHECK(world->apply(SetBudget{7}).ok());
  CHECK(world->solver_stats().budget == 7);
  CHECK_FALSE(world->apply(SetBudget{0}).ok());
}

TEST_CASE("L-BFGS ends where Newton's method does") {
  WorldSetup setup = cantilever();
  setup.solver.integrator = Integrator::backward_euler;
  setup.solver.step = 0.01;
  const auto newton = make_world(setup);
  setup.solver.minimiser = Minimiser::lbfgs;
  const auto quasi = make_world(setup);
  for (int k = 0; k < 20; ++k) {
    newton->tick();
    quasi->tick();
  }
  REQUIRE(!quasi->halt());
  CHECK(quasi->solver_stats().linear.iterations == 0);
  CHECK(rms_difference(newton->positions(), quasi->positions()) <=
        1e-6 * rms_difference(newton->positions(), setup.mesh.nodes));
}

TEST_CASE("every projection and every preconditioner leads to the same equilibrium") {
  std::vector<Vec3> first;
  const auto sag = [&](Projection projection, std::optional<Preconditioner> preconditioner) {
    WorldSetup setup = cantilever();
    setup.mesh = make_box(Vec3(0.1, 0.02, 0.02), {6, 2, 2});
    setup.boundary[0].nodes = nodes_where(setup.mesh, [](const Vec3& X) { return X.x() < 1e-9; });
    setup.solver.integrator = Integrator::static_equilibrium;
    setup.solver.projection = projection;
    setup.solver.preconditioner = preconditioner;
    const auto world = make_world(setup);
    world->load_to(1);
    REQUIRE_MESSAGE(!world->halt(), world->halt()->message);
    if (first.empty()) first = world->positions();
    CHECK(rms_difference(world->positions(), first) <= 1e-7 * rms_difference(first, setup.mesh.nodes));
  };
  for (const Projection projection : {Projection::element, Projection::none, Projection::shift, Projection::tension})
    sag(projection, std::nullopt);
  for (const Preconditioner preconditioner :
       {Preconditioner::scalar, Preconditioner::multilevel, Preconditioner::block_jacobi})
    sag(Projection::element, preconditioner);
}

}  // namespace heml::budget_test
