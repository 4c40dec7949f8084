#pragma once
// Errors of the mesh: where a body comes to rest under its loads, on its own mesh and on finer ones with every
// tetrahedron in eight. Meshes are nested, so all are compared at the nodes of the first.
//
//    u₀ ──d₀₁── u₁ ──d₁₂── u₂ ─ ─ ─ u*     d falls by 2^p a mesh; u* = u₂ + (u₂ − u₁)/(2^p − 1)   (Richardson)
//
// Coarse meshes that are too stiff show a p below the 2 that linear elements have in the end, and lead too far; 2 does
// not lead far enough. u* is the middle of both guesses, and half their distance how far to trust it. Errors are
// measured from the u* of whichever element it is surer of; the other element's is held against it.
//
// The estimate that the panel shows (elastic/error_estimate.hpp) is held against the energy norm of the error, which
// the potential Π of the settled body tells: ‖u − u_h‖² = 2 (Π_h − Π*) to leading order, Π* extrapolated like u*. That
// holds for linear tetrahedra, whose Π_h is never below Π*, under dead loads.
#include <studies/study_context.hpp>

namespace heml {

/// A body at rest on one mesh.
struct ConvergenceMesh {
  bool nodal_pressure = false;
  int halvings = 0;
  std::size_t nodes = 0, tets = 0;
  double seconds = 0;   ///< of computing
  std::string failed;   ///< empty: it settled
  double error = 0;     ///< m, mass-weighted rms over the nodes of the first mesh; at least the resolution
  double relative = 0;  ///< of the motion
  bool resolved = true;
  Vec3 far = Vec3::Zero();                    ///< m, displacement of the node that moves farthest on the first mesh
  double moved = 0;                           ///< m, rms displacement
  double stored = 0, potential = 0;           ///< J, elastic energy; Π
  std::optional<double> estimated;            ///< J, squared energy norm of the error as the panel estimates it
  std::optional<double> known;                ///< J, the same as finer meshes tell it
  std::optional<double> effectivity() const;  ///< estimated / known, of the norm; 1: honest
  double estimated_length() const;            ///< m, the share of the motion that goes with the energy: e²/‖u‖²
};

/// u* and how far to trust it.
struct Extrapolation {
  std::string failure;  ///< empty: there is one
  bool nodal_pressure = false;
  double order = 0;                                      ///< p as the three meshes show it
  double uncertainty = 0;                                ///< m, half the rms distance of the two guesses
  double motion = 0;                                     ///< m, rms of u*
  Vec3 far = Vec3::Zero();                               ///< m, u* of the node that moves farthest
  std::optional<double> between_elements;                ///< m, rms between the u* of both elements
  double resolution() const { return 2 * uncertainty; }  ///< m, the least error it can tell
};

struct MeshConvergenceStudy {
  Extrapolation reference;
  std::vector<Vec3> best;  ///< u* as positions, #V of the first mesh; empty: there is none
  std::vector<ConvergenceMesh> meshes;
  const ConvergenceMesh* find(bool nodal_pressure, int halvings) const;
};

/// Richardson's, of nested solutions u (three or more) at the same nodes. rest: where u is 0. None where differences
/// do not shrink regularly (order under 0.5 or over 4). best: u*.
Extrapolation extrapolate(const std::vector<std::vector<Vec3>>& x, const std::vector<Vec3>& rest,
                          const std::vector<double>& mass, std::vector<Vec3>& best);

/// Π* of nested meshes (three or more), and half of what two guesses at it differ by, both J; none where it does not
/// fall regularly.
struct Potential {
  double best, uncertainty;
};
std::optional<Potential> extrapolate(const std::vector<double>& potentials);

/// Loads are those of the scene at full size, without its events. halvings: the finest mesh. Both elements, where its
/// laws have them.
MeshConvergenceStudy study_mesh_convergence(const std::string& key, const Problem& problem, int halvings,
                                            const StudyContext& context);
std::size_t steps_of_mesh_convergence_study(const Problem& problem, int halvings);

/// Where the nodes of a specimen come to rest; empty: nowhere.
std::vector<Vec3> equilibrium_positions(const std::string& key, const Problem& problem, const StudyContext& context);

/// How often a mesh may be cut in eight until it has `most` tetrahedra, at most `halvings` times.
int halvings_within(std::size_t tets, std::size_t most, int halvings);

}  // namespace heml
