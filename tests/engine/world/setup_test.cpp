#include <doctest/doctest.h>

#include <heml/world/setup.hpp>
#include <heml/world/world.hpp>

#include "world_support.hpp"

namespace heml::setup_test {

using heml::test::soft;

namespace {

/// A small box, its nearest corner at a place, in float.
WorldSetup box_at(const Vec3& place) {
  WorldSetup setup;
  setup.mesh = make_box(Vec3(0.1, 0.08, 0.06), {3, 2, 2});
  for (Vec3& X : setup.mesh.nodes) X += place;
  setup.materials = {{std::nullopt, soft()}};
  setup.solver.single_precision = true;
  return setup;
}

double largest_force(const WorldSetup& setup) {
  std::vector<double> f(3 * setup.mesh.nodes.size());
  make_world(setup)->write_vectors(NodeVector::force, f);
  double largest = 0;
  for (const double each : f) largest = std::max(largest, std::abs(each));
  return largest;
}

}  // namespace

TEST_CASE("a body in float near the origin stays in float") {
  WorldSetup setup = box_at(Vec3(1, -2, 0.5));
  CHECK(fits_single_precision(setup));
  CHECK_FALSE(use_double_far_away(setup));
  CHECK_FALSE(use_double_for_memory(setup));
  CHECK(make_world(setup)->setup().solver.single_precision);
}

TEST_CASE("a body in float 10 km away is computed in double, to the tolerance of float") {
  WorldSetup setup = box_at(Vec3(1e4, -1e4, 1e4));
  setup.initial_positions = setup.mesh.nodes;
  CHECK(largest_force(setup) < 1e-7);  // 10 kPa on 0.1 m; in float several newtons
  setup.solver.integrator = Integrator::backward_euler;
  const auto world = make_world(setup);
  CHECK_FALSE(world->setup().solver.single_precision);
  CHECK(world->setup().solver.relative_tolerance() == 1e-4);
}

TEST_CASE("where a body starts counts, not only where its mesh lies") {
  WorldSetup setup = box_at(Vec3::Zero());
  setup.initial_positions = box_at(Vec3(0, 0, 1e3)).mesh.nodes;
  CHECK_FALSE(fits_single_precision(setup));
}

TEST_CASE("static solves of materials with memory are done in double, to the tolerance of float") {
  WorldSetup setup = box_at(Vec3::Zero());
  setup.materials[0].material.viscosity = 10;
  CHECK_FALSE(use_double_for_memory(setup));
  setup.solver.integrator = Integrator::static_equilibrium;
  const auto world = make_world(setup);
  CHECK_FALSE(world->setup().solver.single_precision);
  CHECK(world->setup().solver.relative_tolerance() == 1e-4);
}

TEST_CASE("an empty mesh is nowhere") { CHECK(fits_single_precision(WorldSetup{})); }

}  // namespace heml::setup_test
