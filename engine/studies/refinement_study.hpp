#pragma once
// Gain of adaptive refinement: a beam at equilibrium on uniform subdivisions and on meshes adapted to the error
// estimate (scenario/adapt.hpp), error against number of tetrahedra. Errors of both follow from the potential, Π*
// extrapolated from the uniform meshes (mesh_convergence_study.hpp).
#include <studies/locking_study.hpp>

namespace heml {

struct RefinedMesh {
  bool adapted = false;
  std::size_t tets = 0;
  double error = 0;      ///< relative, in the energy norm
  double estimated = 0;  ///< the same, as the panel estimates it
};

struct RefinementStudy {
  double poisson = 0;
  std::vector<RefinedMesh> meshes;  ///< uniform ones, then adapted ones, each from coarse to fine; empty: Π* is unknown
};

/// Adapts the coarsest mesh of a beam whose convergence was studied, up to max_tets tetrahedra.
RefinementStudy study_refinement(const LockingBeam& beam, const std::array<int, 3>& cells, int max_tets,
                                 const StudyContext& context);

}  // namespace heml
