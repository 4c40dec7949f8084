#pragma once
// Interpolates the motion of one mesh at the nodes of another.
#include <heml/mesh/tet_mesh.hpp>

namespace heml {

/// Positions of material points (m), given at rest: linear in the element that contains the point; outside the mesh, in
/// the element whose smallest barycentric coordinate is largest. x: positions of the nodes, #V × 3, m.
std::vector<Vec3> sample_motion(const TetMesh& mesh, const std::vector<Vec3>& x, const std::vector<Vec3>& points);

}  // namespace heml
