// Tissue against tissue: two bodies of one mesh, the sides of a cut, a fold.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "world_support.hpp"

namespace heml::self_contact_test {

using namespace heml::test;

namespace {

constexpr double side = 0.04, g = 9.81;
constexpr double weight = side * side * side * 1000 * g;

Eigen::Isometry3d at(const Vec3& place, double degrees = 0, const Vec3& axis = Vec3::UnitZ()) {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.translate(place);
  result.rotate(Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis.normalized()));
  return result;
}

WorldSetup bodies(const TetMesh& one, const TetMesh& other, const Eigen::Isometry3d& place,
                  Integrator integrator = Integrator::verlet, double friction = 0) {
  WorldSetup setup;
  setup.mesh = one;
  add(setup.mesh, other, place);
  setup.materials = {{std::nullopt, soft("neo_hookean", 2e4)}};
  setup.self_contact = SelfContactSettings{friction};
  setup.solver.integrator = integrator;
  setup.solver.threads = 1;
  if (integrator > Integrator::verlet && integrator < Integrator::static_equilibrium) setup.solver.rate = 100;
  return setup;
}

/// A cube, and one of other cells upon it.
WorldSetup stack(Integrator integrator, double friction = 0, double apart = 0) {
  WorldSetup setup = bodies(make_box(Vec3::Constant(side), {3, 3, 3}), make_box(Vec3::Constant(side), {2, 2, 2}),
                            at(Vec3(0, side + apart, 0)), integrator, friction);
  return setup;
}

/// Of nodes from..to: Σ m v and Σ m x × v.
struct Moments {
  Vec3 momentum = Vec3::Zero(), moment = Vec3::Zero();
};
Moments moments(const World& world) {
  const WorldSetup& setup = world.setup();
  const auto x = world.positions(), v = world.velocities();
  Moments sum;
  for (const int t : world.topology()->elements) {
    const Tet& tet = setup.mesh.tets[static_cast<std::size_t>(t)];
    const auto X = [&](std::size_t c) { return setup.mesh.nodes[static_cast<std::size_t>(tet[c])]; };
    const double mass = 1000 * signed_volume(X(0), X(1), X(2), X(3)) / 4;
    for (const int n : tet) {
      sum.momentum += mass * v[static_cast<std::size_t>(n)];
      sum.moment += mass * x[static_cast<std::size_t>(n)].cross(v[static_cast<std::size_t>(n)]);
    }
  }
  return sum;
}

Vec3 mean(const std::vector<Vec3>& values, std::size_t from, std::size_t to) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t n = from; n < to; ++n) sum += values[n];
  return sum / static_cast<double>(to - from);
}

/// Nodes that lie in an element they are no corner of, by more than a depth, m.
int overlapping(const World& world, double depth) {
  const auto x = world.positions();
  const TetMesh& mesh = world.setup().mesh;
  int found = 0;
  for (const int t : world.topology()->elements) {
    const Tet& tet = mesh.tets[static_cast<std::size_t>(t)];
    std::array<Vec3, 4> y;
    for (std::size_t c = 0; c < 4; ++c) y[c] = x[static_cast<std::size_t>(tet[c])];
    for (std::size_t n = 0; n < x.size(); ++n) {
      if (std::find(tet.begin(), tet.end(), static_cast<int>(n)) != tet.end()) continue;
      bool inside = true;
      for (std::size_t c = 0; c < 4 && inside; ++c) {  // further than `depth` behind each face
        const Vec3 &a = y[(c + 1) % 4], &b = y[(c + 2) % 4], &d = y[(c + 3) % 4];
        Vec3 out = (b - a).cross(d - a).normalized();
        if (out.dot(y[c] - a) > 0) out = -out;
        inside = out.dot(x[n] - a) < -depth;
      }
      found += inside ? 1 : 0;
    }
  }
  return found;
}

}  // namespace

