#include <doctest/doctest.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <functional>
#include <heml/mesh/quadratic.hpp>
#include <heml/world/recovery_cause.hpp>

#include "engine/materials/sample_materials.hpp"
#include "state_support.hpp"
#include "support.hpp"
#include "world_support.hpp"

namespace heml::recovery_test {

using namespace heml::test;

namespace {

constexpr double side = 0.1;  // m

Material with_moduli(const std::string& law, double mu, double kappa) {
  Material material = sample_material(law, mu, kappa);
  REQUIRE_FALSE(material_problem(material));
  REQUIRE(small_strain_moduli(material).shear == doctest::Approx(mu));
  return material;
}

/// A cube of 10 kPa, held at x = 0, stepped by backward Euler.
WorldSetup cube(const std::string& law, double poisson) {
  WorldSetup setup;
  setup.mesh = make_box(Vec3(side, side, side), {2, 2, 2});
  setup.materials = {{std::nullopt, with_moduli(law, 1e4 / (2 + 2 * poisson), 1e4 / (3 - 6 * poisson))}};
  setup.boundary.push_back({nodes_where(setup.mesh, [](const Vec3& X) { return X.x() < 1e-9; })});
  setup.solver.integrator = Integrator::backward_euler;
  setup.solver.step = 1.0 / 60;
  setup.solver.threads = 1;
  setup.solver.recovery = true;
  return setup;
}

using Place = std::function<Vec3(const Vec3&)>;

const Vec3 middle = Vec3::Constant(side / 2);
Vec3 to_point(const Vec3&) { return middle; }
Vec3 to_line(const Vec3& X) { return {X.x(), middle.y(), middle.z()}; }
Vec3 to_plane(const Vec3& X) { return {X.x(), X.y(), middle.z()}; }
Vec3 mirrored(const Vec3& X) { return {X.x() > side / 2 ? side - X.x() : X.x(), X.y(), X.z()}; }
Place scattered(std::uint64_t seed) {
  return [random = std::mt19937_64(seed)](const Vec3&) mutable {
    return Vec3(uniform(random, 0, side), uniform(random, 0, side), uniform(random, 0, side));
  };
}

WorldSetup starting_at(WorldSetup setup, Place place) {
  for (const Vec3& X : setup.mesh.nodes) setup.initial_positions.push_back(place(X));
  return setup;
}

/// Rms distance from the rest shape, turned and moved as fits best, over the diagonal.
double away_from_rest(const std::vector<Vec3>& x, const std::vector<Vec3>& rest) {
  const auto mean = [](const std::vector<Vec3>& points) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& point : points) sum += point;
    return Vec3(sum / static_cast<double>(points.size()));
  };
  const Vec3 of_x = mean(x), of_rest = mean(rest);
  Mat3 moment = Mat3::Zero();
  for (std::size_t n = 0; n < x.size(); ++n) moment += (rest[n] - of_rest) * (x[n] - of_x).transpose();
  const Eigen::JacobiSVD<Mat3> svd(moment, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vec3 signs(1, 1, (svd.matrixV() * svd.matrixU().transpose()).determinant() < 0 ? -1 : 1);
  const Mat3 R = svd.matrixV() * signs.asDiagonal() * svd.matrixU().transpose();
  double sum = 0;
  for (std::size_t n = 0; n < x.size(); ++n) sum += (x[n] - of_x - R * (rest[n] - of_rest)).squaredNorm();
  return std::sqrt(sum / static_cast<double>(x.size())) / (std::sqrt(3.0) * side);
}

/// The step from which on the body is at rest to 0.1 %, none inverted; 0 when 60 do not suffice.
int steps_to_rest(World& world) {
  int since = 0;
  for (int step = 1; step <= 60 && !world.halt(); ++step) {
    world.tick();
    const bool at_rest = away_from_rest(world.positions(), world.setup().mesh.nodes) <= 1e-3 && inverted(world) == 0;
    if (!at_rest) since = 0;
    if (at_rest && since == 0) since = step;
    if (since > 0 && step >= since + 2) break;
  }
  return world.halt() ? 0 : since;
}

/// A damped cube of an element, stepped by a method.
WorldSetup cube_of(bool quadratic, bool pressure, Integrator integrator) {
  WorldSetup setup = cube("neo_hookean_iso", 0.45);
  if (quadratic) {
    setup.midedges = add_midedge_nodes(setup.mesh);
    setup.boundary[0].nodes = nodes_where(setup.mesh, [](const Vec3& X) { return X.x() < 1e-9; });
  }
  setup.solver.quadratic = quadratic;
  setup.solver.nodal_pressure = pressure;
  setup.solver.integrator = integrator;
  setup.solver.damping = 20;
  setup.solver.step.reset();
  setup.solver.rate = is_explicit(integrator) ? 1000 : 60;
  return setup;
}

template <class Visit>
void each_element_and_method(const Visit& visit) {
  for (const bool quadratic : {false, true})
    for (const bool pressure : {false, true})
      for (const Integrator integrator : moving_integrators()) {
        const WorldSetup setup = cube_of(quadratic, pressure, integrator);
        CAPTURE(std::string(setup.solver.element()));
        CAPTURE(std::string(integrator_name(integrator)));
        visit(setup);
      }
}

}  // namespace

