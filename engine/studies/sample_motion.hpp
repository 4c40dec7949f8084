#pragma once
// The motion of one mesh at the points of another.
#include <heml/mesh/tet_mesh.hpp>

namespace heml {

/// Where a body's points are, #points × 3, m: linear in the element that holds each at rest, or in the nearest one of a
/// point outside. x: positions of the mesh's nodes, #V × 3.
std::vector<Vec3> sample_motion(const TetMesh& mesh, const std::vector<Vec3>& x, const std::vector<Vec3>& points);

}  // namespace heml
