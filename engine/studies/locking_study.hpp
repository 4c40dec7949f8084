#pragma once
// Locking: what the mesh error grows by when a material comes near to keeping its volume, all else the same. A beam
// sags by a little under its own weight, which theory tells (beam_theory.hpp); linear tetrahedra are too stiff for it,
// and ever more so as Poisson's ratio nears 1/2.
#include <studies/mesh_convergence_study.hpp>

namespace heml {

/// The beam of one Poisson's ratio.
struct LockingBeam {
  double poisson = 0;
  double theory = 0;  ///< m, sag of the tip
  MeshConvergenceStudy convergence;
  double sag(const ConvergenceMesh& mesh) const { return -mesh.far.y(); }  ///< m
  double extrapolated() const { return -convergence.reference.far.y(); }   ///< m
  double off_theory() const { return extrapolated() / theory - 1; }        ///< relative
};

/// What is at rest there, on a mesh of so many cells.
Problem beam_problem(double poisson, const std::array<int, 3>& cells);

/// One of them, from a mesh of so many cells.
LockingBeam study_beam(double poisson, const std::array<int, 3>& cells, const StudyContext& context);

/// From a mesh of 8 × 2 × 2 cells (quick) or 10 × 2 × 2, and fewer Poisson's ratios (quick); the first is 0.
std::array<int, 3> cells_of_locking_study(bool quick);
std::vector<LockingBeam> study_locking(bool quick, const StudyContext& context);
std::size_t steps_of_locking_study(bool quick);

/// Relative error of a mesh that is locking's: what it has beyond that of the same mesh at the first Poisson's ratio.
double locking_of(const std::vector<LockingBeam>& beams, const ConvergenceMesh& mesh);

}  // namespace heml
