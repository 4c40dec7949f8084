#pragma once
#include <heml/dynamics/linear_solver_stats.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace heml {

/// What Newton's method has done for a world.
struct SolverStats {
  const char* integrator = "";  ///< scene name of the method in use: what "auto" has chosen, else the scene's
  double load = 1;              ///< fraction of motions, loads and gravity reached; below 1 in static worlds alone
  long iterations = 0;          ///< of Newton, over all steps or increments
  double residual = 0;          ///< of the last step or increment, relative to the forces carried (solver.tolerance);
                                ///< 0 of explicit steps
  long lagging_flow_steps = 0;  ///< that did not converge with plastic flow in them, and were taken with it after them
  long damped_steps = 0;        ///< of a second-order method, taken by backward Euler (implicit_stepper.hpp)
  long explicit_rescues = 0;    ///< ticks that explicit substeps ended, where implicit steps did not converge
  long unconverged_steps = 0;   ///< ended by the best iterate (step_rescue.hpp)
  double unconverged_residual = 0;  ///< the largest that one of them left, relative as `residual`
  /// Where a static solve ended below its load: the lowest eigenvalue of the stiffness there over that at rest; none
  /// where it is not positive.
  std::optional<double> limit_stiffness;
  int budget = 0;                   ///< iterations a stage may take now; 0: as many as it needs
  std::string_view preconditioner;  ///< scene name; "" before the first step
  LinearSolverStats linear;
};

/// How many ticks did not converge and what ended them, in words; empty: all converged.
std::string rescue_message(const SolverStats& stats);

}  // namespace heml
