// Stiff and extreme cases: far stretched, crushed, wrung, of parts that differ by orders of magnitude.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "support.hpp"
#include "world_support.hpp"

using namespace heml;
using namespace heml::test;

namespace {

constexpr double length = 0.1;  // m, of the bar along x

std::vector<int> far_end(const TetMesh& mesh) {
  return nodes_where(mesh, [](const Vec3& X) { return X.x() > length - 1e-9; });
}

/// A bar held at both ends, the far one moved along x and turned about the bar's middle line.
WorldSetup held_at_both_ends(double poisson, double move, double degrees = 0, double over = 0) {
  WorldSetup setup = cantilever();
  setup.materials[0].material = soft("neo_hookean", 1e4, poisson);
  setup.gravity.setZero();
  Boundary end{far_end(setup.mesh)};
  end.translate = Vec3(move, 0, 0);
  end.axis = Vec3(1, 0, 0);
  end.origin = Vec3(0, 0.01, 0.01);
  end.degrees = degrees;
  end.over = over;
  setup.boundary.push_back(end);
  return setup;
}

void make_static(WorldSetup& setup, double tolerance = 1e-8) {
  setup.solver.integrator = Integrator::static_equilibrium;
  setup.solver.tolerance = tolerance;
}

void make_backward_euler(WorldSetup& setup, double step) {
  setup.solver.integrator = Integrator::backward_euler;
  setup.solver.step = step;
}

double least_volume_ratio(World& world) {
  const auto J = world.volume_ratios();
  return *std::min_element(J.begin(), J.end());
}

/// Elements beyond the middle of the bar are of region 1.
void split_in_halves(WorldSetup& setup, const Material& far_half) {
  for (std::size_t t = 0; t < setup.mesh.tets.size(); ++t) {
    double x = 0;
    for (const int n : setup.mesh.tets[t]) x += setup.mesh.nodes[static_cast<std::size_t>(n)].x() / 4;
    setup.mesh.regions[t] = x > length / 2;
  }
  setup.materials.push_back({1, far_half});
}

}  // namespace

TEST_CASE("extremes: stretched to five times its length, or pressed to a fifth, in at most 60 iterations") {
  for (const bool cube : {false, true})
    for (const double stretch : {5.0, 0.2}) {
      CAPTURE(cube);
      CAPTURE(stretch);
      WorldSetup setup = held_at_both_ends(0.3, (stretch - 1) * length);
      if (cube) {
        setup.mesh = make_box(Vec3(length, length, length), {5, 5, 5});
        setup.boundary[0].nodes = nodes_where(setup.mesh, [](const Vec3& X) { return X.x() < 1e-9; });
        setup.boundary[1].nodes = far_end(setup.mesh);
      }
      make_static(setup);
      const auto world = make_world(setup);
      world->load_to(1);
      if (world->halt()) FAIL(world->halt()->message);
      MESSAGE(std::string(cube ? "cube" : "bar") << " to " << stretch << ": " << world->solver_work().iterations
                                                 << " iterations, least J " << least_volume_ratio(*world));
      CHECK(world->solver_work().iterations <= 60);
      CHECK(least_volume_ratio(*world) > 0);
      CHECK((world->reactions()[0] + world->reactions()[1]).norm() <= 1e-6 * world->reactions()[0].norm());
    }
}

TEST_CASE("extremes: a bar wrung by half a turn in a fifth of a second, in at most 8 iterations a step") {
  WorldSetup setup = held_at_both_ends(0.3, 0, 180, 0.2);
  make_backward_euler(setup, 0.01);
  const auto world = make_world(setup);
  long before = 0, most = 0;
  while (world->time() < 0.3) {
    world->tick();
    if (world->halt()) FAIL(world->halt()->message);
    most = std::max(most, world->solver_work().iterations - before);
    before = world->solver_work().iterations;
    CHECK(least_volume_ratio(*world) > 0);
  }
  MESSAGE("at most " << most << " iterations a step");
  CHECK(most <= 8);
}