TEST_CASE("self-contact: two boxes that collide keep momentum and moment to round-off, and gain no energy") {
  for (const double turned : {0.0, 33.0}) {
    CAPTURE(turned);
    WorldSetup setup = bodies(make_box(Vec3::Constant(side), {3, 3, 3}), make_box(Vec3(0.03, 0.03, 0.05), {2, 2, 3}),
                              at(Vec3(0.007, side + 0.02, -0.003), turned, Vec3(1, 2, 3)));
    const TetMesh lower = make_box(Vec3::Constant(side), {3, 3, 3});
    double top = 0, bottom = 1;
    for (std::size_t n = 0; n < setup.mesh.nodes.size(); ++n) {
      const double y = setup.mesh.nodes[n].y();
      (n < lower.nodes.size() ? top : bottom) = n < lower.nodes.size() ? std::max(top, y) : std::min(bottom, y);
    }
    // The lower one begins flat, as near as it may be, and jumps.
    for (std::size_t n = 0; n < setup.mesh.nodes.size(); ++n) {
      Vec3 X = setup.mesh.nodes[n];
      if (n < lower.nodes.size()) X = Vec3(X.x(), bottom - 0.001 - 0.6 * (top - X.y()), X.z());
      setup.initial_positions.push_back(X);
    }
    setup.initial_velocity = Vec3(0.2, 0.1, -0.3);
    auto world = make_world(setup);
    const Moments start = moments(*world);
    const double energy = total(world->energies());
    double max_force = 0, max_energy = 0;
    for (int tick = 0; tick < 300; ++tick) {
      world->tick();
      max_force = std::max(max_force, tool_of<SelfContactState>(*world).force);
      max_energy = std::max(max_energy, total(world->energies()));
    }
    REQUIRE_FALSE(world->halt());
    const Moments end = moments(*world);
    CHECK(max_force > 0.1);
    CHECK(overlapping(*world, 1e-5) == 0);
    CHECK((end.momentum - start.momentum).norm() <= 1e-13 * start.momentum.norm() * 300);
    CHECK((end.moment - start.moment).norm() <= 1e-11 * start.moment.norm());
    CHECK(max_energy <= energy * (1 + 2e-4));  // the method's own ripple
    const auto v = world->velocities();
    CHECK((mean(v, lower.nodes.size(), v.size()) - setup.initial_velocity).y() > 0.02);  // it was hit
  }
}

TEST_CASE("self-contact: cubes pressed together by opposite forces bear just the force") {
  WorldSetup setup = stack(Integrator::verlet);
  const double pressure = 500, force = pressure * side * side;
  const auto press = [&](double y, double towards) {
    const auto face = nodes_where(setup.mesh, [=](const Vec3& X) { return std::abs(X.y() - y) < 1e-9; });
    setup.loads.push_back({Load::Kind::traction, face, Vec3(0, towards * pressure, 0)});
  };
  press(0, 1);
  press(2 * side, -1);
  setup.solver.damping = 60;
  auto world = make_world(setup);
  run_until(*world, 0.5);
  REQUIRE_FALSE(world->halt());
  CHECK(tool_of<SelfContactState>(*world).force == doctest::Approx(force).epsilon(1e-3));
  CHECK(tool_of<SelfContactState>(*world).max_penetration <= 2e-5 * side);  // rounds end when little changes
}

TEST_CASE("self-contact: at equilibrium what is pressed bears on what presses it, to the solver's digits") {
  WorldSetup setup = stack(Integrator::static_equilibrium);
  for (const double y : {0.0, 2 * side}) {
    setup.boundary.push_back({nodes_where(setup.mesh, [=](const Vec3& X) { return std::abs(X.y() - y) < 1e-9; })});
    setup.boundary.back().translate = Vec3(0, y > 0 ? -0.002 : 0, 0);
  }
  setup.solver.tolerance = 1e-8;
  auto world = make_world(setup);
  world->load_to(1);
  CAPTURE((world->halt() ? world->halt()->message : ""));
  REQUIRE_FALSE(world->halt());
  const double below = world->reactions()[0].y(), above = -world->reactions()[1].y();
  CHECK(below > 0.5);
  CHECK(below == doctest::Approx(above).epsilon(1e-6));
  CHECK(tool_of<SelfContactState>(*world).force == doctest::Approx(below).epsilon(1e-3));
  CHECK(tool_of<SelfContactState>(*world).max_penetration <= 1e-4 * 3 * side);
}

