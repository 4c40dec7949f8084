#pragma once
// Checks and quality report of a mesh before it is simulated.
#include <heml/mesh/quadratic.hpp>
#include <string>
#include <vector>

namespace heml {

struct QualityReport {
  int nodes = 0, tets = 0, regions = 0;
  double volume = 0;                           ///< m³
  Vec3 low, high;                              ///< m, bounding box of the tetrahedra
  int flipped = 0;                             ///< tetrahedra whose winding was repaired
  int slivers = 0;                             ///< tetrahedra with a dihedral angle below 5°
  int worst_tet = -1;                          ///< tetrahedron with the smallest dihedral angle
  double worst_dihedral = 0;                   ///< that angle, degrees
  double shortest_edge = 0, longest_edge = 0;  ///< m
  int orphans = 0;                             ///< nodes of no tetrahedron
  int duplicates = 0;                          ///< nodes with the position of another
  int components = 0;                          ///< parts that share no node
  int nonmanifold_edges = 0;                   ///< boundary edges without exactly two boundary faces
  std::vector<std::string> warnings;           ///< one sentence per finding
};

/// Smallest dihedral angle of a tetrahedron, degrees.
double min_dihedral(const std::array<Vec3, 4>& x);

/// Throws InputError, naming the element or node, for no tetrahedra, fields of wrong size, an invalid index, a node
/// twice in one element, a coordinate that is not finite or too large.
void check_connectivity(const TetMesh& mesh);

/// Checks a mesh and repairs winding in place. Throws InputError as check_connectivity(), and for zero volume.
/// midedges: of quadratic elements, whose nodes belong to elements and whose order is repaired too.
QualityReport check_tets(TetMesh& mesh, MidEdges* midedges = nullptr);

/// The report as text, in lines.
std::string to_text(const QualityReport& report);

}  // namespace heml
