#pragma once
// The boundary of a tetrahedral mesh.
#include <heml/mesh/tet_mesh.hpp>
#include <vector>

namespace heml {

/// Faces that belong to one tetrahedron only, outward by the right-hand rule for positive tetrahedra.
struct BoundaryFaces {
  std::vector<Triangle> triangles;  ///< #F×3, into the mesh's nodes
  std::vector<int> tets;            ///< #F, the tetrahedron behind each
};

/// In ascending order of (tetrahedron, local face): depends on the mesh alone.
BoundaryFaces extract_boundary(const TetMesh& mesh);

}  // namespace heml
