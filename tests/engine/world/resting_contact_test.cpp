// Explicit steps in resting contact: what rests stays where it is, friction holds what it can, and a step's cost,
// counted in rounds, is bounded.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "world_support.hpp"

namespace heml::resting_contact_test {

using namespace heml::test;

namespace {

constexpr double side = 0.04, g = 9.81;

void add_box(TetMesh& mesh, const Vec3& size, const std::array<int, 3>& cells, const Vec3& origin) {
  const TetMesh box = make_box(size, cells, origin);
  const auto first = static_cast<int>(mesh.nodes.size());
  mesh.nodes.insert(mesh.nodes.end(), box.nodes.begin(), box.nodes.end());
  for (Tet tet : box.tets) {
    for (int& n : tet) n += first;
    mesh.tets.push_back(tet);
  }
  mesh.regions.insert(mesh.regions.end(), box.regions.begin(), box.regions.end());
}

/// Three blocks on one another on a table.
WorldSetup three_blocks() {
  WorldSetup setup;
  setup.mesh = make_box(Vec3(side, side, side), {3, 3, 3});
  add_box(setup.mesh, Vec3(side, 0.8 * side, side), {3, 2, 3}, Vec3(0.002, side, 0.001));
  add_box(setup.mesh, Vec3(side, 0.8 * side, side), {2, 3, 2}, Vec3(0.004, 1.8 * side, 0.002));
  setup.materials = {{std::nullopt, soft("neo_hookean", 2e4)}};
  setup.tables = {{Vec3::Zero(), Vec3::UnitY(), 0.4}};
  setup.self_contact = SelfContactSettings{0.4};
  setup.gravity = Vec3(0, -g, 0);
  setup.solver.damping = 20;
  setup.solver.threads = 1;
  return setup;
}

Vec3 mean(const std::vector<Vec3>& values) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// A block on a slope: a table, or a slab that is held.
WorldSetup on_slope(bool on_table, double degrees, double friction) {
  WorldSetup setup;
  setup.materials = {{std::nullopt, soft("neo_hookean", 2e4)}};
  const Vec3 size(0.03, 0.01, 0.03);
  setup.mesh = make_box(size, {2, 1, 2}, Vec3(0.01, 0, 0.005));
  if (on_table) {
    setup.tables = {{Vec3::Zero(), Vec3::UnitY(), friction}};
  } else {
    setup.self_contact = SelfContactSettings{friction};
    add_box(setup.mesh, Vec3(0.2, 0.01, 0.04), {15, 1, 3}, Vec3(0, -0.01, 0));
    setup.boundary.push_back({});
    for (int n = 18; n < static_cast<int>(setup.mesh.nodes.size()); ++n) setup.boundary[0].nodes.push_back(n);
  }
  const double angle = degrees * std::numbers::pi / 180;
  setup.gravity = g * Vec3(std::sin(angle), -std::cos(angle), 0);
  setup.solver.threads = 1;
  return setup;
}

std::vector<Vec3> of_block(std::vector<Vec3> values) {
  values.resize(18);
  return values;
}

}  // namespace

TEST_CASE("resting contact: a stack stays where it is") {
  auto world = make_world(three_blocks());
  run_until(*world, 0.5);
  REQUIRE_FALSE(world->halt());
  const auto before = world->positions();
  run_until(*world, 2.5);
  REQUIRE_FALSE(world->halt());
  CHECK(rms_difference(world->positions(), before) < 3e-5);  // from 0.5 s on: it is still settling
  CHECK(world->energies().kinetic < 1e-12);  // J: no pair comes and goes
  const double weight = 2.6 * side * side * side * 1000 * g;
  CHECK(tool_of<TableState>(*world).force.y() == doctest::Approx(weight).epsilon(5e-3));
}

TEST_CASE("resting contact: cubes whose faces are halved across each other come to rest, with friction") {
  for (const int cells : {1, 2})
    for (const double friction : {0.3, 0.6}) {
      CAPTURE(cells);
      CAPTURE(friction);
      WorldSetup setup;
      const double edge = 0.03;
      setup.mesh = make_box(Vec3::Constant(edge), {1, 1, 1});
      const Eigen::AngleAxisd quarter_turn(std::numbers::pi / 2, Vec3::UnitY());
      const Eigen::Isometry3d place = Eigen::Translation3d(-0.001, 1.017 * edge, 0.003 + edge) * quarter_turn;
      add(setup.mesh, make_box(Vec3::Constant(edge), {cells, cells, cells}), place);
      setup.materials = {{std::nullopt, soft("neo_hookean", 8e3)}};
      setup.tables = {{Vec3::Zero(), Vec3::UnitY(), 0.5}};
      setup.self_contact = SelfContactSettings{friction};
      setup.gravity = Vec3(0, -g, 0);
      setup.solver.damping = 8;
      setup.solver.threads = 1;
      auto world = make_world(setup);
      run_until(*world, 4);
      REQUIRE_FALSE(world->halt());
      CHECK(world->energies().kinetic < 1e-9);  // J; an impact has 1e-4
    }
}

TEST_CASE("resting contact: a block on a slope does not creep, and slides where friction cannot hold it") {
  for (const bool on_table : {true, false}) {
    CAPTURE(on_table);
    auto still = make_world(on_slope(on_table, 20, 0.45));  // tan 20 degrees = 0.364
    run_until(*still, 0.5);
    const Vec3 there = mean(of_block(still->positions()));
    run_until(*still, 1.5);
    REQUIRE_FALSE(still->halt());
    CHECK((mean(of_block(still->positions())) - there).norm() < 8e-6);  // it vibrates by this, undamped

    const double friction = 0.2, angle = 20 * std::numbers::pi / 180;
    auto sliding = make_world(on_slope(on_table, 20, friction));
    run_until(*sliding, 0.1);
    const double before = mean(of_block(sliding->velocities())).x();
    run_until(*sliding, 0.3);
    REQUIRE_FALSE(sliding->halt());
    const double expected = g * (std::sin(angle) - friction * std::cos(angle));
    CHECK((mean(of_block(sliding->velocities())).x() - before) / 0.2 == doctest::Approx(expected).epsilon(0.05));
  }
}

}  // namespace heml::resting_contact_test
