#pragma once
// What does not change while a body moves, in inner order (mesh/reorder.hpp). An edit of the mesh changes it: inside
// there are only the elements that are left, so that no loop asks which those are.
#include <heml/dynamics/prescribed_motion.hpp>
#include <heml/elastic/loads.hpp>
#include <heml/mesh/edit.hpp>
#include <heml/mesh/reorder.hpp>
#include <heml/mesh/surface.hpp>
#include <heml/world/setup.hpp>
#include <type_traits>
#include <vector>

namespace heml {

/// A node with a boundary condition; entry: which of setup.boundary won these coordinates. −1: a pin.
struct ConstrainedNode {
  int node;
  int entry;
  AxisSet axes = {};
};

template <class Real>
struct Model {
  Reordering order;                ///< new_tet: −1 for an element that is gone
  TetMesh mesh;                    ///< inner order
  MidEdges midedges;               ///< #T of quadratic elements, else empty
  std::vector<int> material_of;    ///< #T
  BoundaryFaces loaded_faces;      ///< the surface as first made, of elements that are left: what loads act on
  std::vector<int> surface_nodes;  ///< ascending, also those in wounds and on the front of a cut
  std::vector<ConstrainedNode> constrained;          ///< ascending in node; several of one have other coordinates
  std::vector<PrescribedMotion> prescribed_motions;  ///< one per setup.boundary
  std::vector<double> speeds;                        ///< m/s, of each while it moves: of the fastest node
  std::vector<DeadLoad<Real>> dead;
  std::vector<Pressure<Real>> pressures;
  std::vector<double> spread_area;  ///< m², one per setup.loads: of the faces of quadratic elements that a force was
                                    ///< spread over at first; 0: other loads
  double diagonal = 0;  ///< m, of the rest bounding box
  double spacing = 0;   ///< m, of nodes, about
};

/// Where a held node is at time t, s.
template <class Real>
PrescribedMotion::At prescribed_at(const Model<Real>& model, const ConstrainedNode& constrained, double time) {
  return model.prescribed_motions[static_cast<std::size_t>(constrained.entry)](
      model.mesh.nodes[static_cast<std::size_t>(constrained.node)], time);
}

/// Writes these coordinates of a node's value to values, 3 #V.
template <class Vector3, class Values>
void set_along(const AxisSet& axes, int node, const Vector3& value, Values& values) {
  using Scalar = std::remove_cvref_t<decltype(values[0])>;
  for (int i = 0; i < 3; ++i)
    if (axes.has[static_cast<std::size_t>(i)])
      values[static_cast<decltype(values.size())>(3 * node + i)] = static_cast<Scalar>(value[i]);
}

/// Of each node, the coordinates that the boundary entries hold.
template <class Real>
std::vector<AxisSet> held_axes(const Model<Real>& model);

/// Whether a held node is elsewhere at another time, s.
template <class Real>
bool supports_move(const Model<Real>& model, double from, double to);

/// Take the boundary entries and the loads of a setup in place of those before.
template <class Real>
void set_boundary(const WorldSetup& setup, Model<Real>& model);
template <class Real>
void set_loads(const WorldSetup& setup, Model<Real>& model);

/// Whether all three nodes of a face that loads act on are among nodes, mesh-file order.
template <class Real>
bool holds_face(const std::vector<int>& nodes, const Model<Real>& model);

/// Nodes of the boundary that the elements outside some regions have (ascending, as the result): also where they meet
/// those regions. Linear in the size of the mesh.
template <class Real>
std::vector<int> surface_nodes_without(const Model<Real>& model, const std::vector<int>& regions);

/// Reorders, resolves boundary and loads. Throws InputError as material_of_elements().
template <class Real>
Model<Real> make_model(const WorldSetup& setup);

/// Leaves the given elements (inner numbers, ascending), numbered anew in that order.
template <class Real>
void keep_elements(const WorldSetup& setup, const std::vector<int>& elements, Model<Real>& model);

/// Adds nodes and elements of an edit, in the mesh's own numbers: nodes after all others, elements too; what it removes
/// is still there. setup: with the edit's nodes and elements, and its nodes in boundary and loads.
template <class Real>
void append(const WorldSetup& setup, const MeshEdit& edit, Model<Real>& model);

}  // namespace heml
