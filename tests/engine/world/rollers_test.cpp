// Supports that hold some coordinates of a node and leave the others free: a block between planes that it slides on,
// against the closed form of the law, by every method.
#include <doctest/doctest.h>

#include <cmath>
#include <heml/dynamics/integrator.hpp>

#include "world_support.hpp"

namespace heml::rollers_test {

using namespace heml::test;

namespace {

constexpr double side = 0.1, pressed = 0.8;

AxisSet along(int axis) {
  AxisSet axes = AxisSet::none();
  axes.has[static_cast<std::size_t>(axis)] = true;
  return axes;
}

/// A block on three planes it slides on, whose top is pressed down.
WorldSetup pressed_block(Integrator method, int cells, double ramp_time) {
  WorldSetup setup;
  setup.mesh = make_box(Vec3(side, side, side), {cells, cells, cells});
  setup.materials = {{std::nullopt, soft()}};
  for (int axis = 0; axis < 3; ++axis) {
    Boundary plane;
    plane.nodes = nodes_where(setup.mesh, [&](const Vec3& X) { return X[axis] < 1e-9; });
    plane.axes = along(axis);
    setup.boundary.push_back(plane);
  }
  Boundary top;
  top.nodes = nodes_where(setup.mesh, [](const Vec3& X) { return X.z() > side - 1e-9; });
  top.translate = Vec3(0, 0, (pressed - 1) * side);
  top.ramp_time = ramp_time;
  top.axes = along(2);
  setup.boundary.push_back(top);
  setup.solver.integrator = method;
  setup.solver.threads = 1;
  return setup;
}

/// b with μ (b² − 1) + λ ln(a b²) = 0: no stress across the sides.
double free_stretch(double a) {
  const LameParameters lame = lame_parameters(1e4, 0.3);
  double low = 0.5, high = 2;
  for (int k = 0; k < 100; ++k) {
    const double b = (low + high) / 2;
    (lame.mu * (b * b - 1) + lame.lambda * std::log(a * b * b) < 0 ? low : high) = b;
  }
  return low;
}

double largest_error(const World& world, const WorldSetup& setup) {
  const double b = free_stretch(pressed);
  const std::vector<Vec3> x = world.positions();
  double largest = 0;
  for (std::size_t n = 0; n < x.size(); ++n)
    largest = std::max(largest, (x[n] - Vec3(b, b, pressed).cwiseProduct(setup.mesh.nodes[n])).norm());
  return largest;
}

}  // namespace

TEST_CASE("rollers: statics press a block as the law says, by every preconditioner, and bear the force of the top") {
  for (const bool is_float : {false, true})
    for (const auto preconditioner : {Preconditioner::cholesky, Preconditioner::block_jacobi, Preconditioner::scalar,
                                      Preconditioner::multilevel}) {
      CAPTURE(static_cast<int>(preconditioner));
      WorldSetup setup = pressed_block(Integrator::static_equilibrium, 4, 0);
      setup.solver.single_precision = is_float;
      setup.solver.preconditioner = preconditioner;
      setup.solver.tolerance = is_float ? 1e-5 : 1e-9;
      const auto world = make_world(setup);
      world->load_to(1);
      REQUIRE(!world->halt());
      CHECK(largest_error(*world, setup) < (is_float ? 1e-5 : 1e-9) * side);
      // P33 on the top's area at rest: μ (a − 1/a) + λ ln J / a.
      const LameParameters lame = lame_parameters(1e4, 0.3);
      const double a = pressed, b = free_stretch(a);
      const double force = lame.mu * (a - 1 / a) + lame.lambda * std::log(a * b * b) / a;
      const std::vector<Vec3> reactions = world->reactions();
      const double tolerance = is_float ? 1e-3 : 1e-8;
      CHECK(reactions[3].z() == doctest::Approx(force * side * side).epsilon(tolerance));
      CHECK(reactions[2].z() == doctest::Approx(-force * side * side).epsilon(tolerance));
      for (const std::size_t k : {0, 1}) CHECK(reactions[k].norm() < 1e-3 * std::abs(force) * side * side);
      CHECK(reactions[3].head<2>().isZero(0));  // nothing along what is free
    }
}

TEST_CASE("rollers: every method that steps comes to the same rest, in float too") {
  for (const Integrator method : moving_integrators()) {
    for (const bool is_float : {false, true}) {
      CAPTURE(static_cast<int>(method));
      WorldSetup setup = pressed_block(method, 3, 0.2);
      setup.solver.single_precision = is_float;
      setup.solver.damping = 20;
      setup.solver.rate = is_explicit(method) ? 1000 : 60;
      const auto world = make_world(setup);
      while (world->time() < 2) {
        world->tick();
        REQUIRE(!world->halt());
      }
      CHECK(largest_error(*world, setup) < 1e-4 * side);
      for (const int n : setup.boundary[0].nodes) CHECK(world->positions()[static_cast<std::size_t>(n)].x() == 0);
    }
  }
}

TEST_CASE("rollers: quadratic elements, and L-BFGS, whose preconditioner works in double") {
  for (const auto preconditioner : {Preconditioner::cholesky, Preconditioner::block_jacobi, Preconditioner::scalar,
                                    Preconditioner::multilevel}) {
    CAPTURE(static_cast<int>(preconditioner));
    WorldSetup setup = pressed_block(Integrator::static_equilibrium, 2, 0);
    for (Boundary& entry : setup.boundary) entry.nodes.clear();
    setup.midedges = add_midedge_nodes(setup.mesh);
    setup.solver.quadratic = true;
    for (int k = 0; k < 4; ++k)
      setup.boundary[static_cast<std::size_t>(k)].nodes = nodes_where(
          setup.mesh, [&](const Vec3& X) { return k < 3 ? X[k] < 1e-9 : X.z() > side - 1e-9; });
    setup.solver.preconditioner = preconditioner;
    setup.solver.tolerance = 1e-9;
    const auto world = make_world(setup);
    world->load_to(1);
    REQUIRE(!world->halt());
    CHECK(largest_error(*world, setup) < 1e-9 * side);
  }
  WorldSetup setup = pressed_block(Integrator::backward_euler, 3, 0.2);
  setup.solver.minimiser = Minimiser::lbfgs;
  setup.solver.damping = 20;
  setup.solver.rate = 60;
  const auto world = make_world(setup);
  while (world->time() < 2) {
    world->tick();
    REQUIRE(!world->halt());
  }
  CHECK(largest_error(*world, setup) < 1e-4 * side);
}

TEST_CASE("rollers: a block that is pushed along a plane slides off as a free body does") {
  for (const Integrator method : {Integrator::verlet, Integrator::backward_euler, Integrator::tr_bdf2}) {
    CAPTURE(static_cast<int>(method));
    WorldSetup setup = pressed_block(method, 2, 0);
    setup.boundary.resize(1);  // x is held, y and z are free
    setup.gravity = Vec3(0, 2, 0);
    setup.solver.rate = is_explicit(method) ? 1000 : 200;
    const auto world = make_world(setup);
    while (world->time() < 0.5 - 1e-9) world->tick();
    const std::vector<Vec3> x = world->positions();
    Vec3 moved = Vec3::Zero();
    for (std::size_t n = 0; n < x.size(); ++n) moved += (x[n] - setup.mesh.nodes[n]) / static_cast<double>(x.size());
    CHECK(moved.y() == doctest::Approx(0.25).epsilon(0.02));
    CHECK(std::abs(moved.x()) < 1e-6);
    CHECK(std::abs(moved.z()) < 1e-6);
  }
}

TEST_CASE("rollers: of several entries on one coordinate the last holds, and pins hold all") {
  WorldSetup setup = pressed_block(Integrator::static_equilibrium, 2, 0);
  Boundary again = setup.boundary[3];
  again.translate.z() = 0;
  setup.boundary.push_back(again);
  const auto world = make_world(setup);
  world->load_to(1);
  for (std::size_t n = 0; n < setup.mesh.nodes.size(); ++n)
    CHECK((world->positions()[n] - setup.mesh.nodes[n]).norm() < 1e-9);
  CHECK(world->reactions()[3].isZero(0));
}

}  // namespace heml::rollers_test
