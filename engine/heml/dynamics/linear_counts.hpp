#pragma once

namespace heml {

/// What linear solves have done so far.
struct LinearSolverStats {
  long factorisations = 0, solves = 0, iterations = 0;
};

}  // namespace heml
