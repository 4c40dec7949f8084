#include <algorithm>
#include <cmath>
#include <heml/mesh/edit.hpp>
#include <heml/mesh/faces.hpp>
#include <heml/world/model.hpp>
#include <map>
#include <numbers>
#include <unordered_map>

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

/// Whether an element has the node: loads push nothing else.
std::vector<bool> used_nodes(const TetMesh& mesh, const MidEdges& midedges) {
  std::vector<bool> used(mesh.nodes.size(), false);
  for (const Tet& tet : mesh.tets)
    for (const int n : tet) used[static_cast<std::size_t>(n)] = true;
  for (const auto& of_element : midedges)
    for (const int n : of_element) used[static_cast<std::size_t>(n)] = true;
  return used;
}

/// Corners and mid-edge nodes of boundary faces whose three corners are selected.
std::vector<std::array<int, 6>> quadratic_faces_within(const BoundaryFaces& faces, const std::vector<Triangle>& middles,
                                                       const std::vector<int>& nodes) {
  const auto selected = [&](int n) { return std::binary_search(nodes.begin(), nodes.end(), n); };
  std::vector<std::array<int, 6>> result;
  for (std::size_t f = 0; f < faces.triangles.size(); ++f) {
    const auto& [a, b, c] = faces.triangles[f];
    const auto& [ab, bc, ca] = middles[f];
    if (selected(a) && selected(b) && selected(c)) result.push_back({a, b, c, ab, bc, ca});
  }
  return result;
}

/// The nodes of a list that are corners, or mid-edge nodes, of elements there are or have been.
template <class Real>
std::vector<int> chosen_of(const std::vector<int>& nodes, const auto& elements, const Model<Real>& model) {
  std::vector<bool> is_one(model.mesh.nodes.size(), false);
  for (const auto& of_element : elements)
    for (const int n : of_element)
      is_one[static_cast<std::size_t>(model.order.new_node[static_cast<std::size_t>(n)])] = true;
  std::vector<int> result;
  for (const int n : nodes)
    if (is_one[static_cast<std::size_t>(n)]) result.push_back(n);
  return result;
}

Ramp ramp_of(const auto& entry) { return {entry.ramp_start, entry.ramp_time}; }

struct FaceShares {
  std::map<int, double> of_node;  ///< m², ∫N
  double area = 0;                ///< m²
};

/// Of the faces within a list of nodes.
template <class Real>
FaceShares face_shares(const std::vector<int>& nodes, const Model<Real>& model) {
  FaceShares shares;
  for (const auto& face : quadratic_faces_within(
           model.loaded_faces, face_midedges(model.loaded_faces, model.mesh, model.midedges), nodes))
    for (const FacePoint& point : face_points) {
      const auto y =
          virtual_face(point, [&](std::size_t k) { return model.mesh.nodes[static_cast<std::size_t>(face[k])]; });
      const double here = point.weight * (y[1] - y[0]).cross(y[2] - y[0]).norm() / 2;
      shares.area += here;
      for (std::size_t k = 0; k < 6; ++k) shares.of_node[face[k]] += point.N[k] * here;
    }
  return shares;
}

/// The area that a force on quadratic elements is spread over evenly: the faces within its nodes, where those hold all
/// corners that are. 0: it is shared by nodes.
template <class Real>
double area_spread_over(const Load& load, const WorldSetup& setup, const Model<Real>& model) {
  if (load.kind != Load::Kind::force || model.midedges.empty()) return 0;
  const std::vector<int> nodes = inner(load.nodes, model.order);
  const FaceShares shares = face_shares(nodes, model);
  const std::vector<int> corners = chosen_of(nodes, setup.mesh.tets, model);
  const bool hold_all =
      std::all_of(corners.begin(), corners.end(), [&](int n) { return shares.of_node.contains(n); });
  return hold_all ? shares.area : 0;
}

/// A dead load on quadratic elements. spread_area: area_spread_over() when the body was whole; without it a force is
/// shared by the corners that are selected, or by mid-edge nodes where no corner is.
template <class Real>
DeadLoad<Real> quadratic_dead_load(const Load& load, double spread_area, const std::vector<int>& nodes,
                                   const WorldSetup& setup, const std::vector<bool>& used, const Model<Real>& model) {
  DeadLoad<Real> result{{}, {}, ramp_of(load)};
  const auto add = [&](int n, const Vec3& f) {
    result.nodes.push_back(n);
    for (int i = 0; i < 3; ++i) result.forces.push_back(static_cast<Real>(f[i]));
  };
  if (load.kind == Load::Kind::traction || spread_area > 0) {
    const Vec3 traction = load.kind == Load::Kind::traction ? load.vector : Vec3(load.vector / spread_area);
    for (const auto& [n, share] : face_shares(nodes, model).of_node) add(n, share * traction);
    return result;
  }
  std::vector<int> bearing = chosen_of(nodes, setup.mesh.tets, model);
  if (bearing.empty()) bearing = chosen_of(nodes, setup.midedges, model);
  for (const int n : bearing)
    if (used[static_cast<std::size_t>(n)]) add(n, load.vector / static_cast<double>(bearing.size()));
  return result;
}

