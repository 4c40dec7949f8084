#pragma once
// The boundary of a tetrahedral mesh.
#include <heml/mesh/tet_mesh.hpp>
#include <vector>

namespace heml {

/// Faces of exactly one tetrahedron, outward by the right-hand rule for tetrahedra of positive volume.
struct BoundaryFaces {
  std::vector<Triangle> triangles;  ///< #F×3, indices of the mesh's nodes
  std::vector<int> tets;            ///< #F, the tetrahedron behind each
};

/// The boundary faces in ascending order of (tetrahedron, local face).
BoundaryFaces extract_boundary(const TetMesh& mesh);

}  // namespace heml
