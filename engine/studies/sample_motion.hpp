#pragma once
// Interpolates the motion of one mesh at the nodes of another.
#include <heml/mesh/tet_mesh.hpp>

namespace heml {

/// Positions of material points, #points × 3, m: linear in the element that contains the point at rest; outside the
/// mesh, in the element with the largest smallest barycentric coordinate. points: rest positions. x: positions of the
/// nodes, #V × 3, m.
std::vector<Vec3> sample_motion(const TetMesh& mesh, const std::vector<Vec3>& x, const std::vector<Vec3>& points);

}  // namespace heml
