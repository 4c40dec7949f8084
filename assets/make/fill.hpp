#pragma once
// From a closed surface to tetrahedra.
#include <heml/mesh/tet_mesh.hpp>
#include <string>

#include "shape.hpp"

namespace heml::make {

/// Places of a body-centred lattice of that spacing that lie deeper than `depth` under the surface of the shape, m.
std::vector<Vec3> interior_lattice(const Shape& shape, const Vec3& low, const Vec3& high, double depth, double spacing);

/// Tetrahedra between the nodes of a closed surface, which keeps its triangles, and the interior nodes, by TetGen.
/// Nodes: the surface's, then the interior ones.
TetMesh fill(const TriangleMesh& surface, const std::vector<Vec3>& interior);

/// The Delaunay tetrahedra of a cloud of points, by TetGen.
TetMesh delaunay(const std::vector<Vec3>& points);

}  // namespace heml::make
