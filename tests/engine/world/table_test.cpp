// A body on a table: closed forms of weight, of pressing and of Coulomb's friction.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "world_support.hpp"

namespace heml::table_test {

using namespace heml::test;

namespace {

constexpr double side = 0.04, g = 9.81;
constexpr double weight = side * side * side * 1000 * g;

/// A cube that rests on a table through the origin, which is tilted by turning gravity.
WorldSetup cube_on_table(Integrator integrator, double friction = 0, double degrees = 0) {
  WorldSetup setup;
  setup.mesh = make_box(Vec3(side, side, side), {3, 3, 3});
  setup.materials = {{std::nullopt, soft("neo_hookean", 2e4)}};
  setup.tables = {{Vec3::Zero(), Vec3::UnitY(), friction}};
  const double angle = degrees * std::numbers::pi / 180;
  setup.gravity = g * Vec3(std::sin(angle), -std::cos(angle), 0);
  setup.solver.integrator = integrator;
  setup.solver.threads = 1;
  if (integrator == Integrator::static_equilibrium) setup.solver.tolerance = 1e-9;
  if (integrator > Integrator::verlet && integrator < Integrator::static_equilibrium) setup.solver.step = 0.005;
  return setup;
}

Vec3 mean(const std::vector<Vec3>& values) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double lowest(const World& world) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& x : world.positions()) least = std::min(least, x.y());
  return least;
}

}  // namespace

TEST_CASE("table: at rest it bears the weight, in a static world to the solver's digits") {
  auto world = make_world(cube_on_table(Integrator::static_equilibrium));
  world->load_to(1);
  REQUIRE_FALSE(world->halt());
  const TableState table = tools_of<TableState>(world->tools()).front();
  CHECK((table.force - Vec3(0, weight, 0)).norm() <= 1e-6 * weight);
  CHECK(table.contact_count == 16);
  CHECK(table.max_penetration <= 1e-4 * side * std::sqrt(3.0));
  CHECK(lowest(*world) >= -1e-4 * side * std::sqrt(3.0));
}

TEST_CASE("table: every method ends at rest on it, and what it bears is the weight") {
  for (const auto integrator : moving_integrators()) {
    CAPTURE(integrator_name(integrator));
    WorldSetup setup = cube_on_table(integrator);
    setup.solver.damping = 50;
    auto world = make_world(setup);
    run_until(*world, 1);
    REQUIRE_FALSE(world->halt());
    CHECK((tools_of<TableState>(world->tools())[0].force - Vec3(0, weight, 0)).norm() <= 1e-3 * weight);
    CHECK(lowest(*world) >= -1e-4 * side * std::sqrt(3.0));
    if (is_explicit(integrator)) CHECK(lowest(*world) >= -1e-12);
  }
}

TEST_CASE("table: a dropped body never passes it, its energy never rises, and in the mean it bears the weight") {
  WorldSetup setup = cube_on_table(Integrator::verlet);
  for (Vec3& X : setup.mesh.nodes) X.y() += 0.02;
  auto world = make_world(setup);
  const double start = total(world->energies());
  std::array<double, 4> most{start, start, start, start};  // energy in each half second
  Vec3 borne = Vec3::Zero();
  CHECK(lowest(*world) == doctest::Approx(0.02));
  for (int tick = 0; tick < 2000; ++tick) {
    world->tick();
    double& highest = most[static_cast<std::size_t>(tick / 500)];
    const double now = total(world->energies());
    highest = tick % 500 == 0 ? now : std::max(highest, now);
    borne += tools_of<TableState>(world->tools())[0].force / 2000;
    if (lowest(*world) < -1e-12) CHECK(lowest(*world) >= -1e-12);
  }
  CHECK(most[0] <= start + 1e-3 * weight * 0.02);
  for (std::size_t k = 1; k < 4; ++k) CHECK(most[k] < most[k - 1]);
  const double momentum = side * side * side * 1000 * mean(world->velocities()).y();  // what 2 s have left over
  CHECK(borne.y() == doctest::Approx(weight + momentum / 2).epsilon(2e-3));
}

