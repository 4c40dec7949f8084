// The ventricle of Land et al. 2015, problem 2: a truncated ellipsoid.
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <studies/validation/body.hpp>

namespace heml::validation {
namespace {

constexpr double cavity_pressure = 10e3;  // Pa
// A point of the wall: t from 0 inside to 1 outside, s from 0 at the apex to 1 at the base, azimuth v.
constexpr double cap = 0.3;  // s where the bottom of the cup meets the middle of its sides

Vec3 wall_point(double t, double s, double v) {
  const double across = (7 + 3 * t) * 1e-3, along = (17 + 3 * t) * 1e-3, base = 5e-3;
  const double u = std::numbers::pi + s * (std::acos(base / along) - std::numbers::pi);
  return {across * std::sin(u) * std::cos(v), across * std::sin(u) * std::sin(v), along * std::cos(u)};
}

/// A cup of cubes of radii 1 to 2 to the wall. The bottom is mapped as a side of a cube to a sphere; storeys of the
/// sides are equal parts of the way from it to the base.
Vec3 cup_to_wall(const Vec3& x) {
  const double radius = x.cwiseAbs().maxCoeff();
  const Vec3 side = x / radius;
  const Vec3 bottom = cube_to_sphere(Vec3(side.x(), side.y(), -1));
  const double from = cap * std::acos(-bottom.z()) / (std::numbers::pi / 4), up = (side.z() + 1) / 2;
  return wall_point(radius - 1, from + (1 - from) * up, std::atan2(bottom.y(), bottom.x()));
}

WorldSetup ventricle(const std::string& element, int n) {
  Material material;
  material.law = "guccione";
  material.parameters = {10e3, 1, 1, 1, 5e6};
  material.fibre = Vec3::UnitZ();
  WorldSetup setup = make_body(cubic_cup(n, 3 * n / 2, (n + 1) / 3, 1, 2), element, material, cup_to_wall);
  Boundary base;
  base.nodes = nodes_where(setup, [](const Vec3& X) { return X.z() > 5e-3 - 1e-9; });
  setup.boundary = {base};
  Load load;
  load.kind = Load::Kind::pressure;
  load.nodes = nodes_where(setup, [](const Vec3& X) {
    return X.head<2>().squaredNorm() / 49e-6 + X.z() * X.z() / 289e-6 < 1 + 1e-9;
  });
  load.pressure = cavity_pressure;
  setup.loads = {load};
  return setup;
}

}  // namespace

Finding land_ventricle(const Trial& trial) {
  Finding finding;
  struct Case {
    const char* element;
    int cells;
    double limit;
    bool quick;
  };
  constexpr Case cases[] = {{"p2_pressure", 4, 0.01, true}, {"p2_pressure", 6, 0.01, false}};
  for (const auto& [element, cells, limit, quick] : cases) {
    if (trial.quick && !quick) continue;
    const WorldSetup setup = ventricle(element, cells);
    const Solved solved = solve(trial, setup);
    const auto apex = carried(setup, solved.x, {wall_point(0, 0, 0), wall_point(1, 0, 0)});
    finding.rows.push_back(row_of(solved, fmt::format("z of the apex inside, {} cells a side", cells), "m", apex[0].z(),
                                  -26.6e-3, "Land et al. 2015, figure 6", limit, element));
    finding.rows.push_back(row_of(solved, fmt::format("z of the apex outside, {} cells a side", cells), "m",
                                  apex[1].z(), -28.3e-3, "Land et al. 2015, figure 6", limit, element));
  }
  return finding;
}

}  // namespace heml::validation
