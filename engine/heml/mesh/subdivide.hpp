#pragma once
// A finer mesh of the same body: every tetrahedron in eight, by the middles of its edges.
#include <heml/mesh/tet_mesh.hpp>
#include <vector>

namespace heml {

struct Subdivision {
  TetMesh mesh;  ///< old nodes first, in their order, then middles; element t becomes 8t to 8t+7, with its region and
                 ///< fields
  std::vector<std::array<int, 2>> ends;  ///< of each middle, the old nodes it lies between
};

/// mesh: as check_tets() leaves it. Linear functions on the old mesh are linear functions on the new one. The
/// octahedron that four corners leave is cut along its shortest diagonal, so shapes do not degenerate however often it
/// is done (Bey: Tetrahedral grid refinement, Computing 55, 1995, asks for no more than three shapes; this for the
/// best).
Subdivision subdivide_uniformly(const TetMesh& mesh);

}  // namespace heml