TEST_CASE("self-contact: a stack at rest bears its weight, of every method") {
  for (const auto integrator : moving_integrators()) {
    CAPTURE(std::string(integrator_name(integrator)));
    WorldSetup setup = stack(integrator, 0.3);
    setup.tables = {{Vec3::Zero(), Vec3::UnitY(), 0.3}};
    setup.gravity = Vec3(0, -g, 0);
    setup.solver.damping = 50;
    auto world = make_world(setup);
    run_until(*world, 0.4);
    REQUIRE_FALSE(world->halt());
    CHECK(tool_of<SelfContactState>(*world).force == doctest::Approx(weight).epsilon(1e-3));
    CHECK(tools_of<TableState>(world->tools())[0].force.y() == doctest::Approx(2 * weight).epsilon(1e-3));
    CHECK(tool_of<SelfContactState>(*world).contact_count >= 9);
    CHECK(tool_of<SelfContactState>(*world).max_penetration <= 1e-4 * 3 * side);
  }
}

TEST_CASE("self-contact: blocks that lie askew come to rest in implicit steps, and take few iterations there") {
  // Pairs that a load turns or shifts a little beyond what makes a contact used to go and come back step by step.
  for (const double degrees : {23.0, 40.0}) {
    CAPTURE(degrees);
    WorldSetup setup = bodies(make_box(Vec3(side, 0.75 * side, side), {4, 3, 4}),
                              make_box(Vec3(0.8 * side, 0.5 * side, 0.8 * side), {3, 2, 4}),
                              at(Vec3(side / 2, 0.75 * side + 2e-4, side / 2), degrees, Vec3(0.05, 1, 0.02)) *
                                  at(Vec3(-0.4 * side, 0, -0.4 * side)),
                              Integrator::backward_euler, 0.5);
    setup.materials = {{std::nullopt, soft("neo_hookean", 2e3, 0.45)}};
    setup.boundary.push_back({nodes_where(setup.mesh, [](const Vec3& X) { return X.y() < 1e-6; })});
    setup.gravity = Vec3(0, -g, 0);
    setup.solver.rate = 60;
    setup.solver.damping = 4;
    auto world = make_world(setup);
    run_until(*world, 1);
    const long iterations = world->solver_stats().iterations;
    for (int tick = 0; tick < 10; ++tick) world->tick();
    MESSAGE("kinetic energy " << world->energies().kinetic << " J, " << world->solver_stats().iterations - iterations
                              << " iterations in ten steps, " << iterations << " before");
    CHECK(world->energies().kinetic < 1e-8);
    CHECK(world->solver_stats().iterations - iterations < 60);
    CHECK(world->solver_stats().explicit_rescues == 0);
  }
}

TEST_CASE("self-contact: without friction a block lies still in few iterations of implicit steps") {
  // What a pair does in second order matters most where nothing holds it along the surface: 6 iterations a step
  // without.
  WorldSetup setup =
      bodies(make_box(Vec3(3 * side, side, 3 * side), {6, 2, 6}), make_box(Vec3::Constant(side), {3, 3, 3}),
             at(Vec3(0.88 * side, 1.01 * side, 0.82 * side)), Integrator::backward_euler);
  setup.materials = {{std::nullopt, soft("neo_hookean", 5e3)}};
  setup.boundary.push_back({nodes_where(setup.mesh, [](const Vec3& X) { return X.y() < 1e-6; })});
  setup.gravity = Vec3(0, -g, 0);
  setup.solver.rate = 60;
  setup.solver.damping = 2;
  auto world = make_world(setup);
  run_until(*world, 0.4);
  const long iterations = world->solver_stats().iterations;
  for (int tick = 0; tick < 10; ++tick) world->tick();
  REQUIRE_FALSE(world->halt());
  CHECK(tool_of<SelfContactState>(*world).force == doctest::Approx(weight).epsilon(0.02));
  CHECK(world->solver_stats().iterations - iterations <= 40);
}

