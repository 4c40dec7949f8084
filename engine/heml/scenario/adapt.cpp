#include <fmt/format.h>

#include <algorithm>
#include <heml/base/error.hpp>
#include <heml/mesh/field_of_piece.hpp>
#include <heml/mesh/refine.hpp>
#include <heml/scenario/adapt.hpp>
#include <heml/scenario/load_mesh.hpp>
#include <heml/scenario/player.hpp>
#include <heml/world/finer_setup.hpp>
#include <numeric>
#include <set>

namespace heml {
namespace {

constexpr const char* refine_key = "mesh.refine";
constexpr const char* other_remedy = "refine it at a time of its motion instead: heml refine SCENE --at SECONDS";
constexpr double refined_share = 0.5;  // of the squared error, per round
// Errors fall by a third in eight rounds where elements near an edge or corner hold most of them.
constexpr std::size_t rounds_without_gain = 8;
constexpr double least_gain = 0.1;

void check(const Scene& scene, const WorldSetup& setup, const std::optional<double>& time) {
  if (!has_straight_edges(setup))
    throw InputError(scene.file, refine_key, "divides straight edges, and the elements of this mesh are curved",
                     "take a mesh of four-node tetrahedra, or leave it out");
  const double end = scene.solver.is_static() ? 1 : scene.solver.duration;
  if (time && *time > end)
    throw InputError(scene.file, "", fmt::format("ends at {} s and is to be refined at {} s", end, *time),
                     "give an earlier time");
  const bool flows = std::any_of(setup.materials.begin(), setup.materials.end(),
                                 [](const RegionMaterial& entry) { return entry.material.plasticity.has_value(); });
  if (flows && !time)
    throw InputError(scene.file, refine_key, "the rest of a body that flows depends on its way there", other_remedy);
}

std::unique_ptr<World> at_rest(WorldSetup setup) {
  SolverSettings& solver = setup.solver;
  solver.integrator = Integrator::static_equilibrium;
  solver.single_precision = solver.recovery = false;
  solver.tolerance.reset(), solver.budget.reset(), solver.step.reset();
  std::unique_ptr<World> world = make_world(std::move(setup));
  world->load_to(1);
  return world;
}

std::unique_ptr<World> at_time(const Scene& scene, WorldSetup setup, double time) {
  std::unique_ptr<World> world = make_world(std::move(setup));
  Player(scene, *world).to(time);
  return world;
}

struct Solved {
  ErrorEstimate error;
  Energies energies;
};

Solved solved(const Scene& scene, const WorldSetup& setup, const std::optional<double>& time) {
  const auto world = time ? at_time(scene, setup, *time) : at_rest(setup);
  if (world->halt())
    throw InputError(scene.file, refine_key,
                     fmt::format("the body cannot be solved to see its error: {}", world->halt()->message),
                     time ? "give an earlier time" : other_remedy);
  const auto found = world->error_estimate();
  if (!found)
    throw InputError(scene.file, refine_key, "springs have no stress whose error could be estimated", "leave it out");
  if (!(found->stored > 0))
    throw InputError(scene.file, refine_key, "nothing deforms the body there, so no error is to be seen",
                     time ? "give a later time" : other_remedy);
  return {*found, world->energies()};
}

/// Whether the least error of the last rounds is hardly below that of the rounds before. Supports and forces at single
/// nodes have stresses that grow with every refinement about them.
bool has_stagnated(const std::vector<AdaptedMesh>& meshes) {
  if (meshes.size() <= rounds_without_gain) return false;
  const auto by_error = [](const AdaptedMesh& a, const AdaptedMesh& b) { return a.error < b.error; };
  const auto last = meshes.end() - rounds_without_gain;
  return std::min_element(last, meshes.end(), by_error)->error >
         (1 - least_gain) * std::min_element(meshes.begin(), last, by_error)->error;
}

/// "12,800"
std::string grouped(auto number) {
  std::string text = std::to_string(number);
  for (std::size_t end = text.size(); end > 3; end -= 3) text.insert(end - 3, 1, ',');
  return text;
}

/// Tags that name regions of a mesh whose file tells their numbers alone; of one name the first.
std::vector<RegionTag> names_of_regions(const TetMesh& mesh) {
  std::vector<RegionTag> tags;
  std::set<std::string> named;
  for (const auto& [region, name] : mesh.region_names)
    if (std::find(mesh.regions.begin(), mesh.regions.end(), region) != mesh.regions.end() && named.insert(name).second)
      tags.push_back({{}, {{}, region, {}, {}}, name, region});
  return tags;
}

}  // namespace

Adaptation adapt(const Scene& scene, WorldSetup setup, const RefineGoal& goal, const std::optional<double>& time,
                 const AdaptationObserver& observer) {
  check(scene, setup, time);
  Adaptation result;
  result.origins.resize(setup.mesh.tets.size());
  std::iota(result.origins.begin(), result.origins.end(), 0);
  for (;;) {
    if (observer.begun) observer.begun(setup.mesh.tets.size());
    const auto [error, energies] = solved(scene, setup, time);
    result.meshes.push_back({setup.mesh.nodes.size(), setup.mesh.tets.size(), error.relative(), energies.elastic,
                             energies.elastic + energies.potential});
    if (observer.told) observer.told(result.meshes.back());
    result.reached = error.relative() <= goal.error;
    result.stagnated = !result.reached && has_stagnated(result.meshes);
    if (result.reached || result.stagnated) break;
    WorldSetup corners = corners_of(setup);
    Refinement finer = refine_longest_edge(corners.mesh, doerfler_marking(error.of_element, refined_share));
    if (finer.mesh.tets.size() > static_cast<std::size_t>(goal.tets)) break;
    std::vector<int> origins;
    for (const int parent : finer.parents) origins.push_back(result.origins[static_cast<std::size_t>(parent)]);
    result.origins = std::move(origins);
    corners = on_finer_mesh(std::move(corners), std::move(finer.mesh), finer.midpoint_edges);
    setup = setup.midedges.empty() ? std::move(corners) : with_midedges(std::move(corners));
  }
  result.setup = std::move(setup);
  return result;
}

namespace {

/// What a command does to elements that it has by their numbers; null: it has none.
const char* deed_by_numbers(const Command& command) {
  if (const auto* remove = std::get_if<RemoveElements>(&command))
    return remove->which.tets.empty() ? nullptr : "removes";
  if (const auto* tag = std::get_if<TagRegion>(&command)) return tag->tag.which.tets.empty() ? nullptr : "tags";
  return nullptr;
}

AdaptedScene on_last_mesh(const Scene& scene, const Adaptation& adaptation, const std::filesystem::path& mesh_file) {
  const WorldSetup corners = corners_of(adaptation.setup);  // middles of edges are made on reading
  AdaptedScene result{scene, corners.mesh};
  result.mesh.fields.clear();
  const TetMesh first = load_mesh(scene);
  for (const ElementField& field : first.fields)
    result.mesh.fields.push_back(field_of_pieces(field, first, corners.mesh, adaptation.origins));
  Scene& finer = result.scene;
  finer.mesh = MeshSpec();
  finer.mesh.file = mesh_file;
  finer.regions = names_of_regions(corners.mesh);
  for (std::size_t k = 0; k < scene.boundary.size(); ++k)
    if (auto& nodes = finer.boundary[k].where.nodes; !nodes.empty()) nodes = corners.boundary[k].nodes;
  for (std::size_t k = 0; k < scene.loads.size(); ++k)
    if (auto& nodes = finer.loads[k].where.nodes; !nodes.empty()) nodes = corners.loads[k].nodes;
  finer.checkpoints.clear();
  finer.recorded_ticks.reset(), finer.recorded_end.reset(), finer.recorded_by = {}, finer.recorded_mesh.reset(),
                                                            finer.recorded_instructions.reset();
  return result;
}

}  // namespace

AdaptedScene adapted_scene(const Scene& scene, const Adaptation& adaptation, const std::filesystem::path& mesh_file) {
  for (const Event& event : scene.events)
    if (const char* deed = deed_by_numbers(event.command))
      throw InputError(
          scene.file, "events",
          fmt::format("step {} {} tetrahedra by numbers, which a finer mesh has others for", event.tick, deed),
          "give it a region, a box or a sphere");
  return on_last_mesh(scene, adaptation, mesh_file);
}

AdaptedScene refined_scene(Scene scene, const std::filesystem::path& mesh_file) {
  const RefineGoal goal = *scene.mesh.refine;
  scene.mesh.refine.reset();
  return on_last_mesh(scene, adapt(scene, load_setup(scene), goal, {}), mesh_file);
}

std::string why_not_reached(const Adaptation& adaptation, const RefineGoal& goal) {
  if (adaptation.reached) return "";
  if (!adaptation.stagnated)
    return fmt::format("{:.3g} % would need more than {} tetrahedra", 100 * goal.error, grouped(goal.tets));
  return fmt::format(
      "{:.3g} % is not reached: the error has hardly fallen in {} refinements, as where a support or a force is at "
      "single nodes (give them an area)",
      100 * goal.error, rounds_without_gain);
}

std::string text_of(const AdaptedMesh& mesh) {
  return fmt::format("{} tetrahedra, estimated error {:.3g} %", grouped(mesh.tets), 100 * mesh.error);
}

}  // namespace heml