template <class Real>
DeadLoad<Real> dead_load(const Load& load, const std::vector<int>& nodes, const TetMesh& mesh,
                         const BoundaryFaces& faces, const std::vector<bool>& used) {
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
  DeadLoad<Real> result{{}, {}, ramp_of(load)};
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (!used[static_cast<std::size_t>(nodes[k])]) continue;
    result.nodes.push_back(nodes[k]);
    for (int i = 0; i < 3; ++i) result.forces.push_back(static_cast<Real>(force[k][i]));
  }
  return result;
}

/// In a static world everything is ramped together, over the duration.
template <class Real>
void make_loads(const WorldSetup& setup, Model<Real>& model) {
  model.dead.clear();
  model.pressures.clear();
  const std::vector<bool> used = used_nodes(model.mesh, model.midedges);
  for (std::size_t k = 0; k < setup.loads.size(); ++k) {
    const Load& load = setup.loads[k];
    const std::vector<int> nodes = inner(load.nodes, model.order);
    if (!model.midedges.empty() && load.kind == Load::Kind::pressure)
      model.pressures.push_back(
          {{},
           quadratic_faces_within(model.loaded_faces, face_midedges(model.loaded_faces, model.mesh, model.midedges),
                                  nodes),
           static_cast<Real>(load.pressure),
           ramp_of(load)});
    else if (!model.midedges.empty())
      model.dead.push_back(quadratic_dead_load(load, model.spread_area[k], nodes, setup, used, model));
    else if (load.kind == Load::Kind::pressure)
      model.pressures.push_back(
          {faces_within(model.loaded_faces, nodes), {}, static_cast<Real>(load.pressure), ramp_of(load)});
    else
      model.dead.push_back(dead_load<Real>(load, nodes, model.mesh, model.loaded_faces, used));
  }
  if (!setup.solver.is_static()) return;
  const Ramp whole{0, setup.solver.load_duration()};
  for (DeadLoad<Real>& load : model.dead) load.ramp = whole;
  for (Pressure<Real>& load : model.pressures) load.ramp = whole;
}

std::vector<int> chosen_nodes(const std::vector<bool>& chosen) {
  std::vector<int> nodes;
  for (std::size_t n = 0; n < chosen.size(); ++n)
    if (chosen[n]) nodes.push_back(static_cast<int>(n));
  return nodes;
}

std::vector<int> boundary_nodes(const TetMesh& mesh, const MidEdges& midedges) {
  std::vector<bool> on_surface(mesh.nodes.size(), false);
  for (const Triangle& face : fine_boundary(mesh, midedges).triangles)
    for (const int n : face) on_surface[static_cast<std::size_t>(n)] = true;
  return chosen_nodes(on_surface);
}

}  // namespace

template <class Real>
void set_boundary(const WorldSetup& setup, Model<Real>& model) {
  model.constrained.clear();
  model.prescribed_motions.clear();
  std::vector<std::array<int, 3>> winners(model.mesh.nodes.size(), {-1, -1, -1});  // of each coordinate
  for (std::size_t b = 0; b < setup.boundary.size(); ++b) {
    const Boundary& entry = setup.boundary[b];
    const Ramp ramp = setup.solver.is_static() ? Ramp{0, setup.solver.load_duration()} : ramp_of(entry);
    model.prescribed_motions.push_back(
        {entry.translate, entry.axis.normalized(), entry.origin, entry.degrees * std::numbers::pi / 180, ramp});
    for (const int n : inner(entry.nodes, model.order))
      for (std::size_t i = 0; i < 3; ++i)
        if (entry.axes.has[i]) winners[static_cast<std::size_t>(n)][i] = static_cast<int>(b);
  }
  for (std::size_t n = 0; n < winners.size(); ++n) {
    const auto& winner = winners[n];
    for (std::size_t i = 0; i < 3; ++i) {
      if (winner[i] < 0 || std::find(winner.begin(), winner.begin() + i, winner[i]) != winner.begin() + i) continue;
      const AxisSet axes{{winner[0] == winner[i], winner[1] == winner[i], winner[2] == winner[i]}};
      model.constrained.push_back({static_cast<int>(n), winner[i], axes});
    }
  }
  model.speeds.assign(model.prescribed_motions.size(), 0);
  for (const ConstrainedNode& constrained : model.constrained) {
    double& speed = model.speeds[static_cast<std::size_t>(constrained.entry)];
    const double start = model.prescribed_motions[static_cast<std::size_t>(constrained.entry)].ramp.start;
    speed = std::max(speed, prescribed_at(model, constrained, start).v.norm());
  }
}

