// Threads: never longer than they are, and what hangs on one pulls with its weight.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "world_support.hpp"

namespace heml::suture_test {

using namespace heml::test;

namespace {

constexpr double side = 0.02, gap = 0.03;

/// A cube that is held at its top, and 3 cm below it one that nothing holds; a node of each.
struct Hanging {
  WorldSetup setup;
  int upper = 0, lower = 0;

  explicit Hanging(Integrator integrator) {
    setup.mesh = make_box(Vec3(side, side, side), {2, 2, 2});
    const auto count = static_cast<int>(setup.mesh.nodes.size());
    const TetMesh one = setup.mesh;
    for (const Vec3& X : one.nodes) setup.mesh.nodes.push_back(X - Vec3(0, side + gap, 0));
    for (const Tet& tet : one.tets)
      setup.mesh.tets.push_back({tet[0] + count, tet[1] + count, tet[2] + count, tet[3] + count});
    setup.mesh.regions.insert(setup.mesh.regions.end(), one.regions.begin(), one.regions.end());
    setup.materials = {{std::nullopt, soft("neo_hookean", 5e4)}};
    setup.boundary.push_back({nodes_where(setup.mesh, [](const Vec3& X) { return X.y() > side - 1e-9; })});
    setup.gravity = Vec3(0, -9.81, 0);
    setup.solver.integrator = integrator;
    setup.solver.threads = 1;
    setup.solver.damping = 30;
    if (!is_explicit(integrator)) setup.solver.step = 0.005;
    const auto at = [&](const Vec3& place) {
      return nodes_where(setup.mesh, [&](const Vec3& X) { return (X - place).norm() < 1e-9; }).front();
    };
    upper = at(Vec3(side / 2, 0, side / 2));
    lower = at(Vec3(side / 2, -gap, side / 2));
  }
};

}  // namespace

TEST_CASE("suture: a thread bears the weight of what hangs on it, and is as long as it was drawn in to") {
  const double weight = side * side * side * 1000 * 9.81;
  for (const auto integrator : {Integrator::verlet, Integrator::backward_euler}) {
    CAPTURE(integrator_name(integrator));
    Hanging hanging(integrator);
    auto world = make_world(hanging.setup);
    REQUIRE(world->apply(SutureTissue{{hanging.upper, hanging.lower}, 0.01, 0.2}).ok());
    run_until(*world, 0.8);
    REQUIRE_FALSE(world->halt());
    const SutureState suture = tools_of<SutureState>(world->tools()).front();
    CHECK((suture.force - Vec3(0, -weight, 0)).norm() <= 0.01 * weight);
    CHECK((suture.ends[0] - suture.ends[1]).norm() == doctest::Approx(0.01).epsilon(2e-3));
    REQUIRE(world->apply(CutSutures{}).ok());
    CHECK(tools_of<SutureState>(world->tools()).empty());
    run_until(*world, 1);
    CHECK(world->positions()[static_cast<std::size_t>(hanging.lower)].y() < -0.05);
  }
}

TEST_CASE("suture: fully drawn, it joins two parts and keeps the body's momentum") {
  WorldSetup setup = cantilever();
  setup.boundary.clear();
  setup.gravity.setZero();
  auto world = make_world(setup);
  const auto at = [&](const Vec3& place) {
    return nodes_where(setup.mesh, [&](const Vec3& X) { return (X - place).norm() < 1e-9; }).front();
  };
  const int a = at(Vec3(0.03, 0.02, 0.01)), b = at(Vec3(0.06, 0.02, 0.01));
  REQUIRE(world->apply(SutureTissue{{a, b}, 0, 0.1}).ok());
  run_until(*world, 0.12);
  REQUIRE_FALSE(world->halt());
  const auto x = world->positions();
  CHECK((x[static_cast<std::size_t>(a)] - x[static_cast<std::size_t>(b)]).norm() <= 2e-4 * 0.104);
  Vec3 momentum = Vec3::Zero();
  double speeds = 0;
  const TetMesh& mesh = world->setup().mesh;
  const auto v = world->velocities();
  for (const Tet& tet : mesh.tets) {
    const auto X = [&](std::size_t c) { return mesh.nodes[static_cast<std::size_t>(tet[c])]; };
    const double mass = 1000 * signed_volume(X(0), X(1), X(2), X(3)) / 4;
    for (const int n : tet) {
      momentum += mass * v[static_cast<std::size_t>(n)];
      speeds += mass * v[static_cast<std::size_t>(n)].norm();
    }
  }
  CHECK(momentum.norm() <= 1e-10 * speeds);
}

TEST_CASE("suture: a wrong suture is refused") {
  Hanging hanging(Integrator::verlet);
  auto world = make_world(hanging.setup);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const int u = hanging.upper, l = hanging.lower;
  for (const SutureTissue& wrong :
       {SutureTissue{{u, u}, 0, 1}, SutureTissue{{-1, l}, 0, 1}, SutureTissue{{u, 1 << 20}, 0, 1},
        SutureTissue{{u, l}, -1, 1}, SutureTissue{{u, l}, nan, 1}, SutureTissue{{u, l}, 0, -1},
        SutureTissue{{u, l}, 0, nan}})
    CHECK_FALSE(world->apply(wrong).ok());
  CHECK(tools_of<SutureState>(world->tools()).empty());
}

}  // namespace heml::suture_test
