// The stable step between evaluations of all elements.
#include <doctest/doctest.h>

#include "engine/elastic/small_body.hpp"
#include "world_support.hpp"

namespace heml::stable_step_test {

using namespace heml::test;

namespace {

WorldSetup irregular_block(std::mt19937_64& random, bool single) {
  WorldSetup setup;
  setup.mesh = irregular_box(random, {8, 7, 6});
  setup.materials = {{std::nullopt, sample_material("neo_hookean")}};
  setup.boundary = {{nodes_where(setup.mesh, [](const Vec3& X) { return X.x() < 0.008; })}};
  setup.gravity = Vec3(0, -9.81, 0);
  setup.solver.integrator = Integrator::verlet;
  setup.solver.single_precision = single;
  setup.solver.continuation = true;
  setup.solver.threads = 1;
  setup.solver.rate = 500;
  return setup;
}

/// From the bounds of all elements at the state of a world.
double of_all_elements(World& world, const WorldSetup& setup) {
  const auto other = make_world(setup);
  REQUIRE(other->restore(*world.snapshot()).ok());
  REQUIRE(other->apply(SetMaterial{std::nullopt, setup.materials[0].material}).ok());
  return other->stable_step();
}

}  // namespace

TEST_CASE("stable step: however a hand jerks, that of the elements looked at is that of all") {
  std::mt19937_64 random(7);
  for (const bool single : {false, true})
    for (const double radius : {0.012, 0.02}) {
      CAPTURE(single);
      CAPTURE(radius);
      const WorldSetup setup = irregular_block(random, single);
      const auto world = make_world(setup), whole = make_world(setup);
      REQUIRE(whole->apply(MoveProbe{0.001, Vec3::Zero(), 0, {Vec3(1, 1, 1)}})
                  .ok());  // touches nothing, but might: all elements are looked at
      const auto farthest = std::max_element(setup.mesh.nodes.begin(), setup.mesh.nodes.end(),
                                             [](const Vec3& a, const Vec3& b) { return a.sum() < b.sum(); });
      const Vec3 place = *farthest;
      for (World* w : {world.get(), whole.get()})
        REQUIRE(w->apply(Grasp{static_cast<int>(farthest - setup.mesh.nodes.begin()), radius}).ok());
      double widest = 0, oldest = 0;
      for (int k = 0; k < 120; ++k) {
        const Vec3 to = place + random_vector(random, 0.03);
        for (World* w : {world.get(), whole.get()}) {
          if (k % 10 == 0) REQUIRE(w->apply(MoveTool{to}).ok());
          w->tick();
          REQUIRE_FALSE(w->halt());
        }
        widest = std::max(widest, world->stable_step() / whole->stable_step());
        oldest = std::max(oldest, world->stable_step() / of_all_elements(*world, setup));
      }
      CHECK(widest < 1.02);     // as much as they may change between two evaluations
      CHECK(oldest < 1 / 0.9);  // evaluated some steps ago: the safety covers that
      MESSAGE("at most " << widest << " of the step that all elements allow, " << oldest << " of it a moment later");
    }
}

TEST_CASE("stable step: it grows with the body, from a micrometre to ten metres, also in float") {
  const auto step_of = [](double size, bool single) {
    WorldSetup setup;
    setup.mesh = make_box(Vec3(size, size, size), {4, 4, 4});
    setup.materials = {{std::nullopt, soft()}};
    setup.solver.single_precision = single;
    setup.solver.threads = 1;
    return make_world(setup)->stable_step();
  };
  const double of_a_metre = step_of(1, false);
  for (const bool single : {false, true})
    for (const double size : {1e-6, 1e-5, 1e-3, 0.1, 10.0}) {
      CAPTURE(single);
      CAPTURE(size);
      CHECK(step_of(size, single) == doctest::Approx(of_a_metre * size).epsilon(1e-3));
    }
}

}  // namespace heml::stable_step_test
