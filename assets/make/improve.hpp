#pragma once
// Better tetrahedra without new nodes.
#include <functional>
#include <heml/mesh/tet_mesh.hpp>

namespace heml::make {

/// How good a tetrahedron is, at most 1; negative when it is turned inside out.
struct Quality {
  double edge;  ///< m

  /// The lesser of two: the least sine of its six dihedral angles, which says how far it is from flat, and its least
  /// altitude over `edge`, which limits the time step of explicit methods.
  double operator()(const Vec3& x0, const Vec3& x1, const Vec3& x2, const Vec3& x3) const;
};

/// Where node n may go when it is asked to go to p; p itself: anywhere.
using Constraint = std::function<Vec3(int n, const Vec3& p)>;

/// Moves nodes, one at a time and in their order, so that the worst element round each gets better, until it is
/// `enough`. Returns the number of moves.
int smooth(TetMesh& mesh, const Quality& quality, const Constraint& constraint, double enough, int rounds);

}  // namespace heml::make
