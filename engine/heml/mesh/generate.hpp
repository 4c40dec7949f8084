#pragma once
// Meshes that need no file.
#include <heml/mesh/tet_mesh.hpp>

namespace heml {

/// A block of cells, 5 tetrahedra each, mirrored between neighbours (the paper's regular cubes). Nodes x fastest, then
/// y, then z. size: m; cells ≥ 1 each, (nx+1)(ny+1)(nz+1) nodes.
TetMesh make_box(const Vec3& size, const std::array<int, 3>& cells, const Vec3& origin = Vec3::Zero());

}  // namespace heml
