#pragma once
// Checks every law against independent code: a small cube is solved for equilibrium under its own weight, its top
// turned and moved. The naive loops (naive.hpp), whose stresses are written out from textbooks, must then give balanced
// forces. A wrong factor or sign in a kernel leaves a residual.
#include <studies/study_context.hpp>

namespace heml {

struct LawCheck {
  std::string law;
  std::string failed;    ///< empty: the static solve converged
  double left_over = 0;  ///< largest residual at a free node by the naive loops, relative to the largest nodal weight
};

/// One per law, in the order of bench_materials().
std::vector<LawCheck> study_laws(const StudyContext& context);
std::size_t steps_of_law_study();

}  // namespace heml
