#pragma once
// Signed penalty volumes (Irving, Teran & Fedkiw 2004, the paper's reference 21, which the paper names as a way to deal
// with inverted elements) beside the continuation of laws that the engine uses. The penalty is here to be compared
// with: to the energy of a body it adds, for every tetrahedron of rest volume V and signed volume v,
//
//   ½ k V (1 − v/V)²,   k = strength × (λ + 2μ)
//
// which pulls an inverted element upright, and is there at all deformations.
#include <string>
#include <vector>

namespace heml::stability {

struct PenaltyRow {
  std::string start;   ///< "plane"
  std::string method;  ///< "StVK + penalty 10", "Neo-Hookean continued", ...
  int inverted = 0;    ///< elements left inside out, of how many
  int elements = 0;
  double away = 0;            ///< rms distance from rest over the size; 0.1 % counts as back
  double max_step = 0;        ///< of explicit steps at rest, over that of the law alone
  double changed_stress = 0;  ///< how much stress at a stretch of 1.3 differs from the law's, relative
  bool back() const { return inverted == 0 && away <= 1e-3; }
};

/// The collapses of case 13 and 15, damped Verlet for two seconds: by penalties of several strengths, by continuations,
/// and by the engine's recovery.
std::vector<PenaltyRow> compare_with_penalty(bool quick);

}  // namespace heml::stability
