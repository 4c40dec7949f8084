#pragma once
// Removes scraps from a mesh of labels: a few elements of a label apart from the rest of it.
#include <heml/mesh/tet_mesh.hpp>

namespace heml {

/// Gives components (of elements that share faces) of a region with fewer than 10 elements and 2 % of it to the region
/// that they share most faces with; those that share most with the outside are taken out.
void merge_scraps(TetMesh& mesh);

}  // namespace heml
