#include <algorithm>
#include <heml/mesh/surface.hpp>
#include <heml/world/model.hpp>
#include <numbers>

namespace heml {
namespace {

std::vector<int> inner(const std::vector<int>& file_nodes, const Reordering& order) {
  std::vector<int> result;
  for (const int n : file_nodes) result.push_back(order.new_node[static_cast<std::size_t>(n)]);
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

/// Boundary faces whose three nodes are all selected.
std::vector<Triangle> faces_within(const BoundaryFaces& faces, const std::vector<int>& nodes) {
  const auto selected = [&](int n) { return std::binary_search(nodes.begin(), nodes.end(), n); };
  std::vector<Triangle> result;
  for (const Triangle& face : faces.triangles)
    if (std::all_of(face.begin(), face.end(), selected)) result.push_back(face);
  return result;
}

template <class Real>
DeadLoad<Real> dead_load(const Load& load, const std::vector<int>& nodes, const TetMesh& mesh,
                         const BoundaryFaces& faces) {
  std::vector<Vec3> force(nodes.size(), Vec3::Zero());
  if (load.kind == Load::Kind::force) {
    for (Vec3& f : force) f = load.vector / static_cast<double>(nodes.size());
  } else {
    for (const Triangle& face : faces_within(faces, nodes)) {
      const auto X = [&](std::size_t c) { return mesh.nodes[static_cast<std::size_t>(face[c])]; };
      const double area = (X(1) - X(0)).cross(X(2) - X(0)).norm() / 2;
      for (const int n : face)
        force[static_cast<std::size_t>(std::lower_bound(nodes.begin(), nodes.end(), n) - nodes.begin())] +=
            area / 3 * load.vector;
    }
  }
  DeadLoad<Real> result{nodes, {}, load.over};
  for (const Vec3& f : force)
    for (int i = 0; i < 3; ++i) result.forces.push_back(static_cast<Real>(f[i]));
  return result;
}

template <class Real>
void add_loads(const WorldSetup& setup, const BoundaryFaces& faces, Model<Real>& model) {
  for (const Load& load : setup.loads) {
    const std::vector<int> nodes = inner(load.nodes, model.order);
    if (load.kind == Load::Kind::pressure)
      model.pressures.push_back({faces_within(faces, nodes), static_cast<Real>(load.pressure), load.over});
    else
      model.dead.push_back(dead_load<Real>(load, nodes, model.mesh, faces));
  }
}

template <class Real>
void add_boundary(const WorldSetup& setup, Model<Real>& model) {
  std::vector<int> winner(model.mesh.nodes.size(), -1);
  for (std::size_t b = 0; b < setup.boundary.size(); ++b) {
    const Boundary& entry = setup.boundary[b];
    model.motions.push_back(
        {entry.translate, entry.axis.normalized(), entry.origin, entry.degrees * std::numbers::pi / 180, entry.over});
    for (const int n : inner(entry.nodes, model.order)) winner[static_cast<std::size_t>(n)] = static_cast<int>(b);
  }
  for (std::size_t n = 0; n < winner.size(); ++n)
    if (winner[n] >= 0) model.held.push_back({static_cast<int>(n), winner[n]});
}

/// In a static world everything is ramped together, over the duration.
template <class Real>
void ramp_together(double duration, Model<Real>& model) {
  for (Motion& motion : model.motions) motion.over = duration;
  for (DeadLoad<Real>& load : model.dead) load.over = duration;
  for (Pressure<Real>& load : model.pressures) load.over = duration;
}

}  // namespace

template <class Real>
Model<Real> make_model(const WorldSetup& setup) {
  Model<Real> model;
  const std::vector<int> file_materials = material_of_elements(setup.mesh, setup.materials);
  model.order = locality_order(setup.mesh);
  model.mesh = reordered(setup.mesh, model.order);
  for (const int t : model.order.file_tet) model.material_of.push_back(file_materials[static_cast<std::size_t>(t)]);
  const BoundaryFaces faces = boundary_of(model.mesh);
  for (const Triangle& face : faces.triangles)
    model.surface_nodes.insert(model.surface_nodes.end(), face.begin(), face.end());
  std::sort(model.surface_nodes.begin(), model.surface_nodes.end());
  model.surface_nodes.erase(std::unique(model.surface_nodes.begin(), model.surface_nodes.end()),
                            model.surface_nodes.end());
  add_boundary(setup, model);
  add_loads(setup, faces, model);
  if (setup.solver.is_static()) ramp_together(setup.solver.load_duration(), model);
  Eigen::AlignedBox3d box;
  for (const Vec3& X : model.mesh.nodes) box.extend(X);
  model.diagonal = box.diagonal().norm();
  return model;
}

template Model<float> make_model(const WorldSetup&);
template Model<double> make_model(const WorldSetup&);

}  // namespace heml