TEST_CASE("recovery: of every element and by every method, what begins mirrored, flat or scattered is whole again") {
  each_element_and_method([](const WorldSetup& setup) {
    for (const Place& place : {Place(mirrored), Place(to_plane), scattered(8)}) {
      const auto world = make_world(starting_at(setup, place));
      REQUIRE(world->recovery());
      CHECK(world->recovery()->inverted > 0);
      run_until(*world, 1);
      REQUIRE_FALSE(world->halt());
      CHECK(world->recovery()->ended);
      CHECK(inverted(*world) == 0);
      CHECK(away_from_rest(world->positions(), setup.mesh.nodes) <= 1e-3);
    }
  });
}

TEST_CASE("recovery: of every element and by every method, a load too heavy for the law is survived") {
  each_element_and_method([](WorldSetup setup) {
    const auto world = make_world(setup);
    for (int tick = 0; tick < 6; ++tick) world->tick();
    REQUIRE(world->recoveries() == 0);
    for (double G = 1e5; G < 1e14 && world->recoveries() == 0; G *= 10) {
      REQUIRE(world->apply(SetGravity{Vec3(-G, 0, 0)}).ok());
      world->tick();
      REQUIRE_FALSE(world->halt());
    }
    REQUIRE(world->recoveries() == 1);
    REQUIRE(world->apply(SetGravity{Vec3::Zero()}).ok());
    run_until(*world, world->time() + 1.5);
    REQUIRE_FALSE(world->halt());
    CHECK(world->recovery()->ended);
    CHECK(away_from_rest(world->positions(), setup.mesh.nodes) <= 1e-3);
  });
}

TEST_CASE("recovery: loads change while it is under way, also where no state from before is kept any more") {
  const auto end_of = [](bool keeps_actions) {
    WorldSetup setup = starting_at(cube("neo_hookean", 0.3), mirrored);
    setup.keeps_actions = keeps_actions;
    const auto world = make_world(setup);
    world->tick();
    REQUIRE_FALSE(world->recovery()->ended);
    const auto loaded = nodes_where(setup.mesh, [](const Vec3& X) { return X.x() > side - 1e-9; });
    REQUIRE(world->apply(SetLoads{{{Load::Kind::force, loaded, Vec3(0, 0, 2)}}}).ok());
    for (int k = 1; k <= 40; ++k) {  // more actions than are kept
      REQUIRE(world->apply(SetDamping{0.01 * k}).ok());
      world->tick();
    }
    run_until(*world, 1.5);
    REQUIRE_FALSE(world->halt());
    CHECK(world->recovery()->ended);
    return world->positions();
  };
  CHECK(end_of(true) == end_of(false));
}

TEST_CASE("recovery: a quadratic element is judged at its points, whatever its corners do") {
  WorldSetup setup = cube_of(true, false, Integrator::backward_euler);
  setup.initial_positions = setup.mesh.nodes;  // corners at rest, the middles of one element's edges through its middle
  const std::array<int, 10> nodes = quadratic_nodes(setup.mesh.tets[7], setup.midedges[7]);
  Vec3 centre = Vec3::Zero();
  for (std::size_t c = 0; c < 4; ++c) centre += setup.mesh.nodes[static_cast<std::size_t>(nodes[c])] / 4;
  for (std::size_t a = 4; a < 10; ++a) {
    Vec3& x = setup.initial_positions[static_cast<std::size_t>(nodes[a])];
    x = 2 * centre - x;
  }
  const auto world = make_world(setup);
  REQUIRE(world->recovery());
  CHECK(world->recovery()->inverted > 0);
  CHECK(world->recovery()->min_J < 0);
  CHECK(steps_to_rest(*world) > 0);
}

