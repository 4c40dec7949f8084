#pragma once
// Faces of tetrahedra, matched by their nodes.
#include <cstdint>
#include <heml/mesh/tet_mesh.hpp>
#include <span>
#include <vector>

namespace heml {

/// Local faces of a positive tetrahedron, outward by the right-hand rule; face f lies opposite node f.
inline constexpr std::array<std::array<int, 3>, 4> tet_faces{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// For each face, at 4·tet + local face, the number of tetrahedra with the same three nodes as a face (4 #T, at most
/// 255). Indices must be valid. Linear time for meshes with a bounded number of elements per node.
std::vector<std::uint8_t> face_counts(std::span<const Tet> tets, int nodes);

}  // namespace heml