TEST_CASE("table: pressed flat without friction a block is in uniaxial stress") {
  // Neo-Hookean with free sides: s = mu (l^2 - a^2)/(l a^2), the axial first Piola-Kirchhoff stress of stretches l, a,
  // a.
  WorldSetup setup = cube_on_table(Integrator::static_equilibrium);
  setup.gravity.setZero();
  const double pressure = 3000;
  setup.loads.push_back({Load::Kind::traction,
                         nodes_where(setup.mesh, [](const Vec3& X) { return X.y() > side - 1e-9; }),
                         Vec3(0, -pressure, 0)});
  auto world = make_world(setup);
  world->load_to(1);
  REQUIRE_FALSE(world->halt());
  const LameParameters lame = lame_parameters(2e4, 0.3);
  double l = 1, a = 1;
  for (int k = 0; k < 200; ++k) {  // both stresses vanish or are the pressure: Newton in two unknowns, by differences
    const auto stress = [&](double along, double across, double& s, double& t) {
      const double J = along * across * across, p = lame.lambda * std::log(J) - lame.mu;
      s = lame.mu * along + p / along + pressure;
      t = lame.mu * across + p / across;
    };
    double s, t, s1, t1, s2, t2;
    stress(l, a, s, t);
    stress(l + 1e-7, a, s1, t1);
    stress(l, a + 1e-7, s2, t2);
    const double ss = (s1 - s) / 1e-7, sa = (s2 - s) / 1e-7, ts = (t1 - t) / 1e-7, ta = (t2 - t) / 1e-7;
    const double det = ss * ta - sa * ts;
    l -= (ta * s - sa * t) / det;
    a -= (ss * t - ts * s) / det;
  }
  double top = 0, wide = 0, narrow = 1;
  for (const Vec3& x : world->positions()) {
    top = std::max(top, x.y());
    wide = std::max(wide, x.x());
    narrow = std::min(narrow, x.x());
  }
  CHECK(l < 0.9);
  CHECK(top - lowest(*world) == doctest::Approx(l * side).epsilon(2e-4));  // it may be 1e-4 of its size inside
  CHECK(wide - narrow == doctest::Approx(a * side).epsilon(5e-4));         // and not everywhere as much
  CHECK(tools_of<TableState>(world->tools())[0].force.y() == doctest::Approx(pressure * side * side).epsilon(1e-6));
}

TEST_CASE("table: below the angle of friction a block stays, above it slides as Coulomb says") {
  const double mu = 0.4;
  for (const auto integrator : {Integrator::verlet, Integrator::backward_euler}) {
    CAPTURE(integrator_name(integrator));
    WorldSetup setup = cube_on_table(integrator, mu, 20);  // atan 0.4 = 21.8 degrees
    setup.solver.damping = 20;
    auto still = make_world(setup);
    run_until(*still, 0.4);
    const Vec3 there = mean(still->positions());
    run_until(*still, 0.6);
    REQUIRE_FALSE(still->halt());
    CHECK((mean(still->positions()) - there).norm() <= 1e-5);

    setup = cube_on_table(integrator, mu, 35);
    auto sliding = make_world(setup);
    run_until(*sliding, 0.1);
    const double before = mean(sliding->velocities()).x();
    run_until(*sliding, 0.3);
    REQUIRE_FALSE(sliding->halt());
    const double angle = 35 * std::numbers::pi / 180;
    const double expected = g * (std::sin(angle) - mu * std::cos(angle));
    CHECK(tools_of<TableState>(sliding->tools())[0].work < 0);
    CHECK((mean(sliding->velocities()).x() - before) / 0.2 == doctest::Approx(expected).epsilon(0.02));
  }
}

TEST_CASE("table: in a static world friction holds a block on a slope") {
  auto world = make_world(cube_on_table(Integrator::static_equilibrium, 0.5, 20));
  world->load_to(1);
  REQUIRE_FALSE(world->halt());
  const Vec3 force = tools_of<TableState>(world->tools())[0].force;
  CHECK((force + weight / g * world->setup().gravity).norm() <= 1e-6 * weight);
}

