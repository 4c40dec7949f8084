#pragma once
// Mesh errors: the equilibrium of a body under its loads, on its own mesh and on uniform subdivisions of it (every
// tetrahedron in eight). Meshes are nested, so all are compared at the nodes of the first.
//
//    u₀ ──d₀₁── u₁ ──d₁₂── u₂ ─ ─ ─ u*     d falls by 2^p a mesh; u* = u₂ + (u₂ − u₁)/(2^p − 1)   (Richardson)
//
// Coarse, too stiff meshes show an order p below the 2 of linear elements in smooth solutions; extrapolation with that
// p goes too far, with 2 not far enough. u* is the mean of both extrapolations and its uncertainty half their distance.
// Where clamps end on a smooth surface the solution is singular and the order of any element is 1.
//
// Quadratic elements, of which a mesh has as many nodes as the next of linear ones, take one subdivision less: two
// meshes, extrapolated with the order of p1, at most 2, which theirs is never below, and with 3. Their u* is mostly the
// better one (a beam: 0.2 % of the motion against 18 %). Errors are measured from the u* with the smallest uncertainty.
//
// The error estimate of the panel (elastic/error_estimate.hpp) is compared with the energy norm of the error, which
// follows from the potential Π at equilibrium: ‖u − u_h‖² = 2 (Π_h − Π*) to leading order, Π* extrapolated like u*.
// This holds for linear tetrahedra, whose Π_h is never below Π*, under dead loads.
#include <studies/study_context.hpp>

namespace heml {

/// The equilibrium of a body on one mesh.
struct ConvergenceMesh {
  std::string element;  ///< name
  int halvings = 0;
  std::size_t nodes = 0, tets = 0;
  double seconds = 0;   ///< wall time of the static solve
  std::string failed;   ///< empty: the static solve converged
  double error = 0;     ///< m, mass-weighted rms over the nodes of the first mesh; at least the resolution
  double relative = 0;  ///< error over the motion
  bool resolved = true;
  Vec3 far = Vec3::Zero();                    ///< m, displacement of the node that moves farthest on the first mesh
  double moved = 0;                           ///< m, rms displacement
  double stored = 0, potential = 0;           ///< J, elastic energy; Π
  std::optional<double> estimated;            ///< J, squared energy norm of the error, as the panel estimates it
  std::optional<double> known;                ///< J, the same, from finer meshes
  std::optional<double> effectivity() const;  ///< √(estimated / known); 1: exact
  double estimated_length() const;            ///< m, the motion times e²/‖u‖²
};

/// u* and its uncertainty.
struct Extrapolation {
  std::string failure;                                   ///< empty: success
  std::string element;                                   ///< name
  std::size_t meshes = 0;                                ///< how many were solved
  double low = 0, high = 0;                              ///< orders of the two extrapolations
  std::vector<Vec3> best;                                ///< u* as positions, m, #V of the first mesh; empty: none
  double uncertainty = 0;                                ///< m, half the rms distance of the two extrapolations
  double motion = 0;                                     ///< m, rms of u*
  Vec3 far = Vec3::Zero();                               ///< m, u* of the node that moves farthest
  std::optional<double> between_elements;                ///< m, largest rms distance to the u* of another element
  double resolution() const { return 2 * uncertainty; }  ///< m, smallest error it resolves
};

struct MeshConvergenceStudy {
  Extrapolation reference;
  std::vector<ConvergenceMesh> meshes;
  const ConvergenceMesh* find(const std::string& element, int halvings) const;
};

/// Richardson extrapolation of nested solutions x of linear elements (three or more; #V × 3, m) at the same nodes.
/// rest: positions where u is 0. Fails if the order is below 0.25 or above 4.
Extrapolation extrapolate(const std::vector<std::vector<Vec3>>& x, const std::vector<Vec3>& rest,
                          const std::vector<double>& mass);
/// The same of quadratic elements (two or more), with that of linear ones under the same loads.
Extrapolation extrapolate_quadratic(const std::vector<std::vector<Vec3>>& x, const Extrapolation& linear,
                                    const std::vector<Vec3>& rest, const std::vector<double>& mass);

/// Π* of nested meshes (three or more) and half the difference of its two extrapolations, both J; none if Π does not
/// fall with an order from 0.5 to 4.
struct Potential {
  double best, uncertainty;
};
std::optional<Potential> extrapolate(const std::vector<double>& potentials);

/// Applies the scene's full loads without its events. key: prefix in the results. halvings: subdivisions of the finest
/// mesh. Studies all of elements_of(), and p1. Requires linear_base(). u* and errors are at the nodes of its mesh.
MeshConvergenceStudy study_mesh_convergence(const std::string& key, const Problem& problem, int halvings,
                                            const StudyContext& context);
std::size_t steps_of_mesh_convergence_study(const Problem& problem, int halvings);

/// Node positions at static equilibrium, #V × 3, m; empty if the solve fails.
std::vector<Vec3> equilibrium_positions(const std::string& key, const Problem& problem, const StudyContext& context);

/// Number of uniform subdivisions, at most `halvings`, that keep a mesh within `most` tetrahedra.
int halvings_within(std::size_t tets, std::size_t most, int halvings);

}  // namespace heml