template <class Real>
void set_loads(const WorldSetup& setup, Model<Real>& model) {
  model.spread_area.clear();
  for (const Load& load : setup.loads) model.spread_area.push_back(area_spread_over(load, setup, model));
  make_loads(setup, model);
}

template <class Real>
bool holds_face(const std::vector<int>& nodes, const Model<Real>& model) {
  return !faces_within(model.loaded_faces, inner(nodes, model.order)).empty();
}

template <class Real>
std::vector<int> surface_nodes_without(const Model<Real>& model, const std::vector<int>& regions) {
  std::vector<int> others;
  for (std::size_t t = 0; t < model.mesh.tets.size(); ++t)
    if (!std::binary_search(regions.begin(), regions.end(), model.mesh.regions[t]))
      others.push_back(static_cast<int>(t));
  return boundary_nodes(with_elements(model.mesh, others), with_elements(model.midedges, others));
}

template <class Real>
Model<Real> make_model(const WorldSetup& setup) {
  Model<Real> model;
  const std::vector<int> file_materials = material_of_elements(setup.mesh, setup.materials);
  model.order = hilbert_order(setup.mesh, setup.midedges);
  model.mesh = reordered(setup.mesh, model.order);
  model.midedges = reordered(setup.midedges, model.order);
  for (const int t : model.order.file_tet) model.material_of.push_back(file_materials[static_cast<std::size_t>(t)]);
  model.loaded_faces = extract_boundary(model.mesh);
  model.surface_nodes = boundary_nodes(model.mesh, model.midedges);
  set_boundary(setup, model);
  set_loads(setup, model);
  Eigen::AlignedBox3d box;
  for (const Vec3& X : model.mesh.nodes) box.extend(X);
  model.diagonal = box.diagonal().norm();
  model.spacing = model.diagonal / std::cbrt(static_cast<double>(std::max<std::size_t>(1, model.mesh.nodes.size())));
  return model;
}

template <class Real>
void keep_elements(const WorldSetup& setup, const std::vector<int>& elements, Model<Real>& model) {
  std::vector<int> number(model.mesh.tets.size(), -1);  // that an element has from now on
  for (std::size_t k = 0; k < elements.size(); ++k) number[static_cast<std::size_t>(elements[k])] = static_cast<int>(k);
  std::vector<bool> on_surface(model.mesh.nodes.size(), false);  // as before, and what an element leaves bare
  for (const int n : model.surface_nodes) on_surface[static_cast<std::size_t>(n)] = true;
  for (std::size_t t = 0; t < number.size(); ++t)
    if (number[t] < 0)
      for (const int n : model.mesh.tets[t]) on_surface[static_cast<std::size_t>(n)] = true;
  model.mesh = with_elements(model.mesh, elements);
  model.midedges = with_elements(model.midedges, elements);
  model.material_of = with_elements(model.material_of, elements);
  model.order.file_tet = with_elements(model.order.file_tet, elements);
  for (int& t : model.order.new_tet)
    if (t >= 0) t = number[static_cast<std::size_t>(t)];
  BoundaryFaces left;
  for (std::size_t k = 0; k < model.loaded_faces.tets.size(); ++k) {
    const int t = number[static_cast<std::size_t>(model.loaded_faces.tets[k])];
    if (t < 0) continue;
    left.triangles.push_back(model.loaded_faces.triangles[k]);
    left.tets.push_back(t);
  }
  model.loaded_faces = std::move(left);
  const std::vector<bool> used = used_nodes(model.mesh, model.midedges);
  for (std::size_t n = 0; n < used.size(); ++n) on_surface[n] = on_surface[n] && used[n];
  model.surface_nodes = model.midedges.empty() ? chosen_nodes(on_surface) : boundary_nodes(model.mesh, model.midedges);
  make_loads(setup, model);
}

