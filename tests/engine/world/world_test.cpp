#include <doctest/doctest.h>

#include <cmath>
#include <heml/base/error.hpp>

#include "support.hpp"
#include "world_support.hpp"

namespace heml::world_test {

using namespace heml::test;

namespace {

/// State of the falling cantilever at 0.1 s with a given step.
std::vector<Vec3> fallen(Integrator integrator, double step, bool velocities = false) {
  WorldSetup setup = cantilever();
  setup.solver.integrator = integrator;
  setup.solver.step = step;
  setup.solver.damping = 2;
  const auto world = make_world(setup);
  run_until(*world, 0.1);
  REQUIRE_FALSE(world->halt());
  return velocities ? world->velocities() : world->positions();
}

}  // namespace

TEST_CASE("a cantilever converges at the order of each integrator") {
  for (const bool velocities : {false, true}) {
    // Its own much finer run by the other method: what both converge to.
    const auto reference = fallen(Integrator::verlet, 1e-5, velocities);
    for (const auto& [integrator, order] : {std::pair{Integrator::symplectic_euler, 1.0}, {Integrator::verlet, 2.0}}) {
      std::vector<double> error;
      for (const double step : {4e-4, 2e-4, 1e-4})
        error.push_back(rms_difference(fallen(integrator, step, velocities), reference));
      CHECK(std::log2(error[0] / error[1]) == doctest::Approx(order).epsilon(0.1));
      CHECK(std::log2(error[1] / error[2]) == doctest::Approx(order).epsilon(0.1));
    }
  }
}

TEST_CASE("uniaxial stretch of one and of many tetrahedra gives the reaction of the closed form") {
  const double young = 1e4, poisson = 0.3, t = 1.4;
  const LameParameters lame = lame_parameters(young, poisson);
  // Lateral stretch of a free bar: mu (s² − 1) + lambda ln(t s²) = 0; P11 = (mu (t² − 1) + lambda ln J)/t.
  double s = 0.9;
  for (int i = 0; i < 100; ++i)
    s -= (lame.mu * (s * s - 1) + lame.lambda * std::log(t * s * s)) / (2 * lame.mu * s + 2 * lame.lambda / s);
  const double P11 = (lame.mu * (t * t - 1) + lame.lambda * std::log(t * s * s)) / t;

  TetMesh one;
  one.nodes = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}};
  one.tets = {{0, 1, 2, 3}};
  one.regions = {0};
  const double area_one = 0.1 * 0.1 / 2;  // P11 V g of the far node: P11 · ½ · 0.1²/3 · ... summed over the face below
  for (const bool many : {false, true}) {
    WorldSetup setup;
    setup.mesh = many ? make_box(Vec3(0.1, 0.1, 0.1), {3, 3, 3}) : one;
    setup.materials = {{std::nullopt, soft("neo_hookean", young, poisson)}};
    // Every node of the far side in one entry, the others node by node held where the homogeneous stretch puts them.
    std::vector<int> far = nodes_where(setup.mesh, [](const Vec3& X) { return X.x() > 0.0999; });
    for (std::size_t n = 0; n < setup.mesh.nodes.size(); ++n) {
      const Vec3& X = setup.mesh.nodes[n];
      Boundary entry{{static_cast<int>(n)}};
      entry.translate = Vec3((t - 1) * X.x(), (s - 1) * X.y(), (s - 1) * X.z());
      setup.boundary.push_back(entry);
    }
    const auto world = make_world(setup);
    const auto reactions = world->reactions();
    Vec3 force = Vec3::Zero();
    for (const int n : far) force += reactions[static_cast<std::size_t>(n)];
    // The far corner of the single tetrahedron carries V P g with g = (10, 0, 0): P11 · 0.1²/6.
    const double expected = many ? P11 * 0.01 : P11 * area_one / 3;
    CHECK(force.x() == doctest::Approx(expected).epsilon(1e-12));
    CHECK(std::abs(force.y()) + std::abs(force.z()) <= 1e-10 * expected);
  }
}

