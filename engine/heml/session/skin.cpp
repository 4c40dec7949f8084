#include <algorithm>
#include <heml/mesh/surface.hpp>
#include <heml/session/skin.hpp>

namespace heml {

namespace {

Skin make_skin(const WorldSetup& setup, const Topology& topology) {
  Skin skin;
  skin.version = topology.version;
  const bool is_whole = topology.elements.size() == setup.mesh.tets.size();
  const BoundaryFaces faces = boundary_of(is_whole ? setup.mesh : with_elements(setup.mesh, topology.elements));
  std::vector<int> index(setup.mesh.nodes.size(), -1);
  for (const Triangle& face : faces.triangles)
    for (const int n : face) index[static_cast<std::size_t>(n)] = 0;
  for (std::size_t n = 0; n < index.size(); ++n)
    if (index[n] == 0) {
      index[n] = static_cast<int>(skin.nodes.size());
      skin.nodes.push_back(static_cast<int>(n));
      skin.rest.push_back(setup.mesh.nodes[n].cast<float>());
    }
  for (std::size_t k = 0; k < faces.triangles.size(); ++k) {
    Triangle face = faces.triangles[k];
    for (int& n : face) n = index[static_cast<std::size_t>(n)];
    skin.triangles.push_back(face);
    skin.elements.push_back(topology.elements[static_cast<std::size_t>(faces.tets[k])]);
    skin.regions.push_back(setup.mesh.regions[static_cast<std::size_t>(skin.elements.back())]);
  }
  for (const Boundary& entry : setup.boundary)
    for (const int n : entry.nodes)
      if (index[static_cast<std::size_t>(n)] >= 0) skin.held.push_back(index[static_cast<std::size_t>(n)]);
  std::sort(skin.held.begin(), skin.held.end());
  skin.held.erase(std::unique(skin.held.begin(), skin.held.end()), skin.held.end());
  return skin;
}

}  // namespace

std::shared_ptr<const Skin> skin_of(const World& world, std::shared_ptr<const Skin> last) {
  const auto topology = world.topology();
  if (last && last->version == topology->version) return last;
  const WorldSetup& setup = world.setup();
  Skin skin = make_skin(setup, *topology);
  if (topology->elements.size() < setup.mesh.tets.size()) {
    if (!last) last = std::make_shared<const Skin>(make_skin(setup, whole(setup.mesh)));
    skin.whole = last->whole ? last->whole : last;
  }
  return std::make_shared<const Skin>(std::move(skin));
}

void fill_frame(World& world, std::shared_ptr<const Skin> skin, Field field, double ahead, Frame& frame,
                bool with_stretches) {
  frame.tick = world.ticks();
  frame.time = world.time() + ahead;
  world.write_positions(skin->nodes, ahead, frame.positions);
  frame.field = field;
  world.write_field(field, skin->nodes, frame.values);
  if (with_stretches && field == Field::stretch)
    frame.stretches = frame.values;
  else
    world.write_field(with_stretches ? Field::stretch : Field::none, skin->nodes, frame.stretches);
  frame.energies = world.energies();
  const std::vector<double> J = world.volume_ratios();
  const auto [low, high] = std::minmax_element(J.begin(), J.end());
  frame.min_J = *low;
  frame.max_J = *high;
  frame.removed = removed_of(world);
  frame.elements = J.size() + frame.removed;
  frame.tool = world.tool();
  frame.pins = world.pins();
  frame.tables = world.tables();
  frame.probe = world.probe();
  frame.sutures = world.sutures();
  frame.substeps = world.substeps();
  frame.stable_step = world.stable_step();
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
  frame.skin = std::move(skin);
}

}  // namespace heml
