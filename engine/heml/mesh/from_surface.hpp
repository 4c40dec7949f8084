#pragma once
// From a surface file to tetrahedra. assimp and TetGen run in a helper process (heml-mesher) with limits on time and
// memory: TetGen ends its host on bad input, and neither is needed for a tetrahedral mesh.
#include <filesystem>
#include <heml/mesh/tet_mesh.hpp>
#include <optional>
#include <string>

namespace heml {

struct TetgenOptions {
  double radius_edge_ratio = 1.4;    ///< the smaller the better shaped and the more
  std::optional<double> max_volume;  ///< m³ of one tetrahedron; only a kept surface that is coarser leaves larger ones
  double time_limit = 120;           ///< s
  double memory_limit = 4e9;         ///< bytes
};

/// Any surface assimp reads (OBJ, STL, PLY, ...), equal vertices joined, triangles only. Throws InputError.
TriangleMesh read_surface(const std::filesystem::path& path);

/// Why a surface cannot be filled (open, non-manifold, self-intersecting, ...): throws InputError that names edge or
/// triangle. Turns all triangles outward first, and smooths away creases that run through themselves (untangle.hpp).
void check_surface(TriangleMesh& surface);

/// Fills a closed surface, all but its cavities; its triangles are kept, its nodes come first, in order and, as
/// check_surface() leaves them, to the bit. Throws InputError when TetGen fails, takes too long, or makes nothing;
/// warns of tetrahedra larger than asked for.
TetMesh tetrahedralize(const TriangleMesh& surface, const TetgenOptions& options = {});

/// What is odd about the size of a body in metres: "18 m long: is the file in centimetres? ...", or empty.
std::string unit_warning(const Vec3& low, const Vec3& high);

}  // namespace heml
