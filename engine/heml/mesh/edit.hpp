#pragma once
// Edits of a mesh's topology, as values: tools make them, a world carries them out, whoever draws follows.
//
// Numbers outlive edits. Nodes and elements are called what the mesh file calls them for as long as a body lives;
// what is gone leaves a gap:
//
//     file          0 1 2 3 4 5 6 7
//     MeshEdit        ×     ×       + +   removed {1, 4}, added {8, 9}
//     Topology      0   2 3   5 6 7 8 9   elements; version 1
#include <heml/mesh/tet_mesh.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace heml {

/// A node that an edit adds, on the edge between two that were there; from == to: a copy of that one.
struct InsertedNode {
  int from, to;
  double at;  ///< 0 at from, 1 at to; at rest and now
};

/// What is to become of a mesh of #V nodes and #T elements.
struct MeshEdit {
  std::vector<int> removed;         ///< elements that go, ascending, each once
  std::vector<InsertedNode> nodes;  ///< numbers #V, #V + 1, …
  std::vector<Tet> added;           ///< numbers #T, #T + 1, …; into old and new nodes
  std::vector<int> parents;         ///< of each added, one of the removed, whose part it is; ascending
};

/// Which elements are there. Never changes: an edit makes another one, and all who draw or write share it.
struct Topology {
  long version = 0;           ///< grows with every change, never comes back
  std::vector<int> elements;  ///< ascending
};

/// All of a mesh.
Topology whole(const TetMesh& mesh, long version = 0);

/// What an edit leaves of a topology of a mesh of #T elements. Everything it removes must be there.
Topology apply_edit(const Topology& topology, const MeshEdit& edit, int elements);

/// Adds an edit's nodes and elements to a mesh: at rest between those they come from, of their parent's region and
/// fields. What it removes stays, as a gap in the topology.
void append(const MeshEdit& edit, TetMesh& mesh);

/// Values of nodes (each × #V) continued on an edit's nodes.
template <class Value>
void append(const MeshEdit& edit, std::vector<Value>& values, std::size_t each = 1) {
  for (const InsertedNode& node : edit.nodes)
    for (std::size_t c = 0; c < each; ++c) {
      const Value from = values[each * static_cast<std::size_t>(node.from) + c];
      const Value to = values[each * static_cast<std::size_t>(node.to) + c];
      values.push_back(node.from == node.to ? from : Value(from + (to - from) * node.at));
    }
}

/// Elements chosen in one of four ways, by numbers or by what they are at rest; closed sets.
struct ElementSelection {
  std::vector<int> tets;  ///< where none of the others is given
  std::optional<int> region;
  std::optional<std::array<Vec3, 2>> box;         ///< of centroids, lower and upper corner, m
  std::optional<std::pair<Vec3, double>> sphere;  ///< of centroids, centre and radius, m
};

/// The edit that removes what is chosen of what is there; or what is wrong with it, in words: an element that there is
/// not or no more, nothing chosen, nothing left. mesh: at rest.
std::optional<std::string> make_removal_edit(const ElementSelection& which, const TetMesh& mesh,
                                             const Topology& topology, MeshEdit& edit);

/// The mesh with the given elements alone, in that order, and all its nodes and fields.
TetMesh with_elements(const TetMesh& mesh, const std::vector<int>& elements);

/// The same of one value an element, or of `each` values.
template <class Value>
std::vector<Value> with_elements(const std::vector<Value>& values, const std::vector<int>& elements,
                                 std::size_t each = 1) {
  std::vector<Value> taken;
  taken.reserve(each * elements.size());
  for (const int t : elements) {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(each * static_cast<std::size_t>(t));
    taken.insert(taken.end(), first, first + static_cast<std::ptrdiff_t>(each));
  }
  return taken;
}

}  // namespace heml
