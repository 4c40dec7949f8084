// A ball pressed into a block, without friction.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <heml/mesh/generate.hpp>
#include <studies/validation/body.hpp>

namespace heml::validation {
namespace {

constexpr double ball_radius = 0.02, pressed_radius = 0.04, pressed_height = 0.04;  // m
constexpr double pressed_shear = 3e3, pressed_poisson = 0.3;                        // Pa, -

struct Depth {
  double depth;  ///< m
  double force;  ///< N, of the reference
};
// assets/make/hertz_reference.py with 80 cells a side.
constexpr Depth depths[] = {{0.0005, 0.0194939}, {0.001, 0.0570244}, {0.002, 0.1690838}, {0.004, 0.5129934}};

/// From 0..1, at first evenly and then ever faster.
double graded(double part) {
  constexpr double growth = 3;  // elements at the edge of contact are small for it at all depths
  return std::sinh(growth * part) / std::sinh(growth);
}

/// From the unit cube to a quarter of the cylinder under the ball, with elements that grow away from it.
Vec3 to_cylinder(const Vec3& X) {
  const double side = std::max(X.x(), X.y()), radius = graded(side);
  const Vec3 square = side > 0 ? Vec3(radius / side * X.x(), radius / side * X.y(), 0) : Vec3(Vec3::Zero());
  const Vec3 circle = side > 0 ? Vec3(radius / square.norm() * square) : square;
  const double part = radius * radius;  // a square at the axis, a circle outside
  Vec3 place = pressed_radius * ((1 - part) * square + part * circle);
  place.z() = -pressed_height * graded(1 - X.z());
  return place;
}

WorldSetup quarter_block(const std::string& element, int n) {
  WorldSetup setup = make_body(make_box(Vec3(1, 1, 1), {n, n, n}), element,
                               rubber(pressed_shear, bulk_of(pressed_shear, pressed_poisson)), to_cylinder);
  Boundary base;
  base.nodes = nodes_where(setup, [](const Vec3& X) { return X.z() < 1e-9 - pressed_height; });
  setup.boundary.push_back(base);
  for (const int axis : {0, 1}) {
    Boundary symmetry;
    symmetry.nodes = nodes_where(setup, [&](const Vec3& X) { return X[axis] < 1e-9 && X.z() > 1e-9 - pressed_height; });
    symmetry.axes = AxisSet::none();
    symmetry.axes.has[static_cast<std::size_t>(axis)] = true;
    setup.boundary.push_back(symmetry);
  }
  return setup;
}

double hertz(double depth) {
  const double young = 2 * pressed_shear * (1 + pressed_poisson);
  return 4.0 / 3 * young / (1 - pressed_poisson * pressed_poisson) * std::sqrt(ball_radius) * std::pow(depth, 1.5);
}

/// The reference between its depths: Hertz's formula times a factor that changes evenly.
double drawn_force(double depth) {
  const auto factor = [](const Depth& at) { return at.force / hertz(at.depth); };
  std::size_t k = 1;
  while (k + 1 < std::size(depths) && depths[k].depth < depth) ++k;
  const Depth &a = depths[k - 1], &b = depths[k];
  const double part = std::max(0.0, (depth - a.depth) / (b.depth - a.depth));
  return hertz(depth) * ((1 - part) * factor(a) + part * factor(b));
}

}  // namespace

Finding ball_contact(const Trial& trial) {
  Finding finding;
  Curve formula{"Hertz 1881", true, {{0, 0}}}, reference{"axisymmetric", true, {{0, 0}}};
  for (int k = 1; k <= 40; ++k) {
    const double depth = k * 1e-4;
    formula.points.push_back({depth, hertz(depth)});
    reference.points.push_back({depth, drawn_force(depth)});
  }
  finding.curves = {formula, reference};
  WorldSetup setup = quarter_block("p2", 10);
  setup.materials[0].material.density = 1;
  setup.solver.integrator = Integrator::backward_euler;
  setup.solver.step = 1;  // inertia is 1e-9 of the stiffness
  setup.solver.tolerance = 1e-6;
  Solved solved;
  solved.unknowns = unknowns_of(setup);
  const auto world = trial.make(std::move(setup));
  Curve ours{"p2, 10 cells"};
  MoveProbe probe;
  probe.radius = ball_radius;
  double at = 0;
  for (const auto& [depth, force] : depths) {
    probe.path = {Vec3(0, 0, ball_radius - at), Vec3(0, 0, ball_radius - depth)};
    probe.speed = depth - at;
    at = depth;
    const auto began = std::chrono::steady_clock::now();
    world->apply(probe);
    world->tick();
    solved.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    if (world->halt()) solved.failed = world->halt()->message;
    const double found = 4 * world->reactions()[0].z();
    ours.points.push_back({depth, found});
    finding.rows.push_back(row_of(solved, fmt::format("force at a depth of {} mm", 1e3 * depth), "N", found, force,
                                  "axisymmetric elements", 0.01, ours.name));
  }
  finding.curves.push_back(ours);
  return finding;
}

}  // namespace heml::validation