TEST_CASE("patch test: interior nodes of an irregular mesh settle on the homogeneous stretch of its surface") {
  std::mt19937_64 random(21);
  WorldSetup setup;
  setup.mesh = make_box(Vec3(0.1, 0.1, 0.1), {4, 4, 4});
  setup.materials = {{std::nullopt, soft()}};
  const auto inside = [](const Vec3& X) { return X.minCoeff() > 1e-6 && X.maxCoeff() < 0.1 - 1e-6; };
  for (Vec3& X : setup.mesh.nodes)
    if (inside(X)) X += random_vector(random, 0.003);
  const Vec3 stretch(1.2, 0.9, 1.05);
  for (std::size_t n = 0; n < setup.mesh.nodes.size(); ++n)
    if (!inside(setup.mesh.nodes[n]))
      setup.boundary.push_back({{static_cast<int>(n)}, (stretch - Vec3::Ones()).cwiseProduct(setup.mesh.nodes[n])});
  setup.solver.damping = 60;
  const auto world = make_world(setup);
  run_until(*world, 1.5);
  const auto x = world->positions();
  for (std::size_t n = 0; n < x.size(); ++n)
    CHECK((x[n] - stretch.cwiseProduct(setup.mesh.nodes[n])).norm() <= 1e-10 * 0.1);
}

TEST_CASE("a free body keeps momentum and angular momentum to round-off") {
  WorldSetup setup = cantilever();
  setup.boundary.clear();
  setup.gravity.setZero();
  setup.initial_velocity = Vec3(0.3, -0.2, 0.1);
  std::mt19937_64 random(22);
  const Mat3 spin_and_bend = random_gradient(random, 0.8, 1.3);
  for (const Vec3& X : setup.mesh.nodes) setup.initial_positions.push_back(spin_and_bend * X);
  for (const Integrator integrator : explicit_integrators()) {
    setup.solver.integrator = integrator;
    const auto world = make_world(setup);
    // Nodal masses, from the mesh itself.
    std::vector<double> mass(setup.mesh.nodes.size(), 0.0);
    for (const Tet& t : setup.mesh.tets)
      for (const int n : t) {
        const auto X = [&](std::size_t c) { return setup.mesh.nodes[static_cast<std::size_t>(t[c])]; };
        mass[static_cast<std::size_t>(n)] += 1000 * signed_volume(X(0), X(1), X(2), X(3)) / 4;
      }
    const auto momenta = [&] {
      Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
      const auto x = world->positions(), v = world->velocities();
      for (std::size_t n = 0; n < x.size(); ++n) {
        linear += mass[n] * v[n];
        angular += mass[n] * x[n].cross(v[n]);
      }
      return std::pair(linear, angular);
    };
    const auto before = momenta();
    run_until(*world, 0.5);
    const auto after = momenta();
    CHECK((after.first - before.first).norm() <= 1e-12 * before.first.norm());
    CHECK((after.second - before.second).norm() <= 1e-11 * before.first.norm() * 0.1);
  }
}

TEST_CASE("a step that is too long is reported as unstable and the last valid state kept") {
  WorldSetup setup = cantilever("stvk", 1e6);
  setup.solver.step = 1e-3;
  const auto world = make_world(setup);
  for (int k = 0; k < 2000 && !world->halt(); ++k) world->tick();
  REQUIRE(world->halt());
  CHECK(world->halt()->cause == StopReason::Cause::unstable);
  CHECK(world->halt()->node >= 0);
  for (const Vec3& x : world->positions()) CHECK(x.allFinite());
  const auto hash = world->state_hash();
  world->tick();
  CHECK(world->state_hash() == hash);
  CHECK(world->apply(Reset{}).ok());
  CHECK_FALSE(world->halt());
  CHECK(world->time() == 0);
}

TEST_CASE("leaving the range of a law stops at the last valid state and names the element, continued, it goes on") {
  WorldSetup setup = cantilever();
  setup.gravity.setZero();
  // The far end pushed through the held one.
  Boundary crush{nodes_where(setup.mesh, [](const Vec3& X) { return X.x() > 0.0999; })};
  crush.translate = Vec3(-0.15, 0, 0);
  crush.ramp_time = 0.1;
  setup.boundary.push_back(crush);
  const auto world = make_world(setup);
  run_until(*world, 0.2);
  REQUIRE(world->halt());
  CHECK(world->halt()->cause == StopReason::Cause::out_of_range);
  CHECK(world->halt()->element >= 0);
  CHECK(world->time() < 0.1);
  for (const double J : world->volume_ratios()) CHECK(J > 0);
  setup.solver.continuation = true;
  setup.solver.damping = 50;
  const auto continued = make_world(setup);
  run_until(*continued, 0.2);
  CHECK_FALSE(continued->halt());
  CHECK(continued->time() == doctest::Approx(0.2));
}

