#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <heml/base/error.hpp>
#include <heml/mesh/generate.hpp>
#include <heml/session/comparison_runs.hpp>
#include <heml/session/surface_mesh.hpp>

#include "engine/world/world_support.hpp"
#include "skinned_body.hpp"

namespace heml::comparison_runs_test {

using namespace heml::test;

namespace {

/// The frame of a world and its comparison runs after a number of ticks.
Frame after(World& world, ComparisonRuns& comparison_runs, int ticks) {
  for (int k = 0; k < ticks; ++k) comparison_runs.tick(world);
  Frame frame;
  fill_frame(world, make_surface_mesh(world), Field::none, 0, frame);
  comparison_runs.fill(world, frame);
  return frame;
}

}  // namespace

TEST_CASE("comparison runs: one of the same law and method gives the bits of the body") {
  const WorldSetup setup = cantilever();
  const auto world = make_world(setup);
  ComparisonRuns comparison_runs(setup, {"neo_hookean", "verlet", "double+p1"});
  const Frame frame = after(*world, comparison_runs, 50);
  REQUIRE(frame.comparisons.size() == 3);
  for (const Frame& comparisons : frame.comparisons) {
    CHECK(comparisons.tick == 50);
    CHECK(comparisons.positions == frame.positions);
    REQUIRE(comparisons.distance);
    CHECK(comparisons.distance->max == 0);
  }
  CHECK(frame.comparisons[2].variant == "double+p1");
}

TEST_CASE("comparison runs: each has the skin, cut as its own body is") {
  SkinnedBody body(0.001);
  ComparisonRuns comparison_runs(body.world->setup(), {"neo_hookean"});
  SkinAttachment attachment(body.skin);
  std::shared_ptr<const SurfaceMesh> surface;
  const auto frame_now = [&] {
    Frame frame;
    surface = make_surface_mesh(*body.world, surface);
    fill_frame(*body.world, surface, Field::none, 0, frame);
    attachment.attach(*body.world, frame);
    comparison_runs.fill(*body.world, frame, 0, attachment);
    return frame;
  };
  CHECK(frame_now().comparisons[0].skin == body.skin);
  body.sever(0.033, 0.051);
  const Frame apart = frame_now();  // the run has not been cut
  CHECK(apart.skin != body.skin);
  CHECK(apart.comparisons[0].skin == body.skin);
  const Vec3 from(0.02, -0.01, -0.01), to(0.02, 0.09, -0.01), up(0, 0, 0.1);
  comparison_runs.apply(CutTissue{{{{from, from + up}, {to, to + up}}}, false});
  const Frame both = frame_now();
  REQUIRE(both.comparisons[0].skin);
  CHECK(both.comparisons[0].skin != body.skin);
  CHECK(both.comparisons[0].skin != both.skin);
  CHECK(both.comparisons[0].skin->surface.mesh.triangles.size() > body.skin->surface.mesh.triangles.size());
}

TEST_CASE("comparison runs: another method differs by its time error, another law by its stress") {
  const WorldSetup setup = cantilever();
  const auto world = make_world(setup);
  ComparisonRuns comparison_runs(setup, {"tr_bdf2", "stvk"});
  const Frame frame = after(*world, comparison_runs, 200);
  const double moved = (frame.positions.back() - frame.surface_mesh->rest.back()).norm();
  REQUIRE(frame.comparisons[0].distance);
  CHECK(frame.comparisons[0].distance->max > 0);
  CHECK(frame.comparisons[0].distance->max < 0.01 * moved);
  CHECK(frame.comparisons[1].distance->max > 0.01 * moved);
  CHECK(frame.comparisons[1].distance->mean <= frame.comparisons[1].distance->max);
}

TEST_CASE("comparison runs: commands apply to them too, except changes of their own law and method") {
  const WorldSetup setup = cantilever();
  const auto world = make_world(setup), alone = make_world(setup);
  ComparisonRuns comparison_runs(setup, {"verlet"});
  const auto both = [&](const Command& command) {
    CHECK(world->apply(command).ok());
    comparison_runs.apply(command);
  };
  const int tip = nodes_where(setup.mesh, [](const Vec3& X) { return (X - Vec3(0.1, 0.02, 0.02)).norm() < 1e-9; })[0];
  both(Grasp{tip, 0.01});
  both(MoveTool{Vec3(0.11, 0.03, 0.02)});
  both(SetMaterial{std::nullopt, soft("stvk", 2e4)});
  Frame frame = after(*world, comparison_runs, 50);
  CHECK(frame.comparisons[0].positions == frame.positions);
  CHECK(force_of<GraspState>(frame.comparisons[0].tools) == force_of<GraspState>(frame.tools));
  CHECK(frame.variant == "stvk, verlet");
  both(SetIntegrator{Integrator::backward_euler});
  frame = after(*world, comparison_runs, 50);
  CHECK(frame.comparisons[0].positions != frame.positions);
  CHECK(frame.variant == "stvk, backward_euler");
}

TEST_CASE("comparison runs: one that fails stops and reports why, the body continues") {
  WorldSetup setup = cantilever("stvk");
  setup.gravity.setZero();
  Boundary crush{nodes_where(setup.mesh, [](const Vec3& X) { return X.x() > 0.0999; })};
  crush.translate = Vec3(-0.15, 0, 0);
  crush.ramp_time = 0.1;
  setup.boundary.push_back(crush);
  const auto world = make_world(setup);
  ComparisonRuns comparison_runs(setup, {"neo_hookean"});
  const Frame frame = after(*world, comparison_runs, 100);
  CHECK(frame.halted.empty());
  CHECK(frame.tick == 100);
  CHECK_FALSE(frame.comparisons[0].halted.empty());
  CHECK(frame.comparisons[0].tick < 100);
}

TEST_CASE("comparison runs: their time is measured separately from the body's") {
  WorldSetup setup = cantilever();
  setup.mesh = make_box(Vec3(0.1, 0.02, 0.02), {20, 4, 4});
  setup.boundary = {{nodes_where(setup.mesh, [](const Vec3& X) { return X.x() < 1e-9; })}};
  const auto world = make_world(setup);
  ComparisonRuns comparison_runs(setup, {"backward_euler", "tr_bdf2", "bdf2"});
  double largest = 0;  // share of a tick; one large share suffices, since other load disturbs the timing
  for (int k = 0; k < 20; ++k) {
    const auto began = std::chrono::steady_clock::now();
    const double waited = comparison_runs.tick(*world);
    const double all = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    CHECK(waited >= 0);
    CHECK(waited <= all);
    largest = std::max(largest, waited / all);
  }
  CHECK(largest > 0.5);
}

TEST_CASE("comparison runs: unknown words are refused with a list of the known ones") {
  for (const char* words : {"", "ogdn", "ogden+", "ogden,stvk", "static"}) {
    CAPTURE(words);
    CHECK_THROWS_WITH_AS(variant_of(cantilever(), words), doctest::Contains("neo_hookean, "), InputError);
  }
  WorldSetup at_rest = cantilever();
  at_rest.solver.integrator = Integrator::static_equilibrium;
  CHECK_THROWS_AS(variant_of(at_rest, "verlet"), InputError);
  CHECK(variant_of(at_rest, "ogden+float").setup.solver.single_precision);
}

TEST_CASE("comparison runs: a region's material is the body's, and a copy of its own in a run of another law") {
  const WorldSetup setup = cantilever();
  const auto world = make_world(setup);
  ComparisonRuns comparison_runs(setup, {"double", "stvk"});
  Material stiff = soft("neo_hookean", 5e4);
  const Command tag = TagRegion{{{}, {{0, 1, 2}, {}, {}, {}}, "lesion", {}}, stiff};
  REQUIRE(world->apply(tag).ok());
  comparison_runs.apply(tag);
  const Frame frame = after(*world, comparison_runs, 20);
  REQUIRE(frame.comparisons.size() == 2);
  CHECK(frame.comparisons[0].positions == frame.positions);
  CHECK(frame.comparisons[0].regions->materials[1].material == stiff);
  CHECK(frame.comparisons[1].regions->materials[1].material.law == "stvk");
}

}  // namespace heml::comparison_runs_test