TEST_CASE("table: bits are the same for one thread and two, and a table that is far away changes none") {
  const auto hash = [](int threads, bool with_table) {
    WorldSetup setup = cube_on_table(Integrator::verlet, 0.3, 25);
    setup.solver.threads = threads;
    if (!with_table) setup.tables.clear();
    if (threads < 0) setup.tables[0].point.y() = -100;
    setup.solver.threads = std::abs(threads);
    auto world = make_world(setup);
    for (int k = 0; k < 50; ++k) world->tick();
    return world->state_hash();
  };
  CHECK(hash(1, true) == hash(2, true));
  CHECK(hash(-1, true) == hash(1, false));
}

TEST_CASE("table: one that is put where tissue is rises into it, throws nothing and comes to its place") {
  constexpr double height = 0.03;  // of a cube of 0.04 m
  const double diagonal = side * std::sqrt(3.0), mass = side * side * side * 1000;
  for (const Integrator integrator : moving_integrators()) {
    WorldSetup setup = cube_on_table(integrator);
    setup.solver.step.reset();
    setup.solver.rate = 60;
    setup.solver.damping = 2;
    auto world = make_world(setup);
    for (int tick = 0; tick < 10; ++tick) world->tick();
    REQUIRE(world->apply(SetTables{{{Vec3(0, height, 0), Vec3::UnitY(), 0.2}}}).ok());
    CAPTURE(std::string(integrator_name(integrator)));
    double fastest = 0;
    for (int tick = 0; tick < 120; ++tick) {
      world->tick();
      REQUIRE_FALSE(world->halt());
      fastest = std::max(fastest, std::sqrt(2 * world->energies().kinetic / mass));
      CHECK(inverted(*world) == 0);
    }
    CHECK(fastest < 3 * diagonal);  // it rises by a diagonal a second
    CHECK(lowest(*world) >= height - 1e-3 * side);
    CHECK(mean(world->positions()).y() == doctest::Approx(height + side / 2).epsilon(0.1));
  }
}

TEST_CASE("table: a body that begins in one comes out of it, and a static world has it at its place") {
  WorldSetup setup = cube_on_table(Integrator::verlet);
  setup.tables[0].point.y() = side / 2;
  setup.solver.damping = 5;
  auto world = make_world(setup);
  const double first = lowest(*world), risen = 1.01 * side * std::sqrt(3.0) * setup.solver.tick();
  world->tick();
  CHECK(lowest(*world) < first + risen);
  while (world->time() < 2) world->tick();
  CHECK(lowest(*world) >= side / 2 - 1e-6);
  world->apply(Reset{});
  CHECK(lowest(*world) == first);
  world->tick();
  CHECK(lowest(*world) < first + risen);
  setup.solver = cube_on_table(Integrator::static_equilibrium).solver;
  auto still = make_world(setup);
  still->load_to(1);
  REQUIRE_FALSE(still->halt());
  CHECK(lowest(*still) >= side / 2 - 1e-3 * side);
}

TEST_CASE("table: a wrong one is refused and changes nothing") {
  auto world = make_world(cube_on_table(Integrator::verlet));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(world->apply(SetTables{{{Vec3(0, nan, 0), Vec3::UnitY(), 0}}}).ok());
  CHECK_FALSE(world->apply(SetTables{{{Vec3::Zero(), Vec3::Zero(), 0}}}).ok());
  CHECK_FALSE(world->apply(SetTables{{{Vec3::Zero(), Vec3::UnitY(), -1}}}).ok());
  CHECK_FALSE(world->apply(SetTables{{{Vec3::Zero(), Vec3::UnitY(), nan}}}).ok());
  CHECK(tools_of<TableState>(world->tools()).size() == 1);
  CHECK(world->apply(SetTables{}).ok());
  CHECK(tools_of<TableState>(world->tools()).empty());
}

}  // namespace heml::table_test
