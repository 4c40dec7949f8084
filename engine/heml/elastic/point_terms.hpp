#pragma once
// Terms beside the law in the kernels of points (point_kernels.hpp): viscosity, relaxation, volume terms of their own,
// active stress (viscoelastic_term.hpp and active_term.hpp have the formulas). Plain data only: files compiled for
// other instruction sets include this header.
//
//   state: [slot][G0 (6) T0 (6) Q of branch 0 (6) Q of branch 1 ...], as ViscoelasticTerm has it, and the next one
#include <cstddef>
#include <heml/elastic/term_values.hpp>

namespace heml {

/// Of a part during one step.
template <class Real>
struct PointTerms {
  Real eta = 0, zeta = 0;  ///< Pa s
  Real per_step = 0;       ///< 1/h, or 0
  const RelaxationBranch<Real>* branches = nullptr;
  std::size_t branch_count = 0;
  Real weight = 0;               ///< Σ gain
  std::size_t state = 0;         ///< numbers a slot; 0: nothing is remembered
  const Real* before = nullptr;  ///< state at the beginning of the step, of all slots
  Real* next = nullptr;          ///< after it, overwritten
  bool has_volume = false;       ///< a volume term that the law does not have
  VolumeTerm volume = VolumeTerm::quadratic;
  bool is_continued = false;
  Real kappa = 0;                                  ///< Pa, of that volume term
  const Real* kappa_of = nullptr;                  ///< of every slot instead, or null
  Real active = 0;                                 ///< Pa, along the fibres of the block
  VolumeTerm mean_volume = VolumeTerm::quadratic;  ///< of mean dilatation (PointBlock::kappa)

  Real* mises = nullptr;  ///< Pa, of every slot, overwritten: the von Mises stress of the law, which rounding does not
                          ///< make too small (plastic_flow.hpp); null: nothing flows

  bool is_viscous() const { return eta != 0 || zeta != 0; }
  bool any() const { return state > 0 || has_volume || active != 0 || mises; }
};

}  // namespace heml
