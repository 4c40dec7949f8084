// The beam of Land et al. 2015, problem 1.
#include <fmt/format.h>

#include <heml/mesh/generate.hpp>
#include <studies/validation/body.hpp>

namespace heml::validation {
namespace {

constexpr double length = 0.01, width = 0.001, bottom_pressure = 4;  // m, m, Pa
constexpr double consensus = 4.17e-3;  // m, of z at the point, as others quote Land et al. 2015

struct BeamCase {
  const char* element;
  int cells;     ///< across; five times as many along
  double limit;  ///< relative, of z at the point
  bool quick;
};

}  // namespace

Finding land_beam(const Trial& trial) {
  constexpr double bulk = 1e6;  // Pa, 250 times the shear modulus along the fibre
  constexpr BeamCase cases[] = {
      {"p2_pressure", 2, no_limit, false}, {"p2_pressure", 3, 0.01, true},
      {"p2_pressure", 4, 0.01, false},     {"p2", 4, no_limit, false}};
  Material muscle = heart_muscle({2e3, 8, 2, 4}, bulk);
  muscle.fibre = Vec3::UnitX();
  Finding finding;
  finding.curves.push_back({"consensus", true, {{500, consensus}, {2e4, consensus}}});
  for (const auto& [element, cells, limit, quick] : cases) {
    if (trial.quick && !quick) continue;
    WorldSetup setup = make_body(make_box(Vec3(length, width, width), {5 * cells, cells, cells}), element, muscle);
    Boundary clamp;
    clamp.nodes = nodes_where(setup, [](const Vec3& X) { return X.x() < 1e-9; });
    setup.boundary = {clamp};
    Load load;
    load.kind = Load::Kind::pressure;
    load.nodes = nodes_where(setup, [](const Vec3& X) { return X.z() < 1e-9; });
    load.pressure = bottom_pressure;
    setup.loads = {load};
    const Solved solved = solve(trial, setup, 1e-8, 8);
    const Vec3 end = carried(setup, solved.x, {Vec3(length, width / 2, width)}).front();
    finding.rows.push_back(row_of(solved, fmt::format("z of the point (10, 0.5, 1) mm, {} cells across", cells), "m",
                                  end.z(), consensus,
                                  "Land et al. 2015, figure 3, as quoted: between 4.15 and 4.19 mm", limit, element));
    if (finding.curves.back().name != element) finding.curves.push_back({element});
    finding.curves.back().points.push_back({static_cast<double>(solved.unknowns), end.z()});
  }
  return finding;
}

}  // namespace heml::validation
