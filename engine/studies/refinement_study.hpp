#pragma once
// What refining where the estimate says gains: a beam at rest on meshes with every tetrahedron in eight, and on meshes
// adapted to the estimate (scenario/adapt.hpp), error against number of tetrahedra. Errors of both are known from the
// potential, Π* extrapolated from the uniform meshes (mesh_convergence_study.hpp).
#include <studies/locking_study.hpp>

namespace heml {

struct RefinedMesh {
  bool adapted = false;
  std::size_t tets = 0;
  double error = 0;      ///< of the energy norm
  double estimated = 0;  ///< the same as the panel estimates it
};

struct RefinementStudy {
  double poisson = 0;
  std::vector<RefinedMesh>
      meshes;  ///< uniform ones, then adapted ones, each from coarse to fine; none: Π* is not known
};

/// From the first mesh of a beam at rest that is known already, to no more than so many tetrahedra.
RefinementStudy study_refinement(const LockingBeam& beam, const std::array<int, 3>& cells, int max_tets,
                                 const StudyContext& context);

}  // namespace heml
