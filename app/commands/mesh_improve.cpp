// `heml mesh --improve`: better shapes, with a line of JSON before and after.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <app/commands/mesh_improve.hpp>
#include <app/commands/progress.hpp>
#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/materials/material.hpp>
#include <heml/mesh/improve/improve.hpp>
#include <heml/mesh/quality.hpp>
#include <heml/scenario/json_text.hpp>
#include <heml/world/setup.hpp>
#include <heml/world/world.hpp>

namespace heml {
namespace {

constexpr std::size_t max_listed = 20;

std::array<Vec3, 4> corners_of(const TetMesh& mesh, int t) {
  const Tet& tet = mesh.tets[static_cast<std::size_t>(t)];
  return {mesh.nodes[tet[0]], mesh.nodes[tet[1]], mesh.nodes[tet[2]], mesh.nodes[tet[3]]};
}

/// The stable step of explicit methods at rest, s, of soft tissue: 10 kPa, ν 0.45, 1000 kg/m³. The mesh: as
/// check_tets() leaves it.
double explicit_step(const TetMesh& mesh) {
  const LameParameters lame = lame_parameters(1e4, 0.45);
  WorldSetup setup;
  setup.mesh = mesh;
  setup.mesh.fields.clear();
  Material tissue;
  tissue.law = "neo_hookean";
  tissue.parameters = {lame.lambda, lame.mu};
  setup.materials = {{std::nullopt, tissue}};
  return make_world(std::move(setup))->stable_step();
}

/// Elements without volume count as slivers with a step of 0.
void print_measures(const char* stage, TetMesh mesh, double surface_distance) {
  Json line = {{"stage", stage}, {"tets", mesh.tets.size()}};
  int slivers = 0;
  double smallest = 180;
  for (int t = 0; t < static_cast<int>(mesh.tets.size()); ++t) {
    const double angle = min_dihedral(corners_of(mesh, t));
    smallest = std::min(smallest, angle);
    slivers += angle < 5;
  }
  double step = 0;
  try {
    check_tets(mesh);
    step = explicit_step(mesh);
  } catch (const InputError&) {  // of a flat element, which improving mends
  }
  line["min_dihedral_deg"] = smallest;
  line["slivers"] = slivers;
  line["explicit_step_s"] = step;
  line["surface_distance_m"] = surface_distance;
  fmt::print("{}\n", json_text(line, ""));
}

void warn_of_remaining(const Improvement& improved, const MeshArguments& arguments) {
  if (improved.untangled > 0) log_info("{} inverted or flat elements were untangled", improved.untangled);
  const std::size_t count = improved.below.size();
  if (count > 0) {
    std::vector<std::string> listed;
    for (std::size_t k = 0; k < std::min(count, max_listed); ++k)
      listed.push_back(
          fmt::format("{} ({:.3g}°)", improved.below[k], min_dihedral(corners_of(improved.mesh, improved.below[k]))));
    warn("{} element{} below {:g}° left, where the surface allows no more within {:.3g} m: {}{}", count,
         count == 1 ? "" : "s", arguments.min_angle.value_or(default_min_angle), improved.surface_tolerance,
         fmt::join(listed, ", "), count > max_listed ? ", ..." : "");
  }
  if (arguments.tets &&
      std::abs(static_cast<double>(improved.mesh.tets.size()) - *arguments.tets) > 0.25 * *arguments.tets)
    warn("{} tetrahedra instead of {}: {}", improved.mesh.tets.size(), *arguments.tets,
         "the surface cannot be kept with fewer (--tolerance allows more)");
}

}  // namespace

TetMesh improve_and_print(const TetMesh& mesh, const MeshArguments& arguments) {
  check_connectivity(mesh);
  print_measures("before", mesh, 0);
  Progress progress("improving the mesh");
  ImproveOptions options;
  options.min_angle = arguments.min_angle.value_or(default_min_angle);
  options.tets = arguments.tets;
  options.surface_tolerance = arguments.tolerance;
  options.progress = [&](double fraction, const char* doing) { progress.show(fraction, doing); };
  Improvement improved = improve(mesh, options);
  print_measures("after", improved.mesh, improved.surface_distance);
  warn_of_remaining(improved, arguments);
  log_info("the surface was kept within {:.3g} m, {:.3g} m allowed", improved.surface_distance,
           improved.surface_tolerance);
  return std::move(improved.mesh);
}

}  // namespace heml