TEST_CASE("recovery: a body that nothing holds comes back too, and from ten other scatters, and in float") {
  int slowest = 0;
  for (const Place& place : {Place(to_point), Place(to_line), Place(to_plane), scattered(2)}) {
    WorldSetup setup = starting_at(cube("neo_hookean", 0.49), place);
    setup.boundary.clear();
    const int steps = steps_to_rest(*make_world(setup));
    CHECK(steps > 0);
    slowest = std::max(slowest, steps);
  }
  for (std::uint64_t seed = 10; seed < 20; ++seed) {
    CAPTURE(seed);
    WorldSetup setup = starting_at(cube("neo_hookean_iso", 0.49), scattered(seed));
    setup.solver.single_precision = seed % 2;
    const int steps = steps_to_rest(*make_world(setup));
    CHECK(steps > 0);
    slowest = std::max(slowest, steps);
  }
  MESSAGE("the slowest took " << slowest << " steps");
}

TEST_CASE(
    "recovery: positions are continuous, constrained nodes follow their motion, then the explicit method resumes") {
  WorldSetup setup = starting_at(cube("neo_hookean", 0.45), scattered(3));
  setup.boundary[0].translate = Vec3(0, 0.02, 0);
  setup.boundary[0].ramp_time = 0.1;
  setup.solver.integrator = Integrator::verlet;
  setup.solver.step.reset();
  setup.solver.rate = 1000;
  setup.solver.damping = 20;
  const auto world = make_world(setup);
  auto before = world->positions();
  double largest = 0;
  for (int tick = 1; tick <= 400; ++tick) {
    world->tick();
    REQUIRE_FALSE(world->halt());
    CHECK(world->time() == doctest::Approx(1e-3 * tick));
    const auto now = world->positions();
    for (std::size_t n = 0; n < now.size(); ++n) largest = std::max(largest, (now[n] - before[n]).norm());
    for (const int n : setup.boundary[0].nodes) {
      const Vec3 target = setup.mesh.nodes[n] + std::min(1.0, tick / 100.0) * setup.boundary[0].translate;
      CHECK((now[n] - target).norm() <= 1e-12);
    }
    before = now;
  }
  CHECK(largest <= 0.3 * side);
  REQUIRE(world->recovery()->ended);
  CHECK(world->recoveries() == 1);
  CHECK(away_from_rest(world->positions(), setup.mesh.nodes) <= 1e-3);
}

TEST_CASE("recovery: energies either side of each switch are those of the state there") {
  const auto world = make_world(starting_at(cube("neo_hookean", 0.45), mirrored));
  const Recovery& recovery = *world->recovery();
  CHECK(std::isnan(recovery.begun.before.elastic));  // ln J
  CHECK(recovery.begun.after.elastic == world->energies().elastic);
  CHECK(recovery.begun.after.elastic > 0);
  CHECK_FALSE(recovery.ended);
  CHECK(recovery.inverted > 0);
  CHECK(recovery.min_J == doctest::Approx(-1));
  CHECK(recovery.message.find("the body starts so") != std::string::npos);
  double before = total(world->energies());
  while (!world->recovery()->ended) {
    world->tick();
    REQUIRE(world->ticks() < 60);
    const Recovery& now = *world->recovery();
    const double surrogate = now.ended ? total(now.ended->before) : total(world->energies());
    CHECK(surrogate <= before * (1 + 1e-9));  // the stand-in never gains
    before = surrogate;
  }
  CHECK(world->recovery()->ended->time == world->time());
  CHECK(total(world->recovery()->ended->after) == total(world->energies()));
}

