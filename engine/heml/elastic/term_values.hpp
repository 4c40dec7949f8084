#pragma once
// What terms beside the law are to the kernels that add them to its tensions (fan_terms.hpp, point_terms.hpp). Plain
// data only: files compiled for other instruction sets include this header.
#include <heml/materials/volume_term.hpp>

namespace heml {

/// |J| below which elements remember less of their stress (remembered_tensions.hpp).
constexpr double min_remembered_J = 0.2;

/// A branch of relaxation during one step of h seconds.
template <class Real>
struct RelaxationBranch {
  Real decay;  ///< e^(−h/τ)
  Real gain;   ///< γ e^(−h/2τ)
};

}  // namespace heml