TEST_CASE("however fast a continued body is crushed, explicit steps that follow its limit do not feed its swing") {
  struct Crushing {
    double ramp_time, displacement;  // s, m
    int fine;
  };
  constexpr Crushing crushings[] = {{0.06, 0.15, 2}, {0.11, 0.14, 2}, {0.16, 0.16, 2}, {0.2, 0.15, 2},
                                    {0.05, 0.18, 2}, {0.05, 0.15, 1}, {0.05, 0.18, 1}, {0.102, 0.149, 1}};
  for (const Crushing& crushing : crushings) {
    CAPTURE(crushing.ramp_time);
    CAPTURE(crushing.displacement);
    WorldSetup setup = cantilever();
    setup.mesh = make_box(Vec3(0.1, 0.02, 0.02), {10 * crushing.fine, 2 * crushing.fine, 2 * crushing.fine});
    setup.gravity.setZero();
    setup.boundary = {{nodes_where(setup.mesh, [](const Vec3& X) { return X.x() < 1e-9; })}};
    Boundary crush{nodes_where(setup.mesh, [](const Vec3& X) { return X.x() > 0.0999; })};
    crush.translate = Vec3(-crushing.displacement, 0, 0);
    crush.ramp_time = crushing.ramp_time;
    setup.boundary.push_back(crush);
    setup.solver.continuation = true;
    setup.solver.damping = 50;
    const auto world = make_world(setup);
    run_until(*world, 0.2);
    CHECK_FALSE(world->halt());
  }
}

TEST_CASE("results are the same bits on every run, with any number of threads, in double and float") {
  for (const bool single : {false, true}) {
    std::vector<std::uint64_t> hashes;
    for (const int threads : {1, 2, 3, 16, 1}) {
      WorldSetup setup = cantilever();
      setup.mesh = make_box(Vec3(0.1, 0.05, 0.05), {20, 12, 12});
      setup.boundary[0].nodes = nodes_where(setup.mesh, [](const Vec3& X) { return X.x() < 1e-9; });
      setup.solver.threads = threads;
      setup.solver.single_precision = single;
      const auto world = make_world(setup);
      CHECK(world->apply(Grasp{2000, 0.02}).ok());
      CHECK(world->apply(MoveTool{Vec3(0.12, 0.03, 0.03)}).ok());
      run_until(*world, 0.02);
      hashes.push_back(world->state_hash());
    }
    for (const auto hash : hashes) CHECK(hash == hashes.front());
  }
}

TEST_CASE("results come back in the order of the mesh, whatever that order is") {
  WorldSetup setup = cantilever();
  const auto plain = make_world(setup);
  run_until(*plain, 0.05);
  // The same body with its nodes numbered backwards.
  WorldSetup backwards = setup;
  const int last = static_cast<int>(setup.mesh.nodes.size()) - 1;
  std::reverse(backwards.mesh.nodes.begin(), backwards.mesh.nodes.end());
  for (Tet& tet : backwards.mesh.tets)
    for (int& n : tet) n = last - n;
  for (int& n : backwards.boundary[0].nodes) n = last - n;
  const auto other = make_world(backwards);
  run_until(*other, 0.05);
  const auto a = plain->positions(), b = other->positions();
  for (std::size_t n = 0; n < a.size(); ++n) CHECK((a[n] - b[a.size() - 1 - n]).norm() <= 1e-12);
}

TEST_CASE("a tick cut in two ends where it would have, and lands on the time asked for") {
  WorldSetup setup = cantilever();
  setup.solver.step = 1e-4;
  const auto world = make_world(setup);
  for (int k = 0; k < 10; ++k) world->tick();
  world->advance_within_tick(0.00103);
  CHECK(world->time() == 0.00103);
  world->tick();
  CHECK(world->time() == 11 * 1e-4);
  CHECK(world->ticks() == 11);
}