TEST_CASE("extremes: a bar wrung by two turns stores more with every angle") {
  // Stretched at the same time: held short it buckles sideways at one and a half turns, and takes the turns back in a
  // loop.
  WorldSetup setup = held_at_both_ends(0.3, 0.5 * length, 720, 1);
  make_backward_euler(setup, 0.02);
  setup.solver.damping = 100;  // slow enough to be all but at rest
  const auto world = make_world(setup);
  double before = 0;
  while (world->time() < 1 - 1e-9) {
    world->tick();
    if (world->halt()) FAIL(world->halt()->message);
    const double now = world->energies().elastic;
    CHECK(std::isfinite(now));
    CHECK(now > before);
    before = now;
  }
  CHECK(least_volume_ratio(*world) > 0);
}

TEST_CASE("extremes: one half a million times stiffer than the other moves as a rigid body does") {
  // The far half held rigidly, and a far half so stiff that it may as well be: the soft half feels no difference.
  WorldSetup stiff = held_at_both_ends(0.3, 0.02, 40);
  split_in_halves(stiff, soft("neo_hookean", 1e10));
  WorldSetup rigid = stiff;
  rigid.boundary[1].nodes = nodes_where(rigid.mesh, [](const Vec3& X) { return X.x() > length / 2 - 1e-9; });
  for (WorldSetup* setup : {&stiff, &rigid}) make_static(*setup);
  const auto a = make_world(stiff), b = make_world(rigid);
  for (World* world : {a.get(), b.get()}) {
    world->load_to(1);
    if (world->halt()) FAIL(world->halt()->message);
    CHECK(world->solver_work().residual <= 1e-8);
  }
  MESSAGE(a->solver_work().iterations << " iterations at rest");
  const double moved = rms_difference(b->positions(), rigid.mesh.nodes);
  CHECK(rms_difference(a->positions(), b->positions()) <= 1e-4 * moved);
  CHECK((a->reactions()[0] - b->reactions()[0]).norm() <= 1e-4 * b->reactions()[0].norm());

  WorldSetup falling = cantilever();
  split_in_halves(falling, soft("neo_hookean", 1e10));
  make_backward_euler(falling, 0.005);
  const auto world = make_world(falling);
  run_until(*world, 0.2);
  if (world->halt()) FAIL(world->halt()->message);
  const auto x = world->positions();
  for (std::size_t t = 0; t < falling.mesh.tets.size(); ++t) {
    if (falling.mesh.regions[t] == 0) continue;
    const Tet& tet = falling.mesh.tets[t];
    const auto edge = [&](const auto& nodes) {
      return (nodes[static_cast<std::size_t>(tet[1])] - nodes[static_cast<std::size_t>(tet[0])]).norm();
    };
    CHECK(edge(x) == doctest::Approx(edge(falling.mesh.nodes)).epsilon(1e-5));
  }
}

TEST_CASE("extremes: a sliver shortens the explicit step and leaves implicit ones as they are") {
  const WorldSetup good = cantilever();
  WorldSetup bad = good;
  // One element is split in four by a node a thousandth of its height above a face: the body is the same.
  const Tet whole = bad.mesh.tets[0];
  const auto X = [&](std::size_t c) -> const Vec3& { return bad.mesh.nodes[static_cast<std::size_t>(whole[c])]; };
  const int inside = static_cast<int>(bad.mesh.nodes.size());
  bad.mesh.nodes.emplace_back((1 - 1e-3) / 3 * (X(0) + X(1) + X(2)) + 1e-3 * X(3));
  bad.mesh.tets[0][3] = inside;  // the sliver, on that face
  for (std::size_t c = 0; c < 3; ++c) {
    bad.mesh.tets.push_back(whole);
    bad.mesh.tets.back()[c] = inside;
    bad.mesh.regions.push_back(0);
  }
  const double limit_good = make_world(good)->stable_step(), limit_bad = make_world(bad)->stable_step();
  MESSAGE("stable step " << limit_good << " s without, " << limit_bad << " s with a sliver");
  CHECK(limit_bad < 0.05 * limit_good);
  CHECK(limit_bad > 0);

  std::vector<double> sag;
  std::vector<long> iterations;
  for (WorldSetup setup : {good, bad}) {
    make_backward_euler(setup, 0.01);
    const auto world = make_world(setup);
    run_until(*world, 0.3);
    if (world->halt()) FAIL(world->halt()->message);
    CHECK(least_volume_ratio(*world) > 0);
    const int corner =
        nodes_where(setup.mesh, [](const Vec3& at) { return (at - Vec3(length, 0, 0)).norm() < 1e-9; })[0];
    sag.push_back(-world->positions()[static_cast<std::size_t>(corner)].y());
    iterations.push_back(world->solver_work().iterations);
  }
  MESSAGE("sag " << sag[0] << " and " << sag[1] << " m in " << iterations[0] << " and " << iterations[1]
                 << " iterations");
  CHECK(sag[1] == doctest::Approx(sag[0]).epsilon(0.01));
  CHECK(static_cast<double>(iterations[1]) <= 1.2 * static_cast<double>(iterations[0]) + 5);
}

