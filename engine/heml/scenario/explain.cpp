#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <heml/scenario/explain.hpp>
#include <heml/scenario/load_mesh.hpp>
#include <map>

namespace heml {
namespace {

using Clock = std::chrono::steady_clock;

/// Returns work() and adds its wall time to `startup`.
template <class Work>
auto timed(std::vector<StartupWork>& startup, std::string what, const Work& work) {
  const auto begin = Clock::now();
  auto result = work();
  startup.push_back({std::move(what), std::chrono::duration<double>(Clock::now() - begin).count()});
  return result;
}

const char* mesh_work(const MeshSpec& mesh) {
  if (!mesh.surface.empty()) return "surface read and filled with tetrahedra";
  if (!mesh.labels.empty()) return "label map read and meshed";
  return mesh.box ? "mesh generated" : "mesh read";
}

std::string law_detail(const Material& material, const SolverSettings& solver) {
  const LawInfo& law = *find_law(material.law);
  std::string detail(law.name);
  if (law.name == "energy") return fmt::format("{}: {}", detail, law.formula);
  if (!law.has_volume_term) return detail;
  if ((solver.nodal_pressure && !solver.quadratic) || material.volume_term != VolumeTerm::quadratic)
    return detail + ", its isochoric part";
  return detail + " with its volume term";
}

std::vector<TermFacts> terms_of(const Material& material, const SolverSettings& solver) {
  std::vector<TermFacts> terms;
  if (!find_law(material.law)->is_continuum) return {{"springs", "along the edges of the mesh"}};
  terms.push_back({"law", law_detail(material, solver)});
  const std::string volume(volume_term_names()[static_cast<std::size_t>(material.volume_term)]);
  const bool nodal_pressure = solver.nodal_pressure && !solver.quadratic;
  if (solver.nodal_pressure && solver.quadratic)
    terms.push_back({"mean_dilatation", volume +
                                            " volume term of the mean ratio of each element, past what ν = 0.3 has: "
                                            "a pass"});
  if (nodal_pressure)
    terms.push_back({"nodal_pressure", volume + " volume term of the mean ratio round each node: two more passes"});
  if (!nodal_pressure && material.volume_term != VolumeTerm::quadratic)
    terms.push_back({"volume_term", volume + ": a second pass"});
  if (material.active_stress > 0)
    terms.push_back({"active_stress", fmt::format("{:.4g} Pa along the fibre", material.active_stress)});
  if (material.viscosity > 0 || material.bulk_viscosity > 0)
    terms.push_back(
        {"viscosity", fmt::format("{:.4g} Pa s, bulk {:.4g} Pa s", material.viscosity, material.bulk_viscosity)});
  if (!material.relaxation.empty())
    terms.push_back({"relaxation", fmt::format("Prony series of {}", material.relaxation.size())});
  if (material.plasticity)
    terms.push_back({"plasticity", fmt::format("from {:.4g} Pa on, after each step", material.plasticity->yield)});
  return terms;
}

std::array<Vec3, 4> corners(const TetMesh& mesh, std::size_t tet) {
  std::array<Vec3, 4> x;
  for (std::size_t c = 0; c < 4; ++c) x[c] = mesh.nodes[static_cast<std::size_t>(mesh.tets[tet][c])];
  return x;
}

std::vector<RegionFacts> regions_of(const TetMesh& mesh) {
  std::map<int, RegionFacts> regions;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    RegionFacts& region = regions[mesh.regions[t]];
    const std::array<Vec3, 4> x = corners(mesh, t);
    ++region.tets;
    region.volume += signed_volume(x[0], x[1], x[2], x[3]);
  }
  std::vector<RegionFacts> result;
  for (auto& [number, region] : regions) {
    const auto name = mesh.region_names.find(number);
    region.number = number;
    if (name != mesh.region_names.end()) region.name = name->second;
    result.push_back(std::move(region));
  }
  return result;
}

std::vector<MaterialFacts> materials_of(const WorldSetup& setup, const WorldFacts& facts) {
  std::vector<MaterialFacts> result;
  for (const KernelInfo& kernel : facts.kernels) {
    const RegionMaterial& entry = setup.materials[kernel.material];
    MaterialFacts material{entry.region,
                           kernel,
                           terms_of(entry.material, setup.solver),
                           entry.material.density,
                           small_strain_moduli(entry.material),
                           0};
    const auto [shear, bulk] = material.rest;
    if (shear > 0) material.poisson = (3 * bulk - 2 * shear) / (2 * (3 * bulk + shear));
    result.push_back(std::move(material));
  }
  return result;
}

/// The material of an element, as material_of_elements() assigns it. Every element must have one.
const Material& material_at(const WorldSetup& setup, std::size_t tet) {
  const auto entry_of = [&](std::optional<int> region) {
    return std::find_if(setup.materials.begin(), setup.materials.end(),
                        [&](const RegionMaterial& entry) { return entry.region == region; });
  };
  const auto own = entry_of(setup.mesh.regions[tet]);
  return (own != setup.materials.end() ? own : entry_of(std::nullopt))->material;
}

double min_height(const std::array<Vec3, 4>& x) {
  double largest = 0;  // twice a face's area
  for (std::size_t f = 0; f < 4; ++f) {
    const Vec3 &a = x[(f + 1) % 4], &b = x[(f + 2) % 4], &c = x[(f + 3) % 4];
    largest = std::max(largest, (b - a).cross(c - a).norm());
  }
  return 6 * signed_volume(x[0], x[1], x[2], x[3]) / largest;
}

double wave_speed(const Material& material) {
  const auto [shear, bulk] = small_strain_moduli(material);
  return std::sqrt((bulk + 4 * shear / 3) / material.density);
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

constexpr double stands_out = 4;  // times the median node's bound of ω²: half its stable step
constexpr double flat_degrees = 15;

LimitFacts limit_of(const WorldSetup& setup, const StepFacts& step) {
  LimitFacts limit;
  limit.element = step.element;
  if (step.element < 0) return limit;
  std::vector<double> heights, speeds;
  for (std::size_t t = 0; t < setup.mesh.tets.size(); ++t) {
    heights.push_back(min_height(corners(setup.mesh, t)));
    speeds.push_back(wave_speed(material_at(setup, t)));
  }
  const auto own = static_cast<std::size_t>(step.element);
  limit.dihedral = min_dihedral(corners(setup.mesh, own));
  limit.height = heights[own];
  limit.wave_speed = speeds[own];
  limit.median_height = median(std::move(heights));
  limit.median_wave_speed = median(std::move(speeds));
  if (step.median_ratio < stands_out) return limit;
  if (limit.wave_speed / limit.median_wave_speed > limit.median_height / limit.height)
    limit.cause = LimitFacts::Cause::stiff;
  else
    limit.cause = limit.dihedral < flat_degrees ? LimitFacts::Cause::sliver : LimitFacts::Cause::small;
  return limit;
}

}  // namespace

const char* name_of(LimitFacts::Cause cause) {
  constexpr const char* names[] = {"none", "sliver", "small", "stiff"};
  return names[static_cast<std::size_t>(cause)];
}

Explanation explain(const Scene& scene) {
  Explanation result;
  MidEdges midedges;
  TetMesh mesh = timed(result.startup, mesh_work(scene.mesh), [&] { return load_mesh(scene, &midedges); });
  const char* resolved = scene.mesh.refine ? "selections and fields resolved, mesh refined where it errs"
                                           : "selections and fields resolved";
  result.setup =
      timed(result.startup, resolved, [&] { return load_setup(scene, std::move(mesh), std::move(midedges)); });
  const WorldSetup& setup = result.setup;
  const bool chooses = setup.solver.integrator == Integrator::automatic;
  const auto world = timed(
      result.startup,
      fmt::format("mesh reordered, elements laid out, first forces, {}", chooses ? "method chosen" : "stable step"),
      [&] { return make_world(setup); });
  result.world = timed(result.startup, "matrix factored, lowest frequency found", [&] { return world->facts(); });
  if (chooses || !result.world.solver) result.startup.pop_back();
  result.file = scene.file;
  result.name = scene.name;
  result.chosen = scene.chosen;
  TetMesh checked = setup.mesh;
  MidEdges checked_midedges = setup.midedges;
  result.quality = check_tets(checked, &checked_midedges);
  result.regions = regions_of(setup.mesh);
  result.materials = materials_of(setup, result.world);
  result.limit = limit_of(setup, result.world.step);
  result.tools = tools_of(scene, setup);
  result.omitted_features = omitted_features_of(scene, setup, result.world);
  result.advice = advice_on(result);
  if (world->halt()) result.advice.push_back({"halted", world->halt()->message, "no step can be taken"});
  return result;
}

}  // namespace heml
