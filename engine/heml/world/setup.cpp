#include <fmt/format.h>

#include <algorithm>
#include <heml/base/error.hpp>
#include <heml/world/setup.hpp>
#include <limits>

namespace heml {
namespace {

/// Returns whether that is a change.
bool use_double(SolverSettings& solver) {
  if (!solver.single_precision) return false;
  solver.tolerance = solver.relative_tolerance();
  solver.single_precision = false;
  return true;
}

}  // namespace

bool fits_single_precision(const WorldSetup& setup) {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  double farthest = 0;
  for (const Vec3& X : setup.mesh.nodes) {
    low = low.cwiseMin(X);
    high = high.cwiseMax(X);
    farthest = std::max(farthest, X.cwiseAbs().maxCoeff());
  }
  for (const Vec3& x : setup.initial_positions) farthest = std::max(farthest, x.cwiseAbs().maxCoeff());
  return setup.mesh.nodes.empty() || farthest <= 32 * (high - low).norm();
}

bool use_double_far_away(WorldSetup& setup) { return !fits_single_precision(setup) && use_double(setup.solver); }

bool use_double_for_memory(WorldSetup& setup) {
  return setup.solver.integrator == Integrator::static_equilibrium &&
         std::any_of(setup.materials.begin(), setup.materials.end(),
                     [](const RegionMaterial& entry) { return entry.material.has_internal_state(); }) &&
         use_double(setup.solver);
}

int material_of_region(int region, const std::vector<RegionMaterial>& materials) {
  int fallback = -1;
  for (std::size_t m = 0; m < materials.size(); ++m) {
    if (materials[m].region == region) return static_cast<int>(m);
    if (!materials[m].region) fallback = static_cast<int>(m);
  }
  return fallback;
}

std::vector<int> material_of_elements(const TetMesh& mesh, const std::vector<RegionMaterial>& materials,
                                      const std::string& file) {
  const std::string& source = file.empty() ? mesh.source : file;
  for (std::size_t m = 0; m < materials.size(); ++m)
    for (std::size_t other = 0; other < m; ++other)
      if (materials[other].region == materials[m].region)
        throw InputError(source, fmt::format("materials[{}]", m),
                         materials[m].region ? fmt::format("a second entry for region {}", *materials[m].region)
                                             : std::string("a second entry without region"),
                         fmt::format("the first is materials[{}]: one entry a region", other));
  std::vector<int> result(mesh.tets.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    result[t] = material_of_region(mesh.regions[t], materials);
    if (result[t] < 0)
      throw InputError(
          source, "materials",
          fmt::format("region {} (element {}) has no material and there is no default", mesh.regions[t], t),
          fmt::format("add an entry without 'region', or one with \"region\": {}", mesh.regions[t]));
  }
  return result;
}

}  // namespace heml
