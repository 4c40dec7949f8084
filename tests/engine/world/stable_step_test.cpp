// The stable step between evaluations of all elements.
#include <doctest/doctest.h>

#include <heml/world/facts.hpp>

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

namespace {

/// A cantilever with a sliver.
WorldSetup with_sliver(bool quadratic) {
  WorldSetup setup = cantilever();
  flatten_one(setup.mesh, 0.03);
  setup.solver.quadratic = quadratic;
  if (quadratic) setup.midedges = add_midedge_nodes(setup.mesh);
  return setup;
}

}  // namespace

TEST_CASE("mass scaling: a sliver costs fewer steps for a twentieth of the mass, and nothing hangs lower for it") {
  for (const bool quadratic : {false, true}) {
    CAPTURE(quadratic);
    WorldSetup setup = with_sliver(quadratic);
    setup.solver.damping = 20;
    const auto plain = make_world(setup);
    setup.solver.mass_scaling = 0.05;
    const auto scaled = make_world(setup);
    CHECK(scaled->stable_step() > 1.3 * plain->stable_step());
    const StepFacts facts = scaled->facts().step, before = plain->facts().step;
    CHECK(facts.added_mass == doctest::Approx(0.05).epsilon(1e-6));
    CHECK(facts.heavier_nodes > 0);
    CHECK(facts.heavier_nodes < static_cast<int>(setup.mesh.nodes.size()) / 10);
    CHECK(facts.scaled_step == 1);
    CHECK(before.added_mass == 0);
    CHECK(before.scaled_step > 1.05);
    CHECK(before.scaled_step < scaled->stable_step() / plain->stable_step());  // of a hundredth
    for (World* world : {plain.get(), scaled.get()}) {
      for (int tick = 0; tick < 3000; ++tick) world->tick();
      REQUIRE_FALSE(world->halt());
    }
    // Both have come to rest, where gravity holds the true masses.
    const double sag = rms_difference(plain->positions(), setup.mesh.nodes);
    CHECK(rms_difference(plain->positions(), scaled->positions()) < 1e-6 * sag);
    CHECK(plain->reactions()[0].y() == doctest::Approx(scaled->reactions()[0].y()).epsilon(1e-6));
    CHECK(scaled->steps() < plain->steps() / 1.25);
  }
}

TEST_CASE("mass scaling: the energy of a swing is kept at the longer steps") {
  WorldSetup setup = with_sliver(false);
  setup.solver.mass_scaling = 0.05;
  const auto world = make_world(setup);
  double least = 0, most = 0, highest = 0;
  for (int tick = 0; tick < 1000; ++tick) {
    world->tick();
    REQUIRE_FALSE(world->halt());
    const Energies e = world->energies();
    const double sum = e.kinetic + e.elastic + e.potential;
    least = std::min(least, sum), most = std::max(most, sum), highest = std::max(highest, e.elastic);
  }
  CHECK(most - least < 0.02 * highest);
}

TEST_CASE("mass scaling: cuts, materials and what takes them back leave masses and bounds of each other") {
  for (const bool quadratic : {false, true}) {
    CAPTURE(quadratic);
    WorldSetup setup = with_sliver(quadratic);
    setup.solver.mass_scaling = 0.02;
    const auto world = make_world(setup);
    const double first = world->stable_step();
    const auto check = [&] {
      for (int tick = 0; tick < 5; ++tick) world->tick();
      REQUIRE_FALSE(world->halt());
      const double added = world->facts().step.added_mass;
      CHECK(added > 0.019);
      CHECK(added < 0.021);
    };
    check();
    REQUIRE(world->apply(blade_at(0.047)).ok());
    check();
    REQUIRE(world->apply(Undo{}).ok());
    check();
    REQUIRE(world->apply(SetMaterial{std::nullopt, soft("neo_hookean", 4e4)}).ok());
    CHECK(world->stable_step() == doctest::Approx(first / 2).epsilon(0.05));
    check();
    REQUIRE(world->apply(StepHistory{-1}).ok());
    check();
    // Heat shrinks elements for a while: smaller ones, other factors.
    CauterizeTissue burn;
    burn.sweep.blades = {{Vec3(0.02, 0.02, -0.01), Vec3(0.02, 0.02, -0.01)},
                         {Vec3(0.02, 0.02, 0.03), Vec3(0.02, 0.02, 0.03)}};
    burn.heat = {0.008, usual_shrink};
    REQUIRE(world->apply(burn).ok());
    for (int k = 0; k < 100; ++k) check();
  }
}

}  // namespace heml::stable_step_test