TEST_CASE("recovery: of every law, what its material remembers goes back with the last good state") {
  for (const LawInfo& law : laws()) {
    if (!law.is_continuum || law.name.starts_with("paper_")) continue;
    CAPTURE(std::string(law.name));
    bool single = false, cut = false;  // in turn
    for (const Material& material : with_internal_state(sample_material(law.name)))
      for (const Integrator integrator : {Integrator::verlet, Integrator::backward_euler}) {
        single = integrator == Integrator::verlet ? !single : single;
        cut = single ? !cut : cut;
        CAPTURE(single);
        CAPTURE(cut);
        CAPTURE(integrator_name(integrator));
        CAPTURE(material.viscosity);
        CAPTURE(material.relaxation.size());
        CAPTURE(material.plasticity.has_value());
        WorldSetup setup = bar(material, integrator, single);
        setup.tables.clear();
        setup.solver.recovery = true;
        const auto world = make_world(setup);
        for (int tick = 0; tick < 6; ++tick) world->tick();
        if (cut) REQUIRE(world->apply(blade_at(0.034)).ok());
        REQUIRE(world->recoveries() == 0);
        Energies good = world->energies();
        for (double g = 1e5; g < 1e14 && world->recoveries() == 0; g *= 4) {  // until it is more than the law bears
          REQUIRE(world->apply(SetGravity{Vec3(0, -g, 0)}).ok());
          good = world->energies();
          world->tick();
          REQUIRE_FALSE(world->halt());
        }
        REQUIRE(world->recoveries() == 1);
        CHECK(world->recovery()->begun.before.elastic == good.elastic);
        CHECK(world->recovery()->begun.before.kinetic == good.kinetic);
      }
  }
}

TEST_CASE("recovery: off, and on where nothing is wrong, are the same bits, and off stops where the law ends") {
  WorldSetup setup = cantilever();
  setup.solver.duration = 0.05;
  const auto off = make_world(setup);
  setup.solver.recovery = true;
  const auto on = make_world(setup);
  run_until(*off, 0.05);
  run_until(*on, 0.05);
  CHECK(on->state_hash() == off->state_hash());
  CHECK(on->recoveries() == 0);
  CHECK_FALSE(on->recovery());

  WorldSetup collapsed = starting_at(cube("neo_hookean", 0.3), to_plane);
  collapsed.solver.recovery = false;
  const auto stopped = make_world(collapsed);
  REQUIRE(stopped->halt());
  CHECK(stopped->halt()->cause == StopReason::Cause::out_of_range);
}

TEST_CASE("recovery: the same bits on every run, with any number of threads") {
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2, 1}) {
    WorldSetup setup = starting_at(cube("mooney_rivlin", 0.49), scattered(5));
    setup.solver.threads = threads;
    const auto world = make_world(setup);
    for (int k = 0; k < 20; ++k) world->tick();
    hashes.push_back(world->state_hash());
  }
  CHECK(hashes[0] == hashes[1]);
  CHECK(hashes[0] == hashes[2]);
}

TEST_CASE("recovery: quadratic elements give the same bits with any number of threads, and from a snapshot within it") {
  for (const bool pressure : {false, true}) {
    WorldSetup setup = starting_at(cube_of(true, pressure, Integrator::backward_euler), scattered(5));
    const auto one = make_world(setup);
    setup.solver.threads = 3;
    const auto three = make_world(setup);
    for (const auto& world : {one.get(), three.get()})
      for (int k = 0; k < 6; ++k) world->tick();
    REQUIRE_FALSE(one->recovery()->ended);
    CHECK(one->state_hash() == three->state_hash());
    const auto kept = one->snapshot();
    for (int k = 0; k < 40; ++k) one->tick(), three->tick();
    CHECK(one->recovery()->ended);
    CHECK(one->state_hash() == three->state_hash());
    REQUIRE(one->restore(*kept).ok());
    for (int k = 0; k < 40; ++k) one->tick();
    CHECK(one->state_hash() == three->state_hash());
  }
}

