#pragma once
// Generated meshes.
#include <heml/mesh/tet_mesh.hpp>

namespace heml {

/// A block of nx × ny × nz cells of 5 tetrahedra each, mirrored between neighbours (the paper's regular cubes), with
/// (nx+1)(ny+1)(nz+1) nodes, x fastest, then y, then z. size, origin: m; cells ≥ 1 each. Throws InputError.
TetMesh make_box(const Vec3& size, const std::array<int, 3>& cells, const Vec3& origin = Vec3::Zero());

}  // namespace heml
