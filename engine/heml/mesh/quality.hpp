#pragma once
// What a mesh is like, said before anything is simulated with it.
#include <heml/mesh/tet_mesh.hpp>
#include <string>
#include <vector>

namespace heml {

struct QualityReport {
  int nodes = 0, tets = 0, regions = 0;
  double volume = 0;                           ///< m³
  Vec3 low, high;                              ///< m, bounding box of the tetrahedra
  int flipped = 0;                             ///< tetrahedra whose winding was repaired
  int slivers = 0;                             ///< with a smallest dihedral angle under 5°
  int worst_tet = -1;                          ///< file order
  double worst_dihedral = 0;                   ///< degrees, of worst_tet
  double shortest_edge = 0, longest_edge = 0;  ///< m
  int orphans = 0;                             ///< nodes of no tetrahedron
  int duplicates = 0;                          ///< nodes at the very place of another
  int components = 0;                          ///< bodies not connected by a node
  int nonmanifold_edges = 0;                   ///< of the boundary
  std::vector<std::string> warnings;           ///< sentences, one each for what is worth a person's attention
};

/// The smallest angle between two faces of a tetrahedron, degrees.
double min_dihedral(const std::array<Vec3, 4>& x);

/// Checks a mesh and repairs winding in place. Throws InputError for what cannot be repaired: no tetrahedra, an index
/// outside the nodes, a coordinate that is not finite, a node twice in one element, a volume of zero; it names the
/// element.
QualityReport check_tets(TetMesh& mesh);

/// The report as lines for a person.
std::string to_text(const QualityReport& report);

}  // namespace heml
