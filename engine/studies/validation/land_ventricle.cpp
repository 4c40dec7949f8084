// The ventricle of Land et al. 2015, problem 2: a truncated ellipsoid, blown up.
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <studies/validation/body.hpp>

namespace heml::validation {
namespace {

constexpr double cavity_pressure = 10e3, bulk = 1e6, base = 5e-3;  // Pa, Pa, m
constexpr double cap = 0.3;  // s of the wall where the bottom of the cup meets the middle of its sides
constexpr const char* element = "p2_pressure";
constexpr int load_parts = 16;
constexpr std::size_t stations = 10;

// Land et al. 2015, figure 6, as others quote it: z of the apex, m, to about 0.2 mm.
constexpr double apex_inside = -26.6e-3, apex_outside = -28.3e-3;
// Figure 8, middle of the wall, %: rounded readings by the authors of TorchCor (github.com/sagebei/torchcor).
struct Reading {
  const char* direction;
  std::array<double, stations> strain;
};
constexpr Reading readings[] = {{"around the axis", {35, 40, 46, 51, 54, 57, 58, 57, 47, 20}},
                                {"across the wall", {-43, -40, -34, -31, -31, -33, -38, -42, -44, -24}}};
constexpr std::size_t middle = 5;  // station whose strain is a row

/// A point of the wall at rest: t from 0 inside to 1 outside, s from 0 at the apex to 1 at the base, azimuth v.
Vec3 wall_point(double t, double s, double v) {
  const double across = (7 + 3 * t) * 1e-3, along = (17 + 3 * t) * 1e-3;
  const double u = std::numbers::pi + s * (std::acos(base / along) - std::numbers::pi);
  return {across * std::sin(u) * std::cos(v), across * std::sin(u) * std::sin(v), along * std::cos(u)};
}

/// A cup of cubes of radii 1 to 2 to the wall. Its bottom is mapped as a side of a cube to a sphere; storeys of its
/// sides are equal parts of the way from there to the base.
Vec3 cup_to_wall(const Vec3& x) {
  const double radius = x.cwiseAbs().maxCoeff();
  const Vec3 side = x / radius;
  const Vec3 bottom = cube_to_sphere(Vec3(side.x(), side.y(), -1));
  const double from = cap * std::acos(-bottom.z()) / (std::numbers::pi / 4), up = (side.z() + 1) / 2;
  return wall_point(radius - 1, from + (1 - from) * up, std::atan2(bottom.y(), bottom.x()));
}

Material muscle(double bulk_modulus) {
  Material material;
  material.law = "guccione";
  material.parameters = {10e3, 1, 1, 1, bulk_modulus};
  material.fibre = Vec3::UnitZ();
  return material;
}

WorldSetup ventricle(int cells, int layers, double bulk_modulus) {
  WorldSetup setup =
      make_body(cubic_cup(cells, 3 * cells / 2, layers, 1, 2), element, muscle(bulk_modulus), cup_to_wall);
  Boundary held;
  held.nodes = nodes_where(setup, [](const Vec3& X) { return X.z() > base - 1e-9; });
  setup.boundary = {held};
  Load load;
  load.kind = Load::Kind::pressure;
  load.nodes = nodes_where(setup, [](const Vec3& X) {
    return X.head<2>().squaredNorm() / 49e-6 + X.z() * X.z() / 289e-6 < 1 + 1e-9;
  });
  load.pressure = cavity_pressure;
  setup.loads = {load};
  return setup;
}

/// Changes of distances between material points, % (Land et al. 2015, equation 3.1): in the middle of the wall to a
/// neighbour 18° round the axis, and from nine tenths of the wall to a tenth, at stations from apex to base.
std::array<std::array<double, stations>, 2> strains(const WorldSetup& setup, const std::vector<Vec3>& x) {
  std::vector<Vec3> points;
  for (std::size_t k = 1; k <= stations; ++k) {
    const double s = 0.095 * static_cast<double>(k);
    for (const double v : {0.0, std::numbers::pi / 10}) points.push_back(wall_point(0.5, s, v));
    for (const double t : {0.1, 0.9}) points.push_back(wall_point(t, s, 0));
  }
  const std::vector<Vec3> now = carried(setup, x, points);
  std::array<std::array<double, stations>, 2> result{};
  for (std::size_t k = 0; k < stations; ++k)
    for (std::size_t pair = 0; pair < 2; ++pair) {
      const std::size_t at = 4 * k + 2 * pair;
      result[pair][k] = 100 * ((now[at] - now[at + 1]).norm() / (points[at] - points[at + 1]).norm() - 1);
    }
  return result;
}

/// The limit κ → ∞ of two solutions with κ and 2κ: what a finite κ adds falls with 1/κ.
Solved incompressible(const Solved& soft, Solved stiff) {
  for (std::size_t n = 0; n < stiff.x.size(); ++n) stiff.x[n] = 2 * stiff.x[n] - soft.x[n];
  stiff.seconds += soft.seconds;
  if (!soft.failed.empty()) stiff.failed = soft.failed;
  return stiff;
}

struct VentricleCase {
  int cells, layers;   ///< along a side of the bottom, through the wall
  double most_strain;  ///< limit, relative
  bool quick, drawn;
};
constexpr double apex_limit = 0.01, strain_limit = 0.05;  // strains are read to 2 in 57 and 33

}  // namespace

Finding land_ventricle(const Trial& trial) {
  constexpr VentricleCase cases[] = {{4, 2, no_limit, true, false}, {6, 2, strain_limit, false, true}};
  Finding finding;
  for (const auto& [cells, layers, most_strain, quick, drawn] : cases) {
    if (trial.quick && !quick) continue;
    const WorldSetup setup = ventricle(cells, layers, bulk);
    const Solved solved = incompressible(solve(trial, setup, 1e-8, load_parts),
                                         solve(trial, ventricle(cells, layers, 2 * bulk), 1e-8, load_parts));
    const std::string method = fmt::format("{}, {} in the wall, incompressible", element, layers);
    const auto add = [&](const std::string& what, const char* unit, double ours, double reference, const char* figure,
                         double limit) {
      finding.rows.push_back(row_of(solved, what, unit, ours, reference,
                                    fmt::format("Land et al. 2015, {}, as quoted", figure), limit, method));
    };
    const auto apex = carried(setup, solved.x, {wall_point(0, 0, 0), wall_point(1, 0, 0)});
    add("z of the apex inside", "m", apex[0].z(), apex_inside, "figure 6", apex_limit);
    add("z of the apex outside", "m", apex[1].z(), apex_outside, "figure 6", apex_limit);
    const auto strain = strains(setup, solved.x);
    for (std::size_t d = 0; d < std::size(readings); ++d) {
      const Reading& read = readings[d];
      add(fmt::format("strain {}, station 6", read.direction), "%", strain[d][middle], read.strain[middle], "figure 8",
          most_strain);
      if (!drawn && !trial.quick) continue;
      Curve reference{fmt::format("{}, figure 8", read.direction), true}, ours{method};
      for (std::size_t k = 0; k < stations; ++k) {
        reference.points.push_back({static_cast<double>(k + 1), read.strain[k]});
        ours.points.push_back({static_cast<double>(k + 1), strain[d][k]});
      }
      finding.curves.push_back(std::move(reference));
      finding.curves.push_back(std::move(ours));
    }
  }
  return finding;
}

}  // namespace heml::validation
