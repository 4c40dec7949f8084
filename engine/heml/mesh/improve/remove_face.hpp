#pragma once
// Removes faces between two nodes and joins these by an edge: the 2-3 flip, and its like for several faces (multi-face
// removal: J. Shewchuk, Two discrete optimization algorithms for the topological improvement of tetrahedral meshes,
// 2002), the inverse of edge removal.
#include <heml/mesh/improve/local_mesh.hpp>

namespace heml {

/// Returns whether faces, the given one among them, were removed, which raised the worst quality concerned.
bool remove_face(LocalMesh& mesh, int tet, int face);

}  // namespace heml
