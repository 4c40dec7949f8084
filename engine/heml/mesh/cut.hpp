#pragma once
// Cutting: elements are split along the surface that a blade sweeps, and separated there. The volume is kept and no
// node moves.
//
//   1 crossings   finds the edges that intersect the swept surface. An intersection near an end of the edge is snapped
//                 to that node, so that no short edges result; one further away too, where it would make a thin piece
//   2 split       divides every crossed edge in all its elements, in the order of edges, so that pieces of neighbours
//                 match; every edge of a piece then lies on one side of the cut or in it
//   3 separate    separates pieces at faces in the cut that have a piece on each side: a node is copied for every
//                 further group of face-connected pieces round it. Where the cut ends inside, they stay connected
#include <heml/mesh/blade_front.hpp>
#include <heml/mesh/edit.hpp>
#include <heml/mesh/sweep.hpp>

namespace heml {

/// What the sweeps of a stroke leave to the next one.
struct Stroke {
  std::vector<int> nodes;                   ///< nodes in the cut, ascending
  std::vector<std::array<int, 3>> closed;   ///< faces in the cut that no node could be copied at yet, sorted
  std::vector<std::pair<int, bool>> sides;  ///< nodes beside the cut, ascending, and whether on its upper side
  Heading heading;                          ///< where the last sweep ended
  BladeFront front;                         ///< where the last sweep ended
};

struct Cut {
  MeshEdit edit;
  Stroke stroke;    ///< as numbered after the edit; input of the stroke's next sweep
  double area = 0;  ///< m², deformed area of the faces that came apart
};

/// Computes the cut of a sweep. Returns a message if the sweep cuts nothing. mesh: at rest. x: deformed positions,
/// #V×3, m, in whose space the sweep is. snap: m at rest; the cut lies within this distance of the sweep. stroke:
/// Cut::stroke of the earlier sweeps of the same stroke.
Status make_cut(const Sweep& sweep, const TetMesh& mesh, const std::vector<Vec3>& x, const Topology& topology,
                double snap, const Stroke& stroke, Cut& cut);

/// Default snapping distance of a mesh: half its mean edge length, m.
double snapping_distance(const TetMesh& mesh);

}  // namespace heml
