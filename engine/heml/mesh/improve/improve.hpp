#pragma once
// Improves the shapes of tetrahedra by local operations, worst elements first: nodes are moved, edges and faces
// swapped, short edges collapsed, long ones split (after B. Klingner & J. Shewchuk, Aggressive tetrahedral mesh
// improvement, 16th International Meshing Roundtable, 2007). The boundary and interfaces between regions stay within a
// tolerance.
#include <functional>
#include <heml/mesh/tet_mesh.hpp>
#include <optional>

namespace heml {

struct ImproveOptions {
  double min_angle = 10;                    ///< degrees, dihedral, wanted of every element
  std::optional<int> tets;                  ///< wanted number of elements; none: what the shapes need
  std::optional<double> surface_tolerance;  ///< m; none: 0.5 % of the diagonal of the bounding box
  std::function<void(double fraction, const char* doing)> progress;  ///< none: quiet
};

struct Improvement {
  TetMesh mesh;  ///< nodes in another order, without orphans; fields as of the nearest old element of the same region
  double surface_tolerance = 0;  ///< m
  double surface_distance = 0;   ///< m, between the old and the new surface (surface_tree.hpp)
  int untangled = 0;             ///< elements that were inverted
  std::vector<int> below;        ///< elements of the new mesh that miss the wanted angle, the worst first
};

/// Improves a mesh, inverted elements included. Throws InputError for a mesh that is no body (quality.hpp, orient.hpp)
/// and for inverted elements that cannot be untangled. Deterministic; the work is bounded by counts, no clock.
Improvement improve(TetMesh mesh, const ImproveOptions& options = {});

}  // namespace heml
