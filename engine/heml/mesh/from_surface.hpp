#pragma once
// Tetrahedral meshing of surfaces. assimp and TetGen run in a helper process (heml-mesher) with limits on time and
// memory: TetGen terminates its host on bad input, and builds without them still read tetrahedral meshes.
#include <filesystem>
#include <heml/mesh/mesher_process.hpp>
#include <heml/mesh/tet_mesh.hpp>
#include <optional>
#include <string>

namespace heml {

struct TetgenOptions {
  double radius_edge_ratio = 1.4;    ///< smaller: better shapes, more tetrahedra
  std::optional<double> max_volume;  ///< m³ per tetrahedron; exceeded only at surface triangles too large for it
  double time_limit = 120;           ///< s
  double memory_limit = 4e9;         ///< bytes
};

/// Reads a surface in any format of assimp (OBJ, STL, PLY, ...). Merges vertices of equal position; keeps triangles
/// only. Throws InputError.
TriangleMesh read_surface(const std::filesystem::path& path);

/// Limits of the helper that reads a surface of so many bytes.
ProcessLimits surface_reading_limits(double file_bytes);

/// Throws InputError for no triangles, indices of no node, and positions that are not finite or too large.
void check_numbers(const TriangleMesh& surface);

/// Whether a triangle has an area beyond round-off of its corners.
bool has_area(const Vec3& a, const Vec3& b, const Vec3& c);

/// Throws InputError, naming edge or triangle, if a surface cannot be filled (open, non-manifold, self-intersecting,
/// ...). Orients all triangles outward and smooths self-intersecting creases (untangle.hpp).
void check_surface(TriangleMesh& surface);

/// Throws InputError for options without sense.
void check_options(const TriangleMesh& surface, const TetgenOptions& options);

/// Fills a closed surface except its cavities with tetrahedra. Keeps the triangles; the surface's nodes come first, in
/// order, with the exact positions that check_surface() gives them. Throws InputError if TetGen fails, exceeds a limit,
/// or returns nothing; warns of tetrahedra larger than max_volume.
TetMesh tetrahedralize(const TriangleMesh& surface, const TetgenOptions& options = {});

/// A warning if the size of a body suggests a wrong unit ("18 m long: is the file in centimetres? ..."), or empty. low,
/// high: bounding box, m.
std::string unit_warning(const Vec3& low, const Vec3& high);

}  // namespace heml
