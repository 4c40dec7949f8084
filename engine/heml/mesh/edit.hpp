#pragma once
// Edits of a mesh's topology, as values: tools create them, a world applies them, views update from them.
//
// Edits do not renumber. Nodes and elements keep their numbers (those of the mesh file) for the life of a body; removed
// elements leave a gap:
//
//     file          0 1 2 3 4 5 6 7
//     MeshEdit        ×     ×       + +   removed {1, 4}, added {8, 9}
//     Topology      0   2 3   5 6 7 8 9   elements; version 1
#include <algorithm>
#include <heml/base/status.hpp>
#include <heml/mesh/quadratic.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace heml {

/// An existing node and its weight in the values of a new one.
struct NodeShare {
  int node;
  double weight;
};

/// A node that an edit adds on the edge between two existing nodes; from == to: a copy of that node.
struct InsertedNode {
  int from, to;
  double weight;                    ///< 0 at from, 1 at to; in the rest and the deformed shape
  std::vector<NodeShare> sum = {};  ///< in a quadratic element, unless a copy: the nodes that it follows instead, by
                                    ///< shape functions; weights of 1 in all

  /// Whether has(node) is true of all nodes that it follows: it is held or loaded where these are.
  template <class Has>
  bool lies_among(const Has& has) const {
    if (sum.empty()) return has(from) && has(to);
    return std::all_of(sum.begin(), sum.end(), [&](const NodeShare& share) { return has(share.node); });
  }
};

/// A change of a mesh of #V nodes and #T elements.
struct MeshEdit {
  std::vector<int> removed;         ///< removed elements, ascending, each once
  std::vector<InsertedNode> nodes;  ///< new nodes, numbered #V, #V + 1, …
  std::vector<Tet> added;           ///< new elements, numbered #T, #T + 1, …; into old and new nodes
  std::vector<int> parents;         ///< per new element the removed one that it is a part of; ascending
  MidEdges midedges = {};           ///< of new elements, if they are quadratic (mesh/quadratic_edit.hpp); else empty
};

/// The existing elements of a mesh. Immutable and shared by its readers: an edit makes another Topology.
struct Topology {
  long version = 0;           ///< increases with every change
  std::vector<int> elements;  ///< ascending
};

/// The topology with all elements of a mesh.
Topology full_topology(const TetMesh& mesh, long version = 0);

/// The topology after an edit; elements: #T before it. All removed elements must exist.
Topology apply_edit(const Topology& topology, const MeshEdit& edit, int elements);

/// Appends an edit's nodes, interpolated at rest, and its elements, with the region, fields and burns of their parents.
/// Removed elements stay in the mesh; only the topology excludes them.
void append(const MeshEdit& edit, TetMesh& mesh);

/// Appends the values of an edit's nodes, interpolated between those that each follows, to values of nodes (each × #V).
template <class Value>
void append(const MeshEdit& edit, std::vector<Value>& values, std::size_t each = 1) {
  using Wide = std::conditional_t<std::is_floating_point_v<Value>, double, Value>;
  for (const InsertedNode& node : edit.nodes)
    for (std::size_t c = 0; c < each; ++c) {
      const auto at = [&](int n) { return values[each * static_cast<std::size_t>(n) + c]; };
      const Value from = at(node.from), to = at(node.to);
      Value value = node.from == node.to ? from : Value(from + (to - from) * node.weight);
      if (!node.sum.empty()) {
        Wide sum(from);  // relative to one of them, for the digits far from the origin
        for (const auto& [n, weight] : node.sum) sum += (Wide(at(n)) - Wide(from)) * weight;
        value = Value(sum);
      }
      values.push_back(value);
    }
}

/// Elements selected by number, or by region or by centroid at rest within a closed box or sphere.
struct ElementSelection {
  std::vector<int> tets;  ///< used if none of the others is given
  std::optional<int> region;
  std::optional<std::array<Vec3, 2>> box;         ///< lower and upper corner, m
  std::optional<std::pair<Vec3, double>> sphere;  ///< centre and radius, m
  bool operator==(const ElementSelection&) const = default;
};

inline constexpr double usual_shrink = 0.2;  ///< of liver
inline constexpr double max_shrink = 0.5;    ///< beyond what tissue does

/// What an electrode does at its path (mesh/burn.hpp).
struct Heat {
  double radius = 0;             ///< m, about the path: tissue farther away stays as it is
  double shrink = usual_shrink;  ///< part of their length that coagulated lengths lose, 0 to max_shrink
};

/// Elements that are to be a region. By nodes: those whose four corners are all among them.
struct RegionTag {
  std::vector<int> nodes;      ///< mesh-file order; empty: `which` chooses
  ElementSelection which;
  std::string name;            ///< of the region, which is there, or new
  std::optional<int> number;   ///< its tag; none: that of the name, or one more than the largest there is
  bool operator==(const RegionTag&) const = default;
};

/// A tag with its elements and number found.
struct TaggedRegion {
  int number = 0;
  std::string name;
  std::vector<int> tets;  ///< mesh-file order, ascending
  bool operator==(const TaggedRegion&) const = default;
};

/// Finds the selected elements of a topology, ascending. Returns a message if an element does not exist or was removed
/// before, or if none is selected. mesh: at rest.
Status select_elements(const ElementSelection& which, const TetMesh& mesh, const Topology& topology,
                       std::vector<int>& chosen);

/// Computes the edit that removes the selected elements of a topology. Returns a message as select_elements(), or if no
/// element would be left. mesh: at rest.
Status make_removal_edit(const ElementSelection& which, const TetMesh& mesh, const Topology& topology, MeshEdit& edit);

/// The mesh with the given elements only, in that order, and all nodes and fields.
TetMesh with_elements(const TetMesh& mesh, const std::vector<int>& elements);

/// The same for values of elements, `each` per element; none of an empty list.
template <class Value>
std::vector<Value> with_elements(const std::vector<Value>& values, const std::vector<int>& elements,
                                 std::size_t each = 1) {
  std::vector<Value> taken;
  if (values.empty()) return taken;
  taken.reserve(each * elements.size());
  for (const int t : elements) {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(each * static_cast<std::size_t>(t));
    taken.insert(taken.end(), first, first + static_cast<std::ptrdiff_t>(each));
  }
  return taken;
}

/// The boundary of the elements of a topology (mesh/quadratic.hpp); it names them by their index there.
BoundaryFaces fine_boundary(const TetMesh& mesh, const MidEdges& midedges, const Topology& topology);

}  // namespace heml