TEST_CASE("loads in all add up to what was asked, and reactions to all that is carried") {
  WorldSetup setup = cantilever();
  const auto tip = nodes_where(setup.mesh, [](const Vec3& X) { return X.x() > 0.0999; });
  Load force;
  force.nodes = tip;
  force.vector = Vec3(0.001, 0.002, -0.003);
  Load traction;
  traction.kind = Load::Kind::traction;
  traction.nodes = tip;
  traction.vector = Vec3(5, -20, 0);
  Load pressure;
  pressure.kind = Load::Kind::pressure;
  pressure.nodes = tip;
  pressure.pressure = 10;
  setup.loads = {force, traction, pressure};
  const auto world = make_world(setup);
  // At rest, at t = 0: what the held nodes carry themselves is their own weight; the rest accelerates.
  setup.boundary[0].nodes = nodes_where(setup.mesh, [](const Vec3&) { return true; });
  const auto held = make_world(setup);
  const double weight = 1000 * 0.1 * 0.02 * 0.02 * 9.81, area = 0.02 * 0.02;
  const Vec3 expected =
      -(Vec3(0.001, 0.002, -0.003) + area * Vec3(5, -20, 0) + area * 10 * Vec3(-1, 0, 0)) + Vec3(0, weight, 0);
  CHECK((held->reactions()[0] - expected).norm() <= 1e-14);
}

TEST_CASE("pressure follows the surface as it turns") {
  WorldSetup setup = cantilever();
  setup.gravity.setZero();
  const auto everything = nodes_where(setup.mesh, [](const Vec3&) { return true; });
  setup.boundary[0].nodes = everything;
  setup.boundary[0].axis = Vec3(0, 0, 1);
  setup.boundary[0].degrees = 90;
  Load pressure;
  pressure.kind = Load::Kind::pressure;
  pressure.nodes = nodes_where(setup.mesh, [](const Vec3& X) { return X.x() > 0.0999; });
  pressure.pressure = 100;
  setup.loads = {pressure};
  // The end that looked along x now looks along y; pushed inward, the support pushes back along +y.
  CHECK((make_world(setup)->reactions()[0] - Vec3(0, 100 * 4e-4, 0)).norm() <= 1e-12);
}

TEST_CASE("switching the law under load keeps positions and velocities and changes what follows") {
  WorldSetup setup = cantilever();
  const auto switched = make_world(setup), kept = make_world(setup);
  run_until(*switched, 0.05);
  run_until(*kept, 0.05);
  const auto hash = switched->state_hash();
  CHECK(switched->apply(SetMaterial{std::nullopt, soft("stvk", 3e4)}).ok());
  CHECK(switched->state_hash() == hash);
  CHECK(switched->setup().materials[0].material.law == "stvk");
  CHECK(switched->stable_step() < kept->stable_step());
  run_until(*switched, 0.06);
  run_until(*kept, 0.06);
  CHECK(switched->state_hash() != kept->state_hash());
  CHECK_FALSE(switched->halt());
}

TEST_CASE("commands that make no sense are refused in words and change nothing") {
  const auto world = make_world(cantilever());
  const auto hash = world->state_hash();
  CHECK(world->apply(Grasp{-1, 0.01}).message().find("node -1") != std::string::npos);
  CHECK_FALSE(world->apply(Grasp{100000, 0.01}).ok());
  CHECK(world->apply(Grasp{0, 0}).message().find("constrained") != std::string::npos);
  CHECK_FALSE(world->apply(Grasp{50, NAN}).ok());
  CHECK_FALSE(world->apply(MoveTool{Vec3(0, 0, 0)}).ok());
  CHECK_FALSE(world->apply(SetDamping{-1}).ok());
  CHECK_FALSE(world->apply(SetGravity{Vec3(0, NAN, 0)}).ok());
  CHECK(world->apply(SetMaterial{7, soft()}).message().find("region 7") != std::string::npos);
  CHECK_FALSE(world->apply(SetMaterial{std::nullopt, Material{"stvk", {1e4, -1}, 1000}}).ok());
  CHECK(world->state_hash() == hash);
}

TEST_CASE("regions need a material each, and one entry only") {
  WorldSetup setup = cantilever();
  setup.mesh.regions.assign(setup.mesh.tets.size(), 3);
  setup.materials = {{2, soft()}};
  CHECK_THROWS_AS(make_world(setup), InputError);
  setup.materials = {{3, soft()}, {3, soft()}};
  CHECK_THROWS_AS(make_world(setup), InputError);
  setup.materials = {{std::nullopt, soft()}};
  CHECK_NOTHROW(make_world(setup));
}

}  // namespace heml::world_test
