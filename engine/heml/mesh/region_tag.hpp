#pragma once
// Regions that are chosen by hand, beside those of the mesh file: a scene's `regions` and the event `region`.
#include <heml/mesh/edit.hpp>

namespace heml {

/// Finds the elements and the number. Returns a message where it chooses no element, one that does not exist or was
/// removed, where the name is empty or of another region, or where the number has another name.
Status resolve_region(const RegionTag& tag, const TetMesh& mesh, const Topology& topology, TaggedRegion& region);

/// Gives the elements of a mesh their region, and the region its name.
void tag_region(const TaggedRegion& region, TetMesh& mesh);

}  // namespace heml
