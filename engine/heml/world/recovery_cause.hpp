#pragma once
// Why a body most likely went wrong, for people.
#include <string>

namespace heml {

/// What is known when a recovery begins.
struct FailureDiagnosis {
  double time = 0;             ///< s
  int element = -1;            ///< the first bad element, mesh-file order; −1: none
  double min_J = 1;            ///< its J
  int inverted = 0;            ///< elements with J ≤ 0
  bool from_start = false;     ///< the body was so when it was set up
  double step = 0, limit = 0;  ///< s: a given step of an explicit method and the live limit; 0: no step was given
  double shortened = 1;        ///< the stable step at rest over the live limit
  double tool_speed = 0;       ///< m/s, lately; 0: no tool
  double wave_speed = 0;       ///< m/s, of shear waves
  double thinness = 1;         ///< of the element at rest: its least height over its longest edge
  double stiffness_ratio = 0;  ///< κ/μ of its material; 0: no continuum
  double burn_shrink = 0;      ///< part of its lengths at rest that it, or an element beside it, has lost to burns
  bool pulled = false;         ///< a tool holds the body
  bool loaded = true;          ///< loads, gravity, supports that move, pins or contacts act on it
};

/// One sentence: what happened, the likely cause, the remedy.
std::string describe_cause(const FailureDiagnosis& s);

}  // namespace heml