namespace {

/// The faces of an edit's pieces that lie in a face of the element they are of.
std::vector<Triangle> faces_in(const Triangle& face, const Tet& piece, const MeshEdit& edit, int old_nodes) {
  const auto in_face = [&](int n) {
    const auto has = [&](int old) { return std::find(face.begin(), face.end(), old) != face.end(); };
    if (n < old_nodes) return has(n);
    const InsertedNode& node = edit.nodes[static_cast<std::size_t>(n - old_nodes)];
    return has(node.from) && has(node.to);
  };
  std::vector<Triangle> found;
  for (const auto& corners : tet_faces) {
    Triangle triangle;
    for (std::size_t c = 0; c < 3; ++c) triangle[c] = piece[static_cast<std::size_t>(corners[c])];
    if (std::all_of(triangle.begin(), triangle.end(), in_face)) found.push_back(triangle);
  }
  return found;
}

}  // namespace

template <class Real>
void append(const WorldSetup& setup, const MeshEdit& edit, Model<Real>& model) {
  const auto nodes = static_cast<int>(model.mesh.nodes.size()), tets = static_cast<int>(model.mesh.tets.size());
  for (std::size_t k = 0; k < edit.nodes.size(); ++k) {
    model.order.file_node.push_back(static_cast<int>(model.order.new_node.size()));
    model.order.new_node.push_back(nodes + static_cast<int>(k));
    model.surface_nodes.push_back(nodes + static_cast<int>(k));  // of a wound, or on its front
  }
  BoundaryFaces& faces = model.loaded_faces;
  std::unordered_map<int, std::vector<Triangle>> loaded;  // of the parents
  for (const int parent : edit.parents) loaded[parent] = {};
  for (std::size_t f = 0; f < faces.tets.size(); ++f)
    if (const auto of = loaded.find(faces.tets[f]); of != loaded.end()) of->second.push_back(faces.triangles[f]);
  for (std::size_t k = 0; k < edit.added.size(); ++k) {
    const int element = tets + static_cast<int>(k);
    model.order.file_tet.push_back(static_cast<int>(model.order.new_tet.size()));
    model.order.new_tet.push_back(element);
    model.material_of.push_back(model.material_of[static_cast<std::size_t>(edit.parents[k])]);
    for (const Triangle& of_parent : loaded[edit.parents[k]])
      for (const Triangle& face : faces_in(of_parent, edit.added[k], edit, nodes)) {
        faces.triangles.push_back(face);
        faces.tets.push_back(element);
      }
  }
  append(edit, model.mesh);
  model.midedges.insert(model.midedges.end(), edit.midedges.begin(), edit.midedges.end());
  set_boundary(setup, model);
}

template <class Real>
std::vector<AxisSet> held_axes(const Model<Real>& model) {
  std::vector<AxisSet> axes(model.mesh.nodes.size(), AxisSet::none());
  for (const ConstrainedNode& constrained : model.constrained) {
    AxisSet& of_node = axes[static_cast<std::size_t>(constrained.node)];
    of_node = of_node.with(constrained.axes);
  }
  return axes;
}

template <class Real>
bool supports_move(const Model<Real>& model, double from, double to) {
  return std::any_of(model.constrained.begin(), model.constrained.end(), [&](const ConstrainedNode& constrained) {
    return prescribed_at(model, constrained, from).x != prescribed_at(model, constrained, to).x;
  });
}

template std::vector<AxisSet> held_axes(const Model<float>&);
template std::vector<AxisSet> held_axes(const Model<double>&);
template bool supports_move(const Model<float>&, double, double);
template bool supports_move(const Model<double>&, double, double);
template void append(const WorldSetup&, const MeshEdit&, Model<float>&);
template void append(const WorldSetup&, const MeshEdit&, Model<double>&);
template void set_boundary(const WorldSetup&, Model<float>&);
template void set_boundary(const WorldSetup&, Model<double>&);
template void set_loads(const WorldSetup&, Model<float>&);
template void set_loads(const WorldSetup&, Model<double>&);
template bool holds_face(const std::vector<int>&, const Model<float>&);
template bool holds_face(const std::vector<int>&, const Model<double>&);
template std::vector<int> surface_nodes_without(const Model<float>&, const std::vector<int>&);
template std::vector<int> surface_nodes_without(const Model<double>&, const std::vector<int>&);
template Model<float> make_model(const WorldSetup&);
template Model<double> make_model(const WorldSetup&);
template void keep_elements(const WorldSetup&, const std::vector<int>&, Model<float>&);
template void keep_elements(const WorldSetup&, const std::vector<int>&, Model<double>&);

}  // namespace heml
