#pragma once
// From a surface file to tetrahedra. assimp and TetGen run in a helper process (heml-mesher) with limits on time and memory:
// TetGen ends its host on bad input, and neither is needed for a tetrahedral mesh.
#include <filesystem>
#include <heml/mesh/tet_mesh.hpp>
#include <optional>
#include <string>

namespace heml {

struct TetgenOptions {
  double radius_edge_ratio = 1.4;    ///< the smaller the better shaped and the more
  std::optional<double> max_volume;  ///< m³ of one tetrahedron
  double time_limit = 120;           ///< s
  double memory_limit = 4e9;         ///< bytes
};

/// Any surface assimp reads (OBJ, STL, PLY, ...), equal vertices joined, triangles only. Throws InputError.
SurfaceMesh read_surface(const std::filesystem::path& path);

/// Why a surface cannot be filled (open, non-manifold, self-intersecting, ...): throws InputError that names edge or
/// triangle. Turns all triangles outward first.
void check_surface(SurfaceMesh& surface);

/// Fills a closed surface; the surface's nodes come first and keep their order. Throws InputError when TetGen fails, takes
/// too long, or makes nothing.
TetMesh tetrahedralize(const SurfaceMesh& surface, const TetgenOptions& options = {});

/// What is odd about the size of a body in metres: a sentence ("2.3 m long: is the file in millimetres? ..."), or empty.
std::string unit_suspicion(const Vec3& low, const Vec3& high);

}  // namespace heml
