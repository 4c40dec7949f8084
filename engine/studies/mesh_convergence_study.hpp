#pragma once
// Mesh errors: the equilibrium of a body under its loads, on its own mesh and on uniform subdivisions of it (every
// tetrahedron in eight). Meshes are nested, so all are compared at the nodes of the first.
//
//    u₀ ──d₀₁── u₁ ──d₁₂── u₂ ─ ─ ─ u*     d falls by 2^p a mesh; u* = u₂ + (u₂ − u₁)/(2^p − 1)   (Richardson)
//
// Coarse, too stiff meshes show an order p below the asymptotic 2 of linear elements; extrapolation with that p goes
// too far, with 2 not far enough. u* is the mean of both extrapolations and its uncertainty half their distance. Errors
// are measured from the u* of the element with the smallest uncertainty; those of other elements are compared with it.
// Quadratic elements, of which a mesh has as many nodes as the next of linear ones, take one subdivision less, and so
// have no u* of their own where there are three meshes of linear ones.
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
  double order = 0;                                      ///< p of the three finest meshes
  double uncertainty = 0;                                ///< m, half the rms distance of the two extrapolations
  double motion = 0;                                     ///< m, rms of u*
  Vec3 far = Vec3::Zero();                               ///< m, u* of the node that moves farthest
  std::optional<double> between_elements;                ///< m, largest rms distance to the u* of another element
  double resolution() const { return 2 * uncertainty; }  ///< m, smallest error it resolves
};

struct MeshConvergenceStudy {
  Extrapolation reference;
  std::vector<Vec3> best;  ///< u* as positions, #V of the first mesh; empty: none
  std::vector<ConvergenceMesh> meshes;
  const ConvergenceMesh* find(const std::string& element, int halvings) const;
};

/// Richardson extrapolation of nested solutions x (three or more; #V × 3, m) at the same nodes. rest: positions where u
/// is 0. Fails if the order is below 0.5 or above 4. best: u* as positions, set on success.
Extrapolation extrapolate(const std::vector<std::vector<Vec3>>& x, const std::vector<Vec3>& rest,
                          const std::vector<double>& mass, std::vector<Vec3>& best);

/// Π* of nested meshes (three or more) and half the difference of its two extrapolations, both J; none if Π does not
/// fall with an order from 0.5 to 4.
struct Potential {
  double best, uncertainty;
};
std::optional<Potential> extrapolate(const std::vector<double>& potentials);

/// Applies the scene's full loads without its events. key: prefix in the results. halvings: subdivisions of the finest
/// mesh. Studies all of elements_of(). Requires linear_base(). best and
/// errors are at its nodes.
MeshConvergenceStudy study_mesh_convergence(const std::string& key, const Problem& problem, int halvings,
                                            const StudyContext& context);
std::size_t steps_of_mesh_convergence_study(const Problem& problem, int halvings);

/// Node positions at static equilibrium, #V × 3, m; empty if the solve fails.
std::vector<Vec3> equilibrium_positions(const std::string& key, const Problem& problem, const StudyContext& context);

/// Number of uniform subdivisions, at most `halvings`, that keep a mesh within `most` tetrahedra.
int halvings_within(std::size_t tets, std::size_t most, int halvings);

}  // namespace heml