TEST_CASE("self-contact: under a budget of iterations a body falls on another, not through it") {
  for (const Integrator integrator : {Integrator::backward_euler, Integrator::bdf2, Integrator::tr_bdf2})
    for (const int iterations : {1, 4}) {
      CAPTURE(std::string(integrator_name(integrator)));
      CAPTURE(iterations);
      WorldSetup setup = stack(integrator, 0.3, 2.5 * side);
      setup.boundary.push_back({nodes_where(setup.mesh, [](const Vec3& X) { return X.y() < 1e-6; })});
      setup.gravity = Vec3(0, -g, 0);
      setup.solver.rate = 60;
      setup.solver.damping = 2;
      setup.solver.budget = Budget{};
      setup.solver.budget->iterations = iterations;
      auto world = make_world(setup);
      run_until(*world, 1);
      REQUIRE_FALSE(world->halt());
      const auto x = world->positions();
      const std::size_t first = make_box(Vec3::Constant(side), {3, 3, 3}).nodes.size();
      CHECK(mean(x, first, x.size()).y() == doctest::Approx(1.5 * side).epsilon(0.1));
    }
}

TEST_CASE("self-contact: on a slope a block sticks or slides as Coulomb says") {
  const double degrees = 25, angle = degrees * std::numbers::pi / 180;
  for (const auto integrator : {Integrator::verlet, Integrator::backward_euler})
    for (const double friction : {0.2, 0.6}) {
      CAPTURE(std::string(integrator_name(integrator)));
      CAPTURE(friction);
      WorldSetup setup =
          bodies(make_box(Vec3(0.12, 0.01, 0.04), {9, 1, 3}), make_box(Vec3(0.03, 0.01, 0.03), {2, 1, 2}),
                 at(Vec3(0.01, 0.01, 0.005)), integrator, friction);
      setup.gravity = g * Vec3(std::sin(angle), -std::cos(angle), 0);
      const std::size_t first = make_box(Vec3(0.12, 0.01, 0.04), {9, 1, 3}).nodes.size();
      setup.boundary.push_back({nodes_where(setup.mesh, [](const Vec3& X) { return X.y() < 0.0101; })});
      std::erase_if(setup.boundary[0].nodes, [&](int n) { return n >= static_cast<int>(first); });
      auto world = make_world(setup);
      run_until(*world, 0.1);
      REQUIRE_FALSE(world->halt());
      const auto x = world->positions(), v = world->velocities();
      const double speed = mean(v, first, v.size()).x();
      const double slides = std::max(0.0, g * (std::sin(angle) - friction * std::cos(angle)));
      if (slides > 0)
        CHECK(speed == doctest::Approx(slides * 0.1).epsilon(0.05));
      else
        CHECK((mean(x, first, x.size()) - mean(setup.mesh.nodes, first, x.size())).x() < 2e-4);
    }
}