TEST_CASE("extremes: one half ten thousand times heavier, both methods agree and keep the energy") {
  WorldSetup setup = cantilever("neo_hookean", 1e5);
  Material light = soft("neo_hookean", 1e5);
  light.density = 0.1;
  split_in_halves(setup, light);
  const auto swung = [&](Integrator integrator, std::optional<double> step) {
    setup.solver.integrator = integrator;
    setup.solver.step = step;
    auto world = make_world(setup);
    run_until(*world, 0.05);
    if (world->halt()) FAIL(world->halt()->message);
    return world;
  };
  const auto verlet = swung(Integrator::verlet, std::nullopt), implicit = swung(Integrator::tr_bdf2, 5e-4);
  const double moved = rms_difference(verlet->positions(), setup.mesh.nodes);
  MESSAGE("limit " << verlet->stable_step() << " s, moved " << moved << " m, difference "
                   << rms_difference(verlet->positions(), implicit->positions()) << " m");
  CHECK(rms_difference(verlet->positions(), implicit->positions()) <= 0.01 * moved);
  CHECK(std::abs(total(verlet->energies())) <= 1e-3 * std::abs(verlet->energies().potential));
}

TEST_CASE("extremes: backward Euler gains no energy without load, from any start") {
  struct Start {
    std::string name;
    std::function<Vec3(const Vec3&)> place;
  };
  const auto turned = [](const Vec3& X) {
    const double angle = std::numbers::pi * X.x() / length;
    const Vec3 arm = X - Vec3(X.x(), 0.01, 0.01);
    return Vec3(X.x(), 0.01 + arm.y() * std::cos(angle) - arm.z() * std::sin(angle),
                0.01 + arm.y() * std::sin(angle) + arm.z() * std::cos(angle));
  };
  const Start starts[] = {
      {"stretched", [](const Vec3& X) { return Vec3(2 * X.x(), X.y(), X.z()); }},
      {"compressed", [](const Vec3& X) { return Vec3(0.7 * X.x(), X.y(), X.z()); }},
      {"collapsed to half", [](const Vec3& X) { return Vec3(X.x(), 0.5 * X.y(), 0.5 * X.z()); }},
      {"twisted", turned},
  };
  for (const std::string law : {"neo_hookean", "stvk", "neo_hookean_iso"})
    for (const double poisson : {0.3, 0.45})
      for (const Start& start : starts) {
        CAPTURE(law);
        CAPTURE(poisson);
        CAPTURE(start.name);
        WorldSetup setup = cantilever();
        setup.mesh = make_box(Vec3(length, 0.02, 0.02), {6, 2, 2});
        setup.boundary[0].nodes = nodes_where(setup.mesh, [](const Vec3& X) { return X.x() < 1e-9; });
        const Lame lame = lame_from(1e4, poisson);
        setup.materials[0].material = soft(law.c_str(), 1e4, poisson);
        if (law == "neo_hookean_iso")
          setup.materials[0].material.parameters = {lame.mu / 2, lame.lambda + 2 * lame.mu / 3};
        setup.gravity.setZero();
        for (const Vec3& X : setup.mesh.nodes) setup.initial_positions.push_back(X.x() < 1e-9 ? X : start.place(X));
        make_backward_euler(setup, 0.01);
        const auto world = make_world(setup);
        const double first = total(world->energies());
        double before = first, worst = 0;
        for (int k = 0; k < 25 && !world->halt(); ++k) {
          world->tick();
          const double now = total(world->energies());
          worst = std::max(worst, (now - before) / first);
          before = now;
        }
        if (world->halt()) FAIL_CHECK(world->halt()->message);
        CHECK(worst <= 1e-9);
        CHECK(before < 0.5 * first);
      }
}
