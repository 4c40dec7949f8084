#pragma once
// Locking: growth of the mesh error as a material approaches incompressibility, all else equal. A beam sags slightly
// under its own weight, by a sag known from theory (beam_theory.hpp); linear tetrahedra are too stiff for it, the more
// so the nearer Poisson's ratio is to 1/2.
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

/// The beam of the study on a box mesh of `cells`.
Problem beam_problem(double poisson, const std::array<int, 3>& cells);

/// The convergence of one beam; `cells`: of its coarsest mesh.
LockingBeam study_beam(double poisson, const std::array<int, 3>& cells, const StudyContext& context);

/// Cells of the coarsest mesh: 8 × 2 × 2 (quick) or 10 × 2 × 2.
std::array<int, 3> cells_of_locking_study(bool quick);
/// One beam per Poisson's ratio, fewer if quick; the first ratio is 0.
std::vector<LockingBeam> study_locking(bool quick, const StudyContext& context);
std::size_t steps_of_locking_study(bool quick);

/// The part of a mesh's relative error that is locking: its excess over the same mesh at the first Poisson's ratio.
double locking_of(const std::vector<LockingBeam>& beams, const ConvergenceMesh& mesh);

}  // namespace heml