TEST_CASE("self-contact: at 1 m/s nothing tunnels, faces, edges or corners first") {
  const Vec3 axes[] = {Vec3::UnitZ(), Vec3::UnitZ(), Vec3(1, 0, 1), Vec3(1, 0.2, 0)};
  const double degrees[] = {0, 45, 54.7, 30};
  for (const auto integrator : {Integrator::verlet, Integrator::backward_euler})
    for (int k = 0; k < 4; ++k) {
      CAPTURE(std::string(integrator_name(integrator)));
      CAPTURE(k);
      // A layer as thin as one element, and a small box that flies at it.
      const TetMesh plate = make_box(Vec3(0.08, 0.008, 0.08), {6, 1, 6});
      WorldSetup setup = bodies(plate, make_box(Vec3::Constant(0.02), {2, 2, 2}),
                                at(Vec3(0.03, 0.03, 0.031), degrees[k], axes[k]), integrator);
      setup.boundary.push_back({nodes_where(setup.mesh, [](const Vec3& X) { return X.y() < 1e-9; })});
      setup.initial_velocity = Vec3(0, -1, 0);
      setup.solver.continuation = true;
      auto world = make_world(setup);
      double lowest = 1, touched = 0;
      for (; world->time() < 0.12;) {
        world->tick();
        CAPTURE((world->halt() ? world->halt()->message : ""));
        REQUIRE_FALSE(world->halt());
        touched = std::max(touched, tool_of<SelfContactState>(*world).force);
        const auto x = world->positions();
        lowest = std::min(lowest, mean(x, plate.nodes.size(), x.size()).y() - mean(x, 0, plate.nodes.size()).y());
      }
      CHECK(touched > 0);
      CHECK(lowest > 0.004);
      CHECK(overlapping(*world, 1e-3) == 0);
      const auto v = world->velocities();
      CHECK(mean(v, plate.nodes.size(), v.size()).y() > -0.02);  // stopped, or thrown back
    }
}

TEST_CASE("self-contact: a body that touches nothing moves by the same bits as without") {
  for (const auto integrator : {Integrator::verlet, Integrator::backward_euler}) {
    WorldSetup setup = cantilever();
    setup.solver.integrator = integrator;
    if (integrator == Integrator::backward_euler) setup.solver.rate = 100;
    const auto without = make_world(setup);
    setup.self_contact = SelfContactSettings{0.3};
    const auto with = make_world(setup);
    for (const auto& world : {without.get(), with.get()}) run_until(*world, 0.2);
    CHECK(with->state_hash() == without->state_hash());
    CHECK_FALSE(has_tool<SelfContactState>(*without));
    CHECK(tool_of<SelfContactState>(*with).contact_count == 0);
  }
}

TEST_CASE("self-contact: where bodies bear on each other alone, blocks fall on each other by the same bits") {
  for (const auto integrator : {Integrator::verlet, Integrator::backward_euler}) {
    WorldSetup setup = stack(integrator, 0.3, 0.01);
    setup.boundary.push_back({nodes_where(setup.mesh, [](const Vec3& X) { return X.y() < 1e-9; })});
    setup.initial_velocity = Vec3(0.05, -0.2, 0);
    const auto all = make_world(setup);
    setup.self_contact->within_bodies = false;
    const auto between = make_world(setup);
    int ticks_in_contact = 0;
    for (const double t : {0.05, 0.1, 0.15, 0.2}) {
      for (const auto& world : {all.get(), between.get()}) run_until(*world, t);
      ticks_in_contact += tool_of<SelfContactState>(*between).contact_count > 0;
      CHECK(between->state_hash() == all->state_hash());
    }
    CHECK(ticks_in_contact > 0);
  }
}

TEST_CASE("self-contact: what overlaps at rest stays at rest") {
  for (const auto integrator : {Integrator::verlet, Integrator::backward_euler}) {
    WorldSetup setup = bodies(make_box(Vec3::Constant(side), {3, 3, 3}), make_box(Vec3::Constant(side), {2, 2, 2}),
                              at(Vec3(0.002, side - 0.003, 0.001)), integrator);
    auto world = make_world(setup);
    run_until(*world, 0.1);
    CHECK(std::abs(total(world->energies())) <= 1e-15);  // of forces' round-off
    CHECK(tool_of<SelfContactState>(*world).force == 0);
  }
}

