// A probe pushed against tissue: it does not tunnel, what it feels is what theory says, and momentum is kept.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <heml/mesh/surface.hpp>
#include <limits>
#include <numbers>

#include "world_support.hpp"

namespace heml::probe_test {

using namespace heml::test;

namespace {

MoveProbe ball(double radius, std::vector<Vec3> path, double speed = 1, double friction = 0) {
  MoveProbe probe;
  probe.radius = radius;
  probe.path = std::move(path);
  probe.speed = speed;
  probe.friction = friction;
  return probe;
}

/// A sheet 0.1 × 0.1 m, 4 mm thick, in cells of 1 cm, held all round; its top is y = 0.
WorldSetup sheet(Integrator integrator) {
  WorldSetup setup;
  setup.mesh = make_box(Vec3(0.1, 0.004, 0.1), {10, 1, 10}, Vec3(-0.05, -0.004, -0.05));
  setup.materials = {{std::nullopt, soft("neo_hookean", 1e4)}};
  setup.boundary.push_back({nodes_where(
      setup.mesh, [](const Vec3& X) { return std::max(std::abs(X.x()), std::abs(X.z())) > 0.05 - 1e-9; })});
  setup.solver.integrator = integrator;
  setup.solver.damping = 10;
  setup.solver.threads = 1;
  if (!is_explicit(integrator)) setup.solver.step = 1.0 / 60;
  return setup;
}

/// Height of the sheet's top, as it is now, above or below a place.
double height_of_top(const World& world, const Vec3& place) {
  const TetMesh& mesh = world.setup().mesh;
  const auto x = world.positions();
  for (const Triangle& face : extract_boundary(mesh).triangles) {
    const auto is_top = [&](int n) { return mesh.nodes[static_cast<std::size_t>(n)].y() > -1e-9; };
    if (!std::all_of(face.begin(), face.end(), is_top)) continue;
    const auto at = [&](std::size_t c) { return x[static_cast<std::size_t>(face[c])]; };
    const auto area = [](const Vec3& a, const Vec3& b, const Vec3& c) {
      return (b - a).z() * (c - a).x() - (b - a).x() * (c - a).z();
    };
    const double all = area(at(0), at(1), at(2)), w0 = area(place, at(1), at(2)) / all,
                 w1 = area(at(0), place, at(2)) / all, w2 = 1 - w0 - w1;
    if (w0 >= 0 && w1 >= 0 && w2 >= 0) return w0 * at(0).y() + w1 * at(1).y() + w2 * at(2).y();
  }
  return std::numeric_limits<double>::infinity();
}

/// Force on a ball pressed into a layer that is bonded to its ground: E. K. Dimitriadis et al., Biophysical Journal 82,
/// 2002, equation 11; Hertz's where the layer is thick.
double pressed_in(double young, double poisson, double radius, double depth, double thickness) {
  const double nu = poisson, pi = std::numbers::pi;
  const double a = -(1.2876 - 1.4678 * nu + 1.3442 * nu * nu) / (1 - nu);
  const double b = (0.6387 - 1.0277 * nu + 1.5164 * nu * nu) / (1 - nu);
  const double x = std::sqrt(radius * depth) / thickness;
  const double layer = 1 - 2 * a / pi * x + 4 * a * a / (pi * pi) * x * x -
                       8 / std::pow(pi, 3) * (a * a * a + 4 * pi * pi / 15 * b) * x * x * x +
                       16 * a / std::pow(pi, 4) * (a * a * a + 3 * pi * pi / 5 * b) * x * x * x * x;
  return 4.0 / 3 * young / (1 - nu * nu) * std::sqrt(radius) * std::pow(depth, 1.5) * layer;
}

double felt(int cells) {
  constexpr double width = 0.12, height = 0.06, radius = 0.05, depth = 0.004;
  WorldSetup setup;
  setup.mesh =
      make_box(Vec3(width, height, width), {2 * cells, cells, 2 * cells}, Vec3(-width / 2, -height, -width / 2));
  setup.materials = {{std::nullopt, soft("neo_hookean", 1e4, 0.3)}};
  setup.boundary.push_back({nodes_where(setup.mesh, [](const Vec3& X) { return X.y() < -height + 1e-9; })});
  setup.solver.integrator = Integrator::static_equilibrium;
  setup.solver.tolerance = 1e-6;
  auto world = make_world(setup);
  REQUIRE(world->apply(ball(radius, {Vec3(0, radius, 0), Vec3(0, radius - depth, 0)}, depth)).ok());
  world->load_to(1);
  REQUIRE_FALSE(world->halt());
  CHECK(tool_of<ProbeState>(*world).max_penetration <= 2e-5);
  return -tool_of<ProbeState>(*world).force.y() / pressed_in(1e4, 0.3, radius, depth, height);
}

}  // namespace

TEST_CASE("probe: at 1 m/s it does not pass through a thin sheet, though it is smaller than its faces") {
  for (const auto integrator : {Integrator::symplectic_euler, Integrator::verlet, Integrator::backward_euler}) {
    CAPTURE(integrator_name(integrator));
    auto world = make_world(sheet(integrator));
    REQUIRE(world->apply(ball(0.003, {Vec3(0.004, 0.02, 0.005), Vec3(0.004, -0.03, 0.005)})).ok());
    for (int k = 0; world->time() < 0.08; ++k) {
      world->tick();
      REQUIRE_FALSE(world->halt());
      const double top = height_of_top(*world, tool_of<ProbeState>(*world).tip);
      CHECK(top <= tool_of<ProbeState>(*world).tip.y() - 0.003 + 2e-5);
    }
    CHECK(tool_of<ProbeState>(*world).tip.y() == doctest::Approx(-0.03));
    CHECK(tool_of<ProbeState>(*world).force.y() < -1e-3);
    CHECK(tool_of<ProbeState>(*world).contact_count > 0);
    CHECK(tool_of<ProbeState>(*world).max_penetration <= 1e-4);
  }
}

TEST_CASE("probe: a capsule's shaft holds tissue off as its tip does") {
  auto world = make_world(sheet(Integrator::verlet));
  MoveProbe probe = ball(0.004, {Vec3(-0.03, 0.01, 0), Vec3(-0.03, -0.015, 0)}, 0.5);
  probe.shaft = Vec3(0.06, 0, 0);
  REQUIRE(world->apply(probe).ok());
  run_until(*world, 0.2);
  double highest = -1;
  const auto x = world->positions();
  for (std::size_t n = 0; n < x.size(); ++n) {
    const Vec3& X = world->setup().mesh.nodes[n];
    if (std::abs(X.x()) < 0.025 && std::abs(X.z()) < 1e-9) highest = std::max(highest, x[n].y());
  }
  CHECK(highest <= -0.015 - 0.0035);
}

TEST_CASE("probe: a ball pressed into a block feels what theory says, the nearer the finer the mesh") {
  const double coarse = felt(3), fine = felt(5);
  CHECK(fine > 1);  // linear elements are too stiff
  CHECK(fine - 1 < 0.75 * (coarse - 1));
  CHECK(fine < 1.4);
}

TEST_CASE("probe: a ball that is large for the faces it presses takes few iterations of a given step") {
  constexpr double width = 0.04, height = 0.02, radius = 0.05, depth = 0.002;
  WorldSetup setup;
  setup.mesh = make_box(Vec3(width, height, width), {12, 6, 12}, Vec3(-width / 2, -height, -width / 2));
  setup.materials = {{std::nullopt, soft("neo_hookean", 1e4, 0.3)}};
  setup.boundary.push_back({nodes_where(setup.mesh, [](const Vec3& X) { return X.y() < -height + 1e-9; })});
  setup.solver.integrator = Integrator::backward_euler;
  setup.solver.step = 1;
  setup.solver.tolerance = 1e-6;
  auto world = make_world(setup);
  REQUIRE(world->apply(ball(radius, {Vec3(0, radius, 0), Vec3(0, radius - depth, 0)}, depth)).ok());
  world->tick();
  CHECK_FALSE(world->halt());
  CHECK(tool_of<ProbeState>(*world).max_penetration <= 2e-5);
  MESSAGE(world->solver_stats().iterations << " iterations");
  CHECK(world->solver_stats().iterations <= 25);
}

TEST_CASE("probe: the momentum of a free body is what the probe has given it") {
  WorldSetup setup = cantilever();
  setup.boundary.clear();
  setup.gravity.setZero();
  auto world = make_world(setup);
  REQUIRE(world->apply(ball(0.006, {Vec3(0.03, 0.03, 0.01), Vec3(0.03, 0.01, 0.01)}, 0.5, 0.3)).ok());
  const double tick = world->setup().solver.tick();
  Vec3 given = Vec3::Zero();
  for (int k = 0; k < 100; ++k) {
    world->tick();
    given += tick * tool_of<ProbeState>(*world).force;
  }
  Vec3 momentum = Vec3::Zero();
  const TetMesh& mesh = world->setup().mesh;
  const auto v = world->velocities();
  for (const Tet& tet : mesh.tets) {
    const auto X = [&](std::size_t c) { return mesh.nodes[static_cast<std::size_t>(tet[c])]; };
    for (const int n : tet)
      momentum += 1000 * signed_volume(X(0), X(1), X(2), X(3)) / 4 * v[static_cast<std::size_t>(n)];
  }
  CHECK(momentum.norm() > 1e-4);
  CHECK((momentum - given).norm() <= 1e-9 * momentum.norm());
}

TEST_CASE("probe: tools and cuts together give the same bits for one thread and two, and an undo leaves tools be") {
  for (const auto integrator : {Integrator::verlet, Integrator::backward_euler}) {
    CAPTURE(integrator_name(integrator));
    const auto hash = [&](int threads) {
      WorldSetup setup = cantilever();
      setup.solver.integrator = integrator;
      setup.solver.threads = threads;
      setup.tables = {{Vec3(0, -0.01, 0), Vec3::UnitY(), 0.2}};
      if (!is_explicit(integrator)) setup.solver.step = 0.005;
      auto world = make_world(setup);
      const int end =
          nodes_where(setup.mesh, [](const Vec3& X) { return (X - Vec3(0.1, 0.02, 0.02)).norm() < 1e-9; })[0];
      const int middle =
          nodes_where(setup.mesh, [](const Vec3& X) { return (X - Vec3(0.05, 0.02, 0)).norm() < 1e-9; })[0];
      REQUIRE(world->apply(PinTissue{end, 0.005}).ok());
      REQUIRE(world->apply(ball(0.004, {Vec3(0.05, 0.03, 0.01), Vec3(0.05, 0.015, 0.01)}, 0.5, 0.3)).ok());
      run_until(*world, 0.015);
      CutTissue cut;
      cut.sweep.blades = {{Vec3(0.07, -0.01, -0.01), Vec3(0.07, 0.03, -0.01)},
                          {Vec3(0.07, -0.01, 0.03), Vec3(0.07, 0.03, 0.03)}};
      REQUIRE(world->apply(cut).ok());
      REQUIRE(world->edits().size() == 1);
      REQUIRE(world->apply(SutureTissue{{middle, end}, 0.03, 0.05}).ok());
      run_until(*world, 0.025);
      REQUIRE(world->apply(Undo{}).ok());
      CHECK(has_tool<ProbeState>(*world));
      CHECK(tools_of<PinState>(world->tools()).size() == 1);
      CHECK(tools_of<SutureState>(world->tools()).empty());  // it was set after the cut
      run_until(*world, 0.035);
      REQUIRE_FALSE(world->halt());
      return world->state_hash();
    };
    CHECK(hash(1) == hash(2));
  }
}

TEST_CASE("probe: wrong probes are refused, and a reset removes it") {
  auto world = make_world(sheet(Integrator::verlet));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Vec3 place(0, 0.02, 0);
  for (const MoveProbe& wrong :
       {ball(0, {place}), ball(-1, {place}), ball(nan, {place}), ball(0.01, {}), ball(0.01, {Vec3(nan, 0, 0)}),
        ball(0.01, {place}, 0), ball(0.01, {place}, nan), ball(0.01, {place}, 1, -1), ball(0.01, {place}, 1, nan)})
    CHECK_FALSE(world->apply(wrong).ok());
  CHECK_FALSE(has_tool<ProbeState>(*world));
  CHECK(world->apply(ball(0.01, {place})).ok());
  CHECK(has_tool<ProbeState>(*world));
  CHECK(world->apply(WithdrawProbe{}).ok());
  CHECK_FALSE(has_tool<ProbeState>(*world));
  CHECK(world->apply(ball(0.01, {place})).ok());
  CHECK(world->apply(Reset{}).ok());
  CHECK_FALSE(has_tool<ProbeState>(*world));
}

}  // namespace heml::probe_test
