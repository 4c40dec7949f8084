#pragma once
// Compares signed penalty volumes (Irving, Teran & Fedkiw 2004, the paper's reference 21, which the paper names as a
// way to deal with inverted elements) with the engine's continuation of laws. The penalty adds to the energy, for every
// tetrahedron of rest volume V and signed volume v,
//
//   ½ k V (1 − v/V)²,   k = strength × (λ + 2μ)
//
// which restores an inverted element, but acts at all deformations.
#include <string>
#include <vector>

namespace heml::stability {

struct PenaltyRow {
  std::string start;   ///< "plane"
  std::string method;  ///< "StVK + penalty 10", "Neo-Hookean continued", ...
  int inverted = 0;    ///< elements still inverted, of all
  int elements = 0;
  double away = 0;            ///< rms distance from rest over the diagonal; up to 0.1 % counts as back
  double max_step = 0;        ///< stable explicit step at rest, relative to that of the law alone
  double changed_stress = 0;  ///< relative change of the stress at a stretch of 1.3
  bool back() const { return inverted == 0 && away <= 1e-3; }
};

/// Runs the collapses of cases 13 and 15 and the random start of case 12 for 2 s: in damped explicit steps with
/// penalties of several strengths and with continuation, and by the engine's recovery.
std::vector<PenaltyRow> compare_with_penalty(bool quick);

}  // namespace heml::stability
