#pragma once
// The quality of a tetrahedron that the improver raises: the sine of its worst dihedral angle, and past a goal its
// smallest altitude as well, on which the stable step of explicit methods depends.
//
//    quality = min( min sin(dihedral),  goal + altitude_rate · max(smallest altitude, 0) )
//
// Continuous; an element with an angle below the goal is worse than any with a small altitude. Negative for elements
// that are inverted, so that raising it untangles them.
#include <heml/mesh/tet_mesh.hpp>
#include <vector>

namespace heml {

using Corners = std::array<Vec3, 4>;

/// A term of the minimum, and its gradient by the position of one corner.
struct ShapeTerm {
  double value;
  Vec3 gradient;  ///< 1/m
};

struct ShapeMeasure {
  double goal = 1;           ///< sine of the dihedral angle from which altitudes count
  double altitude_rate = 0;  ///< 1/m
  double volume_rate = 0;  ///< 1/m³; greater than 0: quality is this times the volume, and nothing else. Concave in the
                           ///< position of each node, so that smoothing untangles where it can be done.

  /// −1 for faces without area.
  double operator()(const Corners& x) const;
  /// Appends the terms below `limit` with their gradients by one corner.
  void append_terms(const Corners& x, int corner, double limit, std::vector<ShapeTerm>& terms) const;
};

/// The smallest altitude of a tetrahedron, m; negative where it is inverted.
double smallest_altitude(const Corners& x);

}  // namespace heml