TEST_CASE("self-contact: what begins deep inside is pushed out again") {
  constexpr double deep = 0.003;  // a quarter of an edge
  WorldSetup setup = stack(Integrator::verlet, 0, 0.001);
  setup.gravity.setZero();
  setup.initial_positions = setup.mesh.nodes;
  const std::size_t lower = make_box(Vec3::Constant(side), {3, 3, 3}).nodes.size();
  for (std::size_t n = lower; n < setup.mesh.nodes.size(); ++n) setup.initial_positions[n].y() -= 0.001 + deep;
  auto world = make_world(setup);
  world->tick();
  CHECK(tool_of<SelfContactState>(*world).contact_count > 0);
  CHECK(tool_of<SelfContactState>(*world).max_penetration > 0.8 * deep);
  run_until(*world, 0.2);
  REQUIRE_FALSE(world->halt());
  const auto x = world->positions();
  CHECK(mean(x, lower, x.size()).y() - mean(x, 0, lower).y() > side - 0.1 * deep);
}

TEST_CASE("self-contact: a cut opens as freely as without, and closes no further than it was") {
  const auto run = [](bool with, double pull) {
    WorldSetup setup = cantilever();
    setup.gravity.setZero();
    if (with) setup.self_contact = SelfContactSettings{};
    const auto end = nodes_where(setup.mesh, [](const Vec3& X) { return X.x() > 0.1 - 1e-9; });
    setup.loads.push_back({Load::Kind::force, end, Vec3(pull, 0, 0)});
    setup.solver.damping = 20;
    auto world = make_world(setup);
    world->apply(CutTissue{
        {{{Vec3(0.047, -1, -1), Vec3(0.047, -1, 1)}, {Vec3(0.047, 0.012, -1), Vec3(0.047, 0.012, 1)}}}, false});
    REQUIRE(world->edits().size() == 1);
    run_until(*world, 0.4);
    REQUIRE_FALSE(world->halt());
    return world;
  };
  const auto opened = run(true, 0.2), free = run(false, 0.2);
  CHECK(rms_difference(opened->positions(), free->positions()) < 1e-6);
  const auto closed = run(true, -0.2), passed = run(false, -0.2);
  CHECK(tool_of<SelfContactState>(*closed).force > 0.02);
  CHECK(overlapping(*closed, 2e-5) == 0);
  CHECK(overlapping(*passed, 2e-5) > 0);
}

static void check_bits(Integrator integrator, bool single) {
  WorldSetup setup = stack(integrator, 0.4, 0.001);
  setup.tables = {{Vec3::Zero(), Vec3::UnitY(), 0.3}};
  setup.gravity = Vec3(1, -g, 0.5);
  setup.solver.single_precision = single;
  auto one = make_world(setup);
  setup.solver.threads = 2;
  auto two = make_world(setup);
  for (const auto& world : {one.get(), two.get()}) run_until(*world, 0.02);
  CHECK(tool_of<SelfContactState>(*one).contact_count > 0);
  CHECK(one->state_hash() == two->state_hash());
  const auto hash = one->state_hash();
  const double below = side + 0.002;  // the lower body's top: the upper one alone is cut
  one->apply(
      CutTissue{{{{Vec3(0.019, below, -1), Vec3(0.019, below, 1)}, {Vec3(0.019, 1, -1), Vec3(0.019, 1, 1)}}}, false});
  REQUIRE(one->edits().size() == 1);
  run_until(*one, 0.03);
  CHECK_FALSE(one->halt());
  one->apply(Undo{});
  CHECK(one->state_hash() == hash);
  one->apply(Reset{});
  run_until(*one, 0.02);
  CHECK(one->state_hash() == hash);
}

TEST_CASE("self-contact: explicit steps give the same bits for any number of threads, after a reset and an undo") {
  for (const bool single : {false, true}) check_bits(Integrator::verlet, single);
}

TEST_CASE("self-contact: implicit steps in double give the same bits, with threads, after a reset and an undo") {
  check_bits(Integrator::backward_euler, false);
}

TEST_CASE("self-contact: implicit steps in float give the same bits, with threads, after a reset and an undo") {
  check_bits(Integrator::backward_euler, true);
}

}  // namespace heml::self_contact_test
