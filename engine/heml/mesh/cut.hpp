#pragma once
// Cutting: elements are split where a blade went, and come apart along it. Nothing is lost and nothing moves.
//
//   1 crossings   edges that go through the swept surface; one that does so near an end counts as going through that
//                 end (snapping), so that no short edge is made; another one too, further away, where a thin piece
//                 would be
//   2 split       every crossed edge is halved in all elements that have it, in the order of edges: pieces of
//                 neighbours match, and their edges lie on one side of the cut or in it
//   3 part        faces whose nodes all lie in the cut, with a side of it each, come apart: a node is copied for each
//                 further group of pieces that hang together round it. Where the cut ends inside, they still do.
#include <heml/mesh/edit.hpp>
#include <heml/mesh/sweep.hpp>

namespace heml {

struct Cut {
  MeshEdit edit;
  std::vector<int> nodes;  ///< that lie in the cut, ascending, in numbers after the edit: where a stroke goes on
  double area = 0;         ///< m², as the body is now, of the faces that came apart
};

/// The cut a sweep makes; or why there is none, in words. mesh: at rest. x: its nodes now, #V×3, m; the sweep is seen
/// there. snap: m at rest; the cut lies within it of the sweep. stroke: Cut::nodes of the sweeps this one goes on from.
std::optional<std::string> make_cut(const Sweep& sweep, const TetMesh& mesh, const std::vector<Vec3>& x,
                                    const Topology& topology, double snap, const std::vector<int>& stroke, Cut& cut);

/// A snapping distance that suits a mesh: half its mean edge, m.
double snapping_distance(const TetMesh& mesh);

}  // namespace heml
