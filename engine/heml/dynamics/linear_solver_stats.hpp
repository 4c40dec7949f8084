#pragma once

namespace heml {

/// Work of the linear solves so far.
struct LinearSolverStats {
  long factorisations = 0, solves = 0, iterations = 0;
};

}  // namespace heml
