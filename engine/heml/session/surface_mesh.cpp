#include <algorithm>
#include <heml/mesh/surface.hpp>
#include <heml/session/skin_cutter.hpp>
#include <heml/session/surface_mesh.hpp>
#include <numeric>
#include <utility>

namespace heml {

namespace {

bool is_hidden(int region, const std::vector<int>& hidden) {
  return std::binary_search(hidden.begin(), hidden.end(), region);
}

Topology without_hidden(const TetMesh& mesh, Topology topology, const std::vector<int>& hidden) {
  if (!hidden.empty())
    std::erase_if(topology.elements,
                  [&](int t) { return is_hidden(mesh.regions[static_cast<std::size_t>(t)], hidden); });
  return topology;
}

/// Which of the surface's nodes (mesh-file numbers, ascending) have a boundary condition: their indices.
std::vector<int> constrained_of(const std::vector<Boundary>& boundary, const std::vector<int>& nodes) {
  std::vector<int> indices;
  for (const Boundary& entry : boundary)
    for (const int n : entry.nodes) {
      const auto place = std::lower_bound(nodes.begin(), nodes.end(), n);
      if (place != nodes.end() && *place == n) indices.push_back(static_cast<int>(place - nodes.begin()));
    }
  std::sort(indices.begin(), indices.end());
  indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
  return indices;
}

/// The same surface with other boundary conditions, or the same mesh where they are as they were.
std::shared_ptr<const SurfaceMesh> with_conditions(std::shared_ptr<const SurfaceMesh> last,
                                                   const std::vector<Boundary>& boundary) {
  std::vector<int> constrained = constrained_of(boundary, last->nodes);
  if (constrained == last->constrained) return last;
  SurfaceMesh changed = *last;
  changed.constrained = std::move(constrained);
  return std::make_shared<const SurfaceMesh>(std::move(changed));
}

std::shared_ptr<const Regions> regions_of(const World& world) {
  const WorldSetup& setup = world.setup();
  const auto topology = world.topology();
  Regions regions{topology->version, {}, setup.mesh.region_names, setup.tagged, setup.materials};
  for (const int t : topology->elements) regions.numbers.push_back(setup.mesh.regions[static_cast<std::size_t>(t)]);
  std::sort(regions.numbers.begin(), regions.numbers.end());
  regions.numbers.erase(std::unique(regions.numbers.begin(), regions.numbers.end()), regions.numbers.end());
  return std::make_shared<const Regions>(std::move(regions));
}

bool are_current(const Regions& regions, const World& world) {
  const std::vector<RegionMaterial>& now = world.setup().materials;
  return regions.version == world.topology()->version &&
         std::equal(regions.materials.begin(), regions.materials.end(), now.begin(), now.end(),
                    [](const RegionMaterial& a, const RegionMaterial& b) {
                      return a.region == b.region && a.material == b.material;
                    });
}

/// The mean level of heat of the cells (triangles or tetrahedra) round each node; empty where nothing is burnt.
/// element: of each cell, its mesh-file number.
template <class Cell>
std::vector<float> burnt_nodes(const TetMesh& mesh, std::size_t nodes, const std::vector<Cell>& cells,
                               const std::vector<int>& element) {
  if (mesh.burns.empty()) return {};
  std::vector<float> sum(nodes, 0), count(nodes, 0);
  for (std::size_t k = 0; k < cells.size(); ++k)
    for (const int n : cells[k]) {
      sum[static_cast<std::size_t>(n)] += static_cast<float>(mesh.burns[static_cast<std::size_t>(element[k])].level);
      count[static_cast<std::size_t>(n)] += 1;
    }
  for (std::size_t n = 0; n < nodes; ++n) sum[n] = count[n] > 0 ? sum[n] / count[n] : 0;
  return sum;
}

SurfaceMesh build_surface_mesh(const WorldSetup& setup, const Topology& all, const std::vector<int>& hidden) {
  SurfaceMesh surface_mesh;
  const Topology topology = without_hidden(setup.mesh, all, hidden);
  surface_mesh.version = topology.version;
  surface_mesh.hidden = hidden;
  const BoundaryFaces faces = fine_boundary(setup.mesh, setup.midedges, topology);
  std::vector<int> index(setup.mesh.nodes.size(), -1);
  for (const Triangle& face : faces.triangles)
    for (const int n : face) index[static_cast<std::size_t>(n)] = 0;
  for (std::size_t n = 0; n < index.size(); ++n)
    if (index[n] == 0) {
      index[n] = static_cast<int>(surface_mesh.nodes.size());
      surface_mesh.nodes.push_back(static_cast<int>(n));
      surface_mesh.rest.push_back(setup.mesh.nodes[n].cast<float>());
    }
  for (std::size_t k = 0; k < faces.triangles.size(); ++k) {
    Triangle face = faces.triangles[k];
    for (int& n : face) n = index[static_cast<std::size_t>(n)];
    surface_mesh.triangles.push_back(face);
    surface_mesh.elements.push_back(topology.elements[static_cast<std::size_t>(faces.tets[k])]);
    surface_mesh.regions.push_back(setup.mesh.regions[static_cast<std::size_t>(surface_mesh.elements.back())]);
  }
  surface_mesh.constrained = constrained_of(setup.boundary, surface_mesh.nodes);
  surface_mesh.burnt =
      burnt_nodes(setup.mesh, surface_mesh.nodes.size(), surface_mesh.triangles, surface_mesh.elements);
  return surface_mesh;
}

}  // namespace

std::shared_ptr<const SurfaceMesh> make_surface_mesh(const World& world, std::shared_ptr<const SurfaceMesh> last,
                                                     const std::vector<int>& hidden) {
  const auto topology = world.topology();
  const WorldSetup& setup = world.setup();
  const std::size_t uncut_elements = last ? last->uncut_elements : setup.mesh.tets.size();
  if (last && last->hidden != hidden) last.reset();
  if (last && last->version == topology->version) return with_conditions(std::move(last), setup.boundary);
  SurfaceMesh surface_mesh = build_surface_mesh(setup, *topology, hidden);
  surface_mesh.uncut_elements = uncut_elements;
  if (topology->elements.size() < setup.mesh.tets.size()) {
    if (!last) {
      Topology uncut = full_topology(setup.mesh);
      uncut.elements.resize(uncut_elements);
      last = std::make_shared<const SurfaceMesh>(build_surface_mesh(setup, uncut, hidden));
    }
    surface_mesh.whole = last->whole ? last->whole : last;
  }
  return std::make_shared<const SurfaceMesh>(std::move(surface_mesh));
}

void fill_frame(World& world, std::shared_ptr<const SurfaceMesh> surface_mesh, Field field, double ahead, Frame& frame,
                bool with_stretches) {
  frame.tick = world.ticks();
  frame.time = world.time() + ahead;
  frame.elapsed = world.elapsed() + ahead;
  world.write_positions(surface_mesh->nodes, ahead, frame.positions);
  frame.field = field;
  world.write_field(field, surface_mesh->nodes, frame.values);
  if (with_stretches && field == Field::stretch)
    frame.stretches = frame.values;
  else
    world.write_field(with_stretches ? Field::stretch : Field::none, surface_mesh->nodes, frame.stretches);
  const WorldSetup& setup = world.setup();
  Conditions conditions{setup.boundary, setup.loads, setup.mesh.nodes.size()};
  if (!frame.conditions || *frame.conditions != conditions)
    frame.conditions = std::make_shared<const Conditions>(std::move(conditions));
  if (!frame.regions || !are_current(*frame.regions, world)) frame.regions = regions_of(world);
  frame.energies = world.energies();
  const std::vector<double> J = world.point_volume_ratios();
  const auto [low, high] = std::minmax_element(J.begin(), J.end());
  frame.min_J = *low;
  frame.max_J = *high;
  frame.removed = removed_count(world);
  frame.elements = world.topology()->elements.size() + frame.removed;
  frame.tools = world.tools();
  frame.substeps = world.substeps();
  frame.stable_step = world.stable_step();
  const SolverStats stats = world.solver_stats();
  frame.explicit_rescues = stats.explicit_rescues;
  frame.unconverged_steps = stats.unconverged_steps;
  frame.recovery.reset();
  if (const Recovery* recovery = world.recovery()) {
    frame.recovery = *recovery;
    if (recovery->element >= 0) {
      const Tet& corners = world.setup().mesh.tets[static_cast<std::size_t>(recovery->element)];
      std::vector<Vec3f> at;
      world.write_positions(corners, ahead, at);
      std::copy(at.begin(), at.end(), frame.recovered_element.begin());
    }
  }
  frame.last_edit.reset();
  if (!world.edits().empty()) frame.last_edit = world.edits().back();
  frame.halted = world.halt() ? world.halt()->message : std::string();
  frame.surface_mesh = std::move(surface_mesh);
}

void fill_solid(World& world, double ahead, std::shared_ptr<const Solid>& last, Frame& frame) {
  const auto topology = world.topology();
  const TetMesh& mesh = world.setup().mesh;
  const std::vector<int>& hidden = frame.surface_mesh->hidden;
  if (!last || last->version != topology->version || last->hidden != hidden) {
    Solid solid;
    solid.version = topology->version;
    solid.hidden = hidden;
    for (const Vec3& x : mesh.nodes) solid.rest.push_back(x.cast<float>());
    std::vector<int> shown;
    for (const int t : topology->elements) {
      if (is_hidden(mesh.regions[static_cast<std::size_t>(t)], hidden)) continue;
      shown.push_back(t);
      solid.tets.push_back(mesh.tets[static_cast<std::size_t>(t)]);
      solid.regions.push_back(mesh.regions[static_cast<std::size_t>(t)]);
    }
    solid.burnt = burnt_nodes(mesh, solid.rest.size(), solid.tets, shown);
    last = std::make_shared<const Solid>(std::move(solid));
  }
  frame.solid = last;
  std::vector<int> nodes(last->rest.size());
  std::iota(nodes.begin(), nodes.end(), 0);
  world.write_positions(nodes, ahead, frame.solid_positions);
  world.write_field(frame.field, nodes, frame.solid_values);
}

/// Whether a surface is that of the body before all edits: none was made, or all are undone.
static bool is_uncut(const SurfaceMesh& surface_mesh) {
  const SurfaceMesh& whole = uncut_surface(surface_mesh);
  return surface_mesh.nodes == whole.nodes && surface_mesh.triangles == whole.triangles;
}

void SkinAttachment::attach(const World& world, Frame& frame) {
  frame.skin = nullptr;
  if (!skin_ || !frame.surface_mesh || !frame.surface_mesh->hidden.empty()) return;
  const SurfaceMesh& surface = *frame.surface_mesh;
  if (is_uncut(surface)) {
    frame.skin = skin_;
    return;
  }
  if (!cutter_) cutter_ = std::make_shared<const SkinCutter>(skin_, surface.whole);
  if (!cut_ || cut_version_ != surface.version) {
    cut_ = cutter_->cut(surface, *world.topology(), world.setup().mesh);
    cut_version_ = surface.version;
  }
  frame.skin = cut_;
}

void clear_solid(Frame& frame) {
  frame.solid.reset();
  frame.solid_positions.clear();
  frame.solid_values.clear();
}

}  // namespace heml
