// Large deflection of a slender cantilever under a dead load across its end.
#include <fmt/format.h>

#include <heml/mesh/generate.hpp>
#include <studies/validation/body.hpp>
#include <studies/validation/references.hpp>

namespace heml::validation {
namespace {

constexpr double length = 1, depth = 0.01, young = 1e6;  // m, m, Pa; Poisson's ratio 0, as a line has no_limit

Material wire() {
  Material material;
  material.law = "stvk";
  material.parameters = {0, young / 2};
  return material;
}

/// Mean displacement of the loaded end.
Vec3 mean_of_end(const WorldSetup& setup, const Solved& solved) {
  Vec3 sum = Vec3::Zero();
  const auto& nodes = setup.loads[0].nodes;
  for (const int n : nodes) sum += solved.x[static_cast<std::size_t>(n)];
  return sum / static_cast<double>(nodes.size()) - Vec3(length, depth / 2, depth / 2);
}

void add_beam(Finding& finding, const Trial& trial, const std::string& element, int cells, int across, double load,
              double limit) {
  const Elastica exact = elastica_of(load);
  WorldSetup setup = make_body(make_box(Vec3(length, depth, depth), {cells, across, across}), element, wire());
  Boundary clamp;
  clamp.nodes = nodes_where(setup, [](const Vec3& X) { return X.x() < 1e-9; });
  setup.boundary = {clamp};
  Load end;
  end.nodes = nodes_where(setup, [](const Vec3& X) { return X.x() > length - 1e-9; });
  end.vector = Vec3(0, load * young * depth * depth * depth * depth / 12 / (length * length), 0);
  setup.loads = {end};
  const Solved solved = solve(trial, setup, 1e-7);  // round-off of a slender beam
  const Vec3 u = mean_of_end(setup, solved);
  const std::string method = fmt::format("{}, {} × {} × {} cells", element, cells, across, across);
  const auto row = [&](const char* way, double ours, double reference) {
    finding.rows.push_back(row_of(solved, fmt::format("deflection {} at F L²/EI = {}", way, load), "m", ours, reference,
                                  "elastica, Runge-Kutta; Bisshopp & Drucker 1945", limit, method));
  };
  row("across", u.y(), exact.across * length);
  row("along", -u.x(), (1 - exact.along) * length);
  if (!is_quadratic(element)) return;
  finding.curves.push_back({fmt::format("F L²/EI = {}, exact", load), true, exact.shape});
  Curve ours{fmt::format("{}, {}", element, load)};
  for (const int n : nodes_where(setup, [](const Vec3& X) { return X.y() < 1e-9 && X.z() < 1e-9; }))
    ours.points.push_back({solved.x[static_cast<std::size_t>(n)].x(), solved.x[static_cast<std::size_t>(n)].y()});
  finding.curves.push_back(ours);
}

}  // namespace

Finding elastica(const Trial& trial) {
  Finding finding;
  const int cells = trial.quick ? 30 : 60;
  for (const double load : {1.0, 2.0, 5.0})
    if (!trial.quick || load == 2) add_beam(finding, trial, "p2", cells, 1, load, 0.01);
  if (!trial.quick) add_beam(finding, trial, "p1", 2 * cells, 1, 2, no_limit);
  return finding;
}

}  // namespace heml::validation
