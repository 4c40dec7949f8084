#pragma once
// What the explicit methods share. A method is what it does before and after the forces are evaluated at the new
// positions: a step is first_half_step, motion of constrained nodes, forces, second_half_step. α: mass damping, 1/s.
// Coordinates with inverse mass 0 (of constrained nodes, or of no element) are not accelerated. All arrays are of
// coordinates (3 #V), so that loops vectorise; the state before the step is kept, for a step that has to be undone.
#include <cstddef>

namespace heml {

/// Input and output arrays of a first half step.
template <class Real>
struct FirstHalfStep {
  const Real *inverse_mass, *f, *x, *v;  ///< 1/kg, N, m, m/s
  Real *x_after, *v_after;
};

}  // namespace heml
