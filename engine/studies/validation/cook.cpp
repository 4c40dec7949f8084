// Cook's membrane at finite strain.
#include <fmt/format.h>

#include <cmath>
#include <heml/mesh/generate.hpp>
#include <studies/validation/body.hpp>

namespace heml::validation {
namespace {

constexpr double thickness = 0.01, cook_shear = 4e3, end_force = 0.02;  // m, Pa, N

/// The unit square to the membrane, 48 mm wide, 44 mm high at the clamp and 16 mm at the loaded end.
Vec3 membrane(const Vec3& x) { return {0.048 * x.x(), 0.044 * x.x() + x.y() * (0.044 - 0.028 * x.x()), x.z()}; }

void add_membrane(Finding& finding, const Trial& trial, const std::string& element, double poisson, double reference,
                  int cells, double limit) {
  WorldSetup setup = make_body(make_box(Vec3(1, 1, thickness), {cells, cells, cells / 2}), element,
                               rubber(cook_shear, bulk_of(cook_shear, poisson)), membrane);
  Boundary clamp;
  clamp.nodes = nodes_where(setup, [](const Vec3& X) { return X.x() < 1e-9; });
  setup.boundary = {clamp};
  Load end;
  end.kind = Load::Kind::traction;
  end.nodes = nodes_where(setup, [](const Vec3& X) { return X.x() > 0.048 - 1e-9; });
  end.vector = Vec3(0, end_force / (0.016 * thickness), 0);
  setup.loads = {end};
  const Solved solved = solve(trial, setup);
  const auto corner =
      nodes_where(setup, [](const Vec3& X) { return (X - Vec3(0.048, 0.06, thickness / 2)).norm() < 1e-9; });
  const double up = solved.x[static_cast<std::size_t>(corner.at(0))].y() - 0.06;
  const std::string method = fmt::format("{}, ν {}", element, poisson);
  finding.rows.push_back(row_of(solved, fmt::format("upper corner, {} cells a side", cells), "m", up, reference,
                                "CalculiX, 20-node hexahedra (C3D20), extrapolated", limit, method));
  if (finding.curves.empty() || finding.curves.back().name != method) finding.curves.push_back({method});
  finding.curves.back().points.push_back({static_cast<double>(solved.unknowns), up});
}

struct CookCase {
  const char* element;
  double poisson, reference;  ///< m, of the upper corner at half the thickness
  int from;                   ///< cells a side of the coarsest mesh, doubled to the finest
  double limit;               ///< of the finest of the full study
};

}  // namespace

Finding cook_membrane(const Trial& trial) {
  constexpr double soft = 4.336e-3, stiff = 3.806e-3;  // m, assets/make/cook_reference.py
  constexpr CookCase cases[] = {{"p1", 0.3, soft, 4, no_limit},    {"p2", 0.3, soft, 2, 0.02},
                                {"p1", 0.499, stiff, 4, no_limit}, {"nodal_pressure", 0.499, stiff, 4, no_limit},
                                {"p2", 0.499, stiff, 2, no_limit}, {"p2_pressure", 0.499, stiff, 2, 0.02}};
  Finding finding;
  double drawn = 0;
  for (const auto& [element, poisson, reference, from, limit] : cases) {
    if (trial.quick && std::isnan(limit)) continue;
    if (reference != drawn)
      finding.curves.push_back({fmt::format("CalculiX, ν {}", poisson), true, {{100, reference}, {8e3, reference}}});
    drawn = reference;
    for (int k = 0; k < 3; ++k)
      add_membrane(finding, trial, element, poisson, reference, from << k, k == 2 ? limit : no_limit);
  }
  return finding;
}

}  // namespace heml::validation
