#pragma once
// Every law held against arithmetic that is not the engine's: a small cube settles under its own weight, its top turned
// and moved; then the naive loops (naive.hpp), whose stresses are written out from textbooks, must find the same
// balance of forces. A wrong factor or sign in a kernel leaves a force.
#include <studies/study_context.hpp>

namespace heml {

struct LawCheck {
  std::string law;
  std::string failed;    ///< empty: it settled
  double left_over = 0;  ///< largest force on a free node by the naive loops, of the largest weight of a node
};

/// One a law, as bench_materials() lists them.
std::vector<LawCheck> study_laws(const StudyContext& context);
std::size_t steps_of_law_study();

}  // namespace heml