TEST_CASE("recovery: a body thrown against its support is whole again afterwards") {
  for (const bool continuation : {false, true}) {
    CAPTURE(continuation);
    WorldSetup setup = cantilever("neo_hookean", 1e4);
    setup.gravity.setZero();
    setup.initial_velocity = Vec3(-10, 0, 0);
    setup.solver.damping = 20;
    setup.solver.continuation = continuation;
    const auto halted = make_world(setup);
    run_until(*halted, 0.05);
    CHECK(halted->halt());
    setup.solver.recovery = true;
    const auto world = make_world(setup);
    run_until(*world, 1);
    REQUIRE_FALSE(world->halt());
    REQUIRE(world->recovery());
    CHECK(world->recovery()->element >= 0);
    CHECK(world->recovery()->message.find("element " + std::to_string(world->recovery()->element)) == 0);
    MESSAGE(world->recoveries() << ": " << world->recovery()->message);
    REQUIRE(world->recovery()->ended);
    CHECK(inverted(*world) == 0);
    CHECK(rms_difference(world->positions(), setup.mesh.nodes) <= 1e-3 * 0.1);
  }
}

TEST_CASE("recovery: a tick is never waited for that takes over a thousand times its steps at rest") {
  for (const char* law : {"neo_hookean_iso", "mooney_rivlin"})
    for (const double gravity : {3e3, 1e4, 1e5}) {
      CAPTURE(law);
      CAPTURE(gravity);
      WorldSetup setup;
      setup.mesh = make_box(Vec3(0.1, 0.1, 0.1), {2, 2, 2});
      setup.materials = {{std::nullopt, sample_material(law)}};
      setup.gravity = Vec3(0, -gravity, 0);
      setup.tables = {{Vec3(0, -0.001, 0), Vec3(0, 1, 0)}};  // the block is crushed flat on it
      setup.solver.rate = 100;
      setup.solver.recovery = true;
      const auto world = make_world(setup);
      const double at_rest = std::ceil(setup.solver.tick() / world->stable_step());
      for (int tick = 0; tick < 3; ++tick) {
        const long before = world->steps();
        world->tick();
        REQUIRE_FALSE(world->halt());
        CHECK(static_cast<double>(world->steps() - before) <= 1025 * at_rest);
      }
    }
}

TEST_CASE("recovery: the likely cause is the surest that fits, with its remedy") {
  FailureDiagnosis s;
  s.element = 7;
  s.min_J = -0.3;
  s.inverted = 4;
  s.wave_speed = 2;
  const auto says = [&](const char* part) { return describe_cause(s).find(part) != std::string::npos; };
  CHECK(says("element 7 was flat or inside out"));
  CHECK(says("with 4 in all inverted"));
  CHECK(says("loads or moved supports"));
  s.min_J = 4;
  s.shortened = 2500;
  CHECK(says("element 7 was so stretched or crushed"));
  CHECK(says("2500 times shorter than at rest"));
  s.loaded = false;
  CHECK(says("no load acts"));
  s.loaded = true;
  s.pulled = true;
  CHECK(says("the tool pulls or presses"));
  s.stiffness_ratio = 500;
  CHECK(says("its volume resists 500 times as much as its shape"));
  s.thinness = 0.01;
  CHECK(says("sliver"));
  s.burn_shrink = 0.2;
  CHECK(says("burnt tissue there has shrunk by 20 % of its length"));
  s.tool_speed = 3;
  CHECK(says("the tool moves at 3 m/s and waves in this tissue at 2 m/s"));
  s.step = 2e-3, s.limit = 1e-3;
  CHECK(says("the step of 0.002 s is longer than the 0.001 s"));
  s.from_start = true;
  CHECK(says("the body starts so"));
}

TEST_CASE("recovery: a step too long for the body even at rest still stops as unstable") {
  WorldSetup setup = cantilever();
  setup.solver.recovery = true;
  setup.solver.step = 0.01;
  const auto world = make_world(setup);
  run_until(*world, 1);
  REQUIRE(world->halt());
}

TEST_CASE("recovery: material, grasp and reset are taken while it goes on") {
  const auto world = make_world(starting_at(cube("neo_hookean", 0.3), scattered(6)));
  world->tick();
  REQUIRE_FALSE(world->recovery()->ended);
  CHECK(world->apply(SetMaterial{std::nullopt, with_moduli("ogden", 8e3, 1e6)}).ok());
  CHECK(world->apply(Grasp{26, 0.01}).ok());
  CHECK(world->apply(Release{}).ok());
  world->tick();
  CHECK(world->apply(Reset{}).ok());
  CHECK(world->time() == 0);
  CHECK(world->recoveries() == 1);  // it starts scattered again
  CHECK(steps_to_rest(*world) > 0);
}

}  // namespace heml::recovery_test
