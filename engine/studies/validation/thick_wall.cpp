// Thick-walled sphere and cylinder under inner pressure.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <studies/validation/body.hpp>
#include <studies/validation/references.hpp>

namespace heml::validation {
namespace {

constexpr double inner = 0.01, outer = 0.02, height = 0.02;  // m
constexpr double wall_shear = 4e3;                           // Pa
constexpr const char* source = "equation of balance along the radius, Runge-Kutta";

double radius_of(const Vec3& x, int directions) { return directions == 2 ? x.norm() : x.head<2>().norm(); }

/// Where the reference has a node.
Vec3 displaced(const RadialState& state, const Vec3& X, int directions) {
  const double R = radius_of(X, directions);
  const double place = (outer - R) / (outer - inner) * static_cast<double>(state.profile.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(std::max(place, 0.0)), state.profile.size() - 2);
  const double part = place - static_cast<double>(k);
  const double u = (1 - part) * state.profile[k][1] + part * state.profile[k + 1][1];
  return directions == 2 ? Vec3(u / R * X) : Vec3(u / R * X.x(), u / R * X.y(), 0);
}

WorldSetup body_of(const std::string& element, int n, double poisson, int directions) {
  const Material material = rubber(wall_shear, bulk_of(wall_shear, poisson));
  return directions == 2
             ? make_body(cubic_shell(n, n / 2, inner, outer), element, material, cube_to_sphere)
             : make_body(square_tube(n, n / 2, inner, outer, n, height), element, material, square_to_circle);
}

/// Against rigid motion three nodes outside of the sphere are held where the reference has them; of the cylinder all
/// nodes of both ends, which is plane strain.
void support(WorldSetup& setup, const RadialState& state, int directions) {
  const auto is_held = [&](const Vec3& X) {
    if (directions == 1) return X.z() < 1e-9 || X.z() > height - 1e-9;
    return std::abs(X.maxCoeff() - outer) < 1e-9;  // on an axis
  };
  for (const int node : nodes_where(setup, is_held))
    setup.boundary.push_back(
        moved(node, displaced(state, setup.mesh.nodes[static_cast<std::size_t>(node)], directions)));
}

/// Mean radial displacement of nodes of a radius at rest; of the cylinder at the middle of its height.
double mean_displacement(const WorldSetup& setup, const std::vector<Vec3>& x, double radius, int directions) {
  const auto nodes = nodes_where(setup, [&](const Vec3& X) {
    return std::abs(radius_of(X, directions) - radius) < 1e-9 &&
           (directions == 2 || std::abs(X.z() - height / 2) < 1e-9);
  });
  double sum = 0;
  for (const int n : nodes) sum += radius_of(x[static_cast<std::size_t>(n)], directions) - radius;
  return sum / static_cast<double>(nodes.size());
}

struct WallCase {
  const char* element;
  double poisson;
  double limit;
};
constexpr WallCase study_cases[] = {{"p1", 0.3, 0.1},
                                    {"nodal_pressure", 0.3, 0.1},
                                    {"p2", 0.3, 0.01},
                                    {"p1", 0.499, no_limit},
                                    {"nodal_pressure", 0.499, 0.1},
                                    {"p2", 0.499, no_limit},
                                    {"p2_pressure", 0.499, 0.01}};

Finding thick_wall(const Trial& trial, int directions) {
  Finding finding;
  RadialState state{};
  double solved_for = no_limit, drawn = no_limit;
  for (const auto& [element, poisson, limit] : study_cases) {
    // The inner wall is stretched by about a quarter.
    const double pressure = (directions == 2 ? 0.5 : 0.27) * wall_shear;
    const bool quadratic = is_quadratic(element);
    if (trial.quick && !(quadratic && limit > 0)) continue;
    if (poisson != solved_for)
      state = radial_state_under({{wall_shear, bulk_of(wall_shear, poisson)}, inner, outer, directions}, pressure);
    solved_for = poisson;
    WorldSetup setup = body_of(element, quadratic ? 4 : 8, poisson, directions);
    support(setup, state, directions);
    Load load;
    load.kind = Load::Kind::pressure;
    load.nodes = nodes_where(setup, [&](const Vec3& X) { return radius_of(X, directions) < inner + 1e-9; });
    load.pressure = pressure;
    setup.loads.push_back(load);
    const Solved solved = solve(trial, setup);
    const std::string method = fmt::format("{}, ν {}", element, poisson);
    const auto add = [&, most = limit](const char* where, double radius, double reference) {
      finding.rows.push_back(row_of(solved, fmt::format("displacement of the {} wall", where), "m",
                                    mean_displacement(setup, solved.x, radius, directions), reference, source, most,
                                    method));
    };
    add("inner", inner, state.inner - inner);
    add("outer", outer, state.outer - outer);
    if (!quadratic) continue;
    Curve exact{fmt::format("exact, ν {}", poisson), true, state.profile}, ours{method};
    for (const int n :
         nodes_where(setup, [&](const Vec3& X) { return X.z() > height / 2 - 1e-9 || directions == 2; })) {
      const double R = radius_of(setup.mesh.nodes[static_cast<std::size_t>(n)], directions);
      ours.points.push_back({R, radius_of(solved.x[static_cast<std::size_t>(n)], directions) - R});
    }
    if (poisson != drawn) finding.curves.push_back(exact);
    drawn = poisson;
    finding.curves.push_back(ours);
  }
  return finding;
}

}  // namespace

Finding thick_sphere(const Trial& trial) { return thick_wall(trial, 2); }
Finding thick_cylinder(const Trial& trial) { return thick_wall(trial, 1); }

}  // namespace heml::validation
