#pragma once
// Better tetrahedra between the same nodes: edges are taken out and their surroundings filled anew (Klincsek's
// polygons; Freitag & Ollivier-Gooch 1997), faces are swapped for edges.
//
//          b                        b
//        / | \   the ring of      /   \   a triangulation of the polygon p,
//      p0–-|--p2  tetrahedra    p0-----p2  each triangle with a tetrahedron
//        \ p1/    round ab        \ p1/    up to b and one down to a
//          a                        a
#include "improve.hpp"

namespace heml::make {

struct Reconnect {
  Quality quality;
  double enough;  ///< fewer tetrahedra are preferred as long as the worst of them stays above this
  double bend;    ///< cosine: how far the surface may turn where an edge of it is swapped; 2 keeps the surface
};

/// One sweep over the edges and the faces between tetrahedra; returns the number of changes.
int reconnect(TetMesh& mesh, const Reconnect& options);

}  // namespace heml::make
