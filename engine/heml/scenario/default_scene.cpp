// Default scenes: the one opened without arguments, and the one made for a bare mesh or surface.
#include <dlfcn.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/base/warning_collector.hpp>
#include <heml/mesh/quality.hpp>
#include <heml/mesh/read.hpp>
#include <heml/scenario/bare_mesh.hpp>
#include <heml/scenario/body_shape.hpp>
#include <heml/scenario/placement.hpp>
#include <heml/scenario/presets.hpp>
#include <heml/scenario/selection.hpp>
#include <heml/scenario/suitable_method.hpp>
#include <heml/scenario/take_mesh.hpp>
#include <set>

namespace heml {
namespace {

namespace fs = std::filesystem;

constexpr double supported_share = 0.12;  // of the surface
constexpr double table_friction = 0.5;
constexpr double max_stretch = 1.5;  // of a body under its own weight
constexpr double tissue_poisson = 0.45, tissue_density = 1000;
constexpr double mass_damping = 1;  // 1/s

/// Adds a choice and tells it: one that changes what the file says, or what is usual, as a warning.
void tell(Scene& scene, bool as_warning, const char* about, std::string text) {
  const std::string line = fmt::format("{}: {}", scene.file, text);
  if (as_warning)
    warn("{}", line);
  else
    log_info("{}", line);
  scene.chosen->texts.push_back({about, std::move(text)});
}

void tell_fineness(Scene& scene) {
  const BareMeshChoices& chosen = *scene.chosen;
  if (!chosen.given.tets) return;
  tell(scene, false, "fineness",
       fmt::format("{} tetrahedra where {} are wanted, as chosen; the smallest dihedral angle is {:.3g}°", chosen.tets,
                   *chosen.given.tets, chosen.min_dihedral));
}

void choose_unit(Scene& scene, double length) {
  const std::optional<LengthUnit>& given = scene.chosen->given.unit;
  if (!given && !scene.mesh.labels.empty()) {
    scene.chosen->unit = "metres";
    scene.chosen->length = length;
    return tell(scene, false, "unit", fmt::format("{:.3g} m long by the scan's header", length));
  }
  const LengthUnit unit = given ? *given : guess_unit(length);
  scene.mesh.scale = unit.scale;
  if (scene.mesh.max_volume) *scene.mesh.max_volume *= unit.scale * unit.scale * unit.scale;
  scene.chosen->unit = unit.name;
  scene.chosen->scale = unit.scale;
  scene.chosen->length = unit.scale * length;
  if (given)
    tell(scene, false, "unit",
         fmt::format("{}, as chosen: scaled by {:.6g}, {:.3g} m long",
                     unit.name.empty() ? "of no unit" : "read in " + unit.name, unit.scale, scene.chosen->length));
  else if (unit.name.empty())
    tell(scene, true, "unit",
         fmt::format("{:.3g} long, which is no organ's size in metres, centimetres or millimetres: scaled by {:.6g} to "
                     "{:.3g} m (mesh.scale of a scene file chooses)",
                     length, unit.scale, scene.chosen->length));
  else
    tell(scene, unit.scale != 1, "unit",
         fmt::format("read in {}: scaled by {:.6g}, {:.3g} m long", unit.name, unit.scale, scene.chosen->length));
}

void choose_up(Scene& scene, const TetMesh& mesh) {
  const std::optional<UpAxis>& given = scene.chosen->given.up;
  if (!given && !scene.mesh.labels.empty())
    return tell(scene, false, "up",
                "y points up, which is anterior: the patient lies on the back; x right, z superior");
  scene.chosen->up = given ? *given : guess_up(mesh, shape_of(mesh));
  const UpAxisInfo& up = info_of(scene.chosen->up);
  std::string text = fmt::format("{} points up{}", up.name, given ? ", as chosen" : "");
  if (up.degrees == 0) return tell(scene, false, "up", std::move(text));
  scene.mesh.rotate_axis = up.about;
  scene.mesh.rotate_degrees = up.degrees;
  if (!given) text += ", since the body has a flat base there";
  text += fmt::format(": turned by {} degrees about {}", up.degrees, up.about.x() != 0 ? 'x' : 'z');
  if (!given) text += " (mesh.rotate of a scene file chooses)";
  tell(scene, !given, "up", std::move(text));
}

void put_on_table(Scene& scene, const BodyShape& shape) {
  scene.tables.push_back({Vec3(0, shape.low.y(), 0), Vec3::UnitY(), table_friction});
  scene.chosen->supports = SupportKind::table;
  tell(scene, false, "supports", fmt::format("lies loose on a table, as chosen, with friction {}", table_friction));
}

void choose_supports(Scene& scene, const TetMesh& mesh) {
  const std::optional<SupportKind>& given = scene.chosen->given.supports;
  const BodyShape shape = shape_of(mesh);
  if (given == SupportKind::table) return put_on_table(scene, shape);
  const Support support = given ? support_at(given == SupportKind::top, mesh, shape, supported_share)
                                : choose_support(mesh, shape, supported_share);
  Vec3 low = shape.low - shape.size(), high = shape.high + shape.size();
  (support.top ? low : high).y() = support.height;
  scene.boundary.push_back({{{}, std::array{low, high}, std::nullopt}, {}});
  scene.chosen->supports = support.top ? SupportKind::top : SupportKind::underside;
  scene.chosen->supported_area = support.area;
  std::string text =
      support.top ? fmt::format("hangs from the top {:.0f} % of its surface", 100 * support.area)
                  : fmt::format("rests on the lowest {:.0f} % of its surface, which is held", 100 * support.area);
  if (given)
    text += ", as chosen";
  else if (support.top)
    text += ", since it would topple on its underside";
  tell(scene, false, "supports", std::move(text));
}

Material tissue_of(double young) {
  const LameParameters lame = lame_parameters(young, tissue_poisson);
  return {"neo_hookean", {lame.lambda, lame.mu}, tissue_density};
}

/// Whether a mesh file brings mid-edge nodes, whose places would change with the element.
bool brings_midedges(const Scene& scene) {
  if (scene.mesh.tets) return false;  // improved elements are straight
  MidEdges midedges;
  const WarningCollector warnings;  // the mesh has been read, and they have been told
  if (!scene.mesh.file.empty()) read_tet_mesh(scene.mesh.file, &midedges);
  return !midedges.empty();
}

void choose_element(Scene& scene, const TetMesh& mesh) {
  if (!affords_quadratic(mesh.tets.size()))
    return tell(scene, false, "element",
                fmt::format("linear elements (p1): a step of quadratic ones would take {:.2g} of real time at {} Hz",
                            seconds_per_iteration(mesh.tets.size(), true) * implicit_rates()[0], implicit_rates()[0]));
  if (brings_midedges(scene))
    return tell(scene, false, "element", "linear elements (p1) on the corners of the file's ten-node elements");
  scene.solver.quadratic = true;
  tell(scene, false, "element",
       "quadratic elements (p2), which err several times less than linear ones and are fast enough here");
}

/// Returns the trial run of a preset.
TrialRun take_preset(Scene& scene, const TetMesh& mesh, const std::string& name) {
  BareMeshChoices& chosen = *scene.chosen;
  const Preset* preset = find_preset(name);
  if (!preset)
    throw InputError(scene.file, "tissue", fmt::format("there is no preset '{}'", name),
                     "a file of assets/materials, without .json");
  Material tissue = preset->material;
  tissue.density = chosen.density = tissue_density;
  const auto [shear, bulk] = small_strain_moduli(tissue);
  chosen.young = 9 * bulk * shear / (3 * bulk + shear);
  chosen.poisson = (3 * bulk - 2 * shear) / (2 * (3 * bulk + shear));
  scene.materials = {{std::nullopt, tissue}};
  TrialRun run = try_tissue(load_setup(scene, mesh));
  chosen.stretch = run.stretch;
  const bool is_soft = run.stretch > max_stretch;
  tell(scene, is_soft, "tissue",
       fmt::format("{}, as chosen: {}", preset->title,
                   std::isfinite(run.stretch) ? fmt::format("stretches to {:.3g} at most under its weight", run.stretch)
                                              : std::string("does not hold under its weight")));
  return run;
}

/// Returns the trial run of the tissue chosen. Linear elements go first: they are fast, and what is too soft with them
/// is so with quadratic ones, which bend more.
TrialRun choose_tissue(Scene& scene, const TetMesh& mesh) {
  BareMeshChoices& chosen = *scene.chosen;
  if (chosen.given.tissue) return take_preset(scene, mesh, *chosen.given.tissue);
  chosen.poisson = tissue_poisson;
  chosen.density = tissue_density;
  TrialRun run;
  double soft_stretch = 0;
  for (const double young : tissue_moduli()) {
    chosen.young = young;
    scene.materials = {{std::nullopt, tissue_of(young)}};
    Scene linear = scene;
    linear.solver.quadratic = false;
    run = try_tissue(load_setup(linear, mesh));
    if (run.stretch <= max_stretch && scene.solver.quadratic) run = try_tissue(load_setup(scene, mesh));
    if (run.stretch <= max_stretch) break;
    if (soft_stretch == 0) soft_stretch = run.stretch;
  }
  chosen.stretch = run.stretch;
  const std::string tissue =
      fmt::format("soft tissue of {:.3g} kPa, Poisson's ratio {}", chosen.young / 1e3, tissue_poisson);
  const std::string stretch = fmt::format("stretches to {:.3g} at most under its weight", run.stretch);
  if (soft_stretch == 0)
    tell(scene, false, "tissue", tissue + ": " + stretch);
  else
    tell(scene, true, "tissue",
         fmt::format("{}: {}; of {:.3g} kPa it would stretch to {:.3g}", tissue, stretch, tissue_moduli()[0] / 1e3,
                     soft_stretch));
  return run;
}

/// Each label of a scan, and each region where a file names one, gets a material of its own, to be changed by itself.
void split_materials(Scene& scene, const TetMesh& mesh) {
  const std::set<int> regions(mesh.regions.begin(), mesh.regions.end());
  if ((scene.mesh.labels.empty() && mesh.region_names.empty()) || regions.size() < 2) return;
  const Material tissue = scene.materials.front().material;
  scene.materials.clear();
  for (const int region : regions) scene.materials.push_back({region, tissue});
}

void choose_method(Scene& scene, const TetMesh& mesh, const ExplicitCost& cost) {
  const SuitableMethod method = suitable_method(mesh.tets.size(), cost, scene.solver.quadratic);
  adopt(method, scene.solver);
  scene.chosen->load = method.load;
  const std::string takes = fmt::format("{:.2g} of real time on one core by the cost model", method.load);
  if (!method.budget)
    return tell(scene, false, "method", fmt::format("explicit steps (Verlet) at {:.4g} Hz, {}", method.rate, takes));
  tell(scene, method.load > 1, "method",
       fmt::format("backward Euler at {:.3g} Hz, {} iteration{} a step, {}; explicit steps would take {:.2g}",
                   method.rate, method.budget->iterations, method.budget->iterations == 1 ? "" : "s", takes,
                   cost.seconds / cost.stable));
}

/// Placed as load_mesh() places it, without its warnings.
TetMesh placed_mesh(const Scene& scene) {
  TetMesh mesh = *scene.mesh.source;
  check_tets(mesh);
  const Placement placement(scene.mesh);
  for (Vec3& node : mesh.nodes) node = placement(node);
  return mesh;
}

}  // namespace

Scene scene_around(const fs::path& path, const BareMeshOptions& options) {
  Scene scene;
  scene.file = path.string();
  scene.name = path.stem().string();
  scene.chosen.emplace().given = options;
  {
    const WarningCollector warnings;
    take_mesh(scene, path);
    for (const std::string& text : warnings.texts()) scene.chosen->texts.push_back({"mesh", text});
  }
  tell_fineness(scene);
  TetMesh mesh = placed_mesh(scene);
  choose_unit(scene, shape_of(mesh).size().maxCoeff());
  choose_up(scene, mesh);
  mesh = placed_mesh(scene);
  choose_supports(scene, mesh);
  scene.gravity = Vec3(0, -9.81, 0);
  scene.solver.continuation = scene.solver.recovery = true;
  scene.solver.damping = mass_damping;
  choose_element(scene, mesh);
  const TrialRun run = choose_tissue(scene, mesh);
  split_materials(scene, mesh);
  choose_method(scene, mesh, run.cost);
  return scene;
}

Scene default_scene() { return read_scene(assets_folder() / "scenes" / "kidney_grasp.json"); }

fs::path assets_folder() {
  if (const char* given = std::getenv("HEML_ASSETS"); given && *given) return given;
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (const fs::path share = program.parent_path().parent_path() / "share" / "heml"; fs::is_directory(share, error))
    return share;
  // In a Python package they lie beside the module that holds this code, for which alone dladdr tells a whole path.
  Dl_info module{};
  if (dladdr(reinterpret_cast<const void*>(&assets_folder), &module) != 0 && module.dli_fname) {
    const fs::path file = module.dli_fname, beside = file.parent_path() / "assets";
    if (file.is_absolute() && file != program && fs::is_directory(beside, error)) return beside;
  }
  return HEML_SOURCE_ASSETS;
}

}  // namespace heml
