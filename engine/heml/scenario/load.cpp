// Makes a world from a scene: reads files, resolves selections, and checks what depends on the mesh.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/mesh/connected_parts.hpp>
#include <heml/mesh/region_tag.hpp>
#include <heml/mesh/surface.hpp>
#include <heml/scenario/adapt.hpp>
#include <heml/scenario/load_mesh.hpp>
#include <heml/scenario/material_fields.hpp>
#include <heml/scenario/positions_csv.hpp>
#include <heml/scenario/scene.hpp>
#include <heml/scenario/selection.hpp>
#include <set>

namespace heml {
namespace {

/// Tractions and pressures act on faces, so a selection without a whole face is an error.
void expect_a_face(const std::vector<int>& nodes, const BoundaryFaces& faces, const std::string& file,
                   const std::string& place) {
  const auto selected = [&](int node) { return std::binary_search(nodes.begin(), nodes.end(), node); };
  const bool any = std::any_of(faces.triangles.begin(), faces.triangles.end(), [&](const Triangle& face) {
    return selected(face[0]) && selected(face[1]) && selected(face[2]);
  });
  if (!any)
    throw InputError(file, place, fmt::format("its {} nodes hold no face of the surface", nodes.size()),
                     "select all three nodes of at least one boundary face");
}

/// A force is shared equally by its nodes, so what nodes of no element get is lost.
void warn_of_loose_nodes(const std::vector<int>& nodes, const WorldSetup& setup, const std::string& file,
                         const std::string& place) {
  std::vector<bool> used(setup.mesh.nodes.size(), false);
  const auto use = [&](const auto& element) {
    for (const int n : element) used[static_cast<std::size_t>(n)] = true;
  };
  for (const Tet& tet : setup.mesh.tets) use(tet);
  for (const auto& middles : setup.midedges) use(middles);
  const auto loose =
      std::count_if(nodes.begin(), nodes.end(), [&](int n) { return !used[static_cast<std::size_t>(n)]; });
  if (loose > 0)
    warn("{}: {}: {} of its {} nodes belong to no element, and their share of the force acts on nothing", file, place,
         loose, nodes.size());
}

void tag_regions(const Scene& scene, TetMesh& mesh) {
  const Topology topology = scene.regions.empty() ? Topology() : full_topology(mesh);
  for (std::size_t i = 0; i < scene.regions.size(); ++i) {
    TaggedRegion region;
    if (const Status status = resolve_region(scene.regions[i], mesh, topology, region); !status.ok())
      throw InputError(scene.file, fmt::format("regions[{}]", i), status.message(),
                       "choose elements of the mesh and a name for them");
    tag_region(region, mesh);
  }
}

/// Every element has a material, and every entry of `materials` that applies to none is told.
void check_materials(const Scene& scene, const TetMesh& mesh) {
  std::vector<bool> used(scene.materials.size(), false);
  for (const int m : material_of_elements(mesh, scene.materials, scene.file)) used[static_cast<std::size_t>(m)] = true;
  const std::set<int> regions(mesh.regions.begin(), mesh.regions.end());
  for (std::size_t m = 0; m < used.size(); ++m) {
    if (used[m]) continue;
    if (const std::optional<int> region = scene.materials[m].region)
      warn("{}: materials[{}]: no element carries region {}; the mesh has {}", scene.file, m, *region,
           fmt::join(regions, ", "));
    else
      warn("{}: materials[{}]: the default applies to no element: every region has an entry of its own", scene.file, m);
  }
}

/// Contact between bodies does nothing in one body, until it is cut into several.
void warn_of_one_body(const Scene& scene, const WorldSetup& setup) {
  if (!setup.self_contact || setup.self_contact->within_bodies) return;
  const std::vector<int> part = connected_parts(setup.mesh, setup.midedges);
  const auto is_of_first = [&](const Tet& tet) {
    return part[static_cast<std::size_t>(tet[0])] == part[static_cast<std::size_t>(setup.mesh.tets[0][0])];
  };
  if (std::all_of(setup.mesh.tets.begin(), setup.mesh.tets.end(), is_of_first))
    warn("{}: self_contact.within_bodies: false leaves out all contact while the mesh is one body", scene.file);
}

WorldSetup refined_setup(const Scene& scene, WorldSetup setup) {
  const RefineGoal& goal = *scene.mesh.refine;
  Adaptation adapted = adapt(scene, std::move(setup), goal, {},
                             {[](const AdaptedMesh& mesh) { log_info("refining the mesh: {}", text_of(mesh)); }});
  if (!adapted.reached)
    warn("{}: mesh.refine: {}; took {}", scene.file, why_not_reached(adapted, goal), text_of(adapted.meshes.back()));
  check_recorded_mesh(scene, adapted.setup.mesh);
  return std::move(adapted.setup);
}

}  // namespace

bool plays_as_recorded(const Scene& scene) {
  return scene.recorded_instructions && *scene.recorded_instructions <= resolve(InstructionSet::best);
}

WorldSetup load_setup(const Scene& scene) {
  MidEdges midedges;
  TetMesh mesh = load_mesh(scene, &midedges);
  return load_setup(scene, std::move(mesh), std::move(midedges));
}

WorldSetup load_setup(const Scene& scene, TetMesh mesh, MidEdges midedges) {
  WorldSetup setup;
  setup.mesh = std::move(mesh);
  setup.midedges = std::move(midedges);
  if (scene.solver.quadratic && setup.midedges.empty()) setup.midedges = add_midedge_nodes(setup.mesh);
  tag_regions(scene, setup.mesh);
  check_materials(scene, setup.mesh);
  setup.materials = scene.materials;
  resolve_fields(scene.file, setup);
  if (!scene.mesh.refine) check_recorded_mesh(scene, setup.mesh);
  for (std::size_t i = 0; i < scene.boundary.size(); ++i) {
    Boundary boundary = scene.boundary[i].motion;
    boundary.nodes = select_nodes(scene.boundary[i].where, setup, scene.file, fmt::format("boundary[{}]", i));
    setup.boundary.push_back(std::move(boundary));
  }
  const BoundaryFaces faces = scene.loads.empty() ? BoundaryFaces{} : extract_boundary(setup.mesh);
  for (std::size_t i = 0; i < scene.loads.size(); ++i) {
    const std::string place = fmt::format("loads[{}]", i);
    Load load = scene.loads[i].load;
    load.nodes = select_nodes(scene.loads[i].where, setup, scene.file, place);
    if (load.kind != Load::Kind::force) expect_a_face(load.nodes, faces, scene.file, place);
    if (load.kind == Load::Kind::force) warn_of_loose_nodes(load.nodes, setup, scene.file, place);
    setup.loads.push_back(std::move(load));
  }
  setup.tables = scene.tables;
  setup.self_contact = scene.self_contact;
  warn_of_one_body(scene, setup);
  setup.tearing = scene.tearing;
  setup.gravity = scene.gravity;
  setup.solver = scene.solver;
  setup.keeps_actions = std::any_of(scene.events.begin(), scene.events.end(), [](const Event& event) {
    return std::holds_alternative<StepHistory>(event.command);
  });
  if (plays_as_recorded(scene)) setup.instruction_set = *scene.recorded_instructions;
  setup.initial_velocity = scene.initial_velocity;
  if (!scene.initial_positions.empty())
    setup.initial_positions = read_positions_csv(find_file(scene, "initial.positions", scene.initial_positions),
                                                 static_cast<int>(setup.mesh.nodes.size()));
  if (use_double_far_away(setup))
    warn("{}: solver.precision: float does not resolve a body so far from the origin; it is computed in double "
         "(\"translate\" in the mesh brings it near)",
         scene.file);
  if (use_double_for_memory(setup))
    warn(
        "{}: solver.precision: float does not refine static solves of materials with internal state (viscosity, "
        "relaxation); they are computed in double",
        scene.file);
  return scene.mesh.refine ? refined_setup(scene, std::move(setup)) : setup;
}

std::unique_ptr<World> load_world(const Scene& scene) { return make_world(load_setup(scene)); }

}  // namespace heml
