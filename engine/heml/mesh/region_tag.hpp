#pragma once
// Regions that are chosen by hand, beside those of the mesh file: a scene's `regions` and the event `region`.
#include <heml/mesh/edit.hpp>

namespace heml {

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

/// Finds the elements and the number. Returns a message where it chooses no element, one that does not exist or was
/// removed, where the name is empty or of another region, or where the number has another name.
Status resolve_region(const RegionTag& tag, const TetMesh& mesh, const Topology& topology, TaggedRegion& region);

/// Gives the elements of a mesh their region, and the region its name.
void tag_region(const TaggedRegion& region, TetMesh& mesh);

}  // namespace heml
