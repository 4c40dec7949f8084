#pragma once
// What errors are measured from: the same mesh and element, moved by Verlet in double at a tenth of the stable step and
// at half of that. It holds for errors ten times what that halving changed, and says nothing of smaller ones. The
// methods under study never see it, and it is none of them.
#include <heml/scenario/json_text.hpp>
#include <studies/accuracy_run.hpp>

namespace heml {

struct Reference {
  std::string failure;                ///< why there is none; empty: there is one
  double stable_step = 0;             ///< s, the least of verlet's on the way
  double step = 0;                    ///< s, of the finer of the two
  double change = 0;                  ///< m, rms at the set time where halving the step changed most
  double motion = 0;                  ///< m, rms of the largest displacement at a set time: what relative errors are of
  double seconds = 0;                 ///< of computing
  std::vector<std::vector<Vec3>> at;  ///< #times × #V × 3, m
  std::optional<FirstMode> first_mode;

  /// m, the least error it can tell.
  double resolution() const { return 10 * change; }
};

/// pilot: verlet at the live limit. Throws nothing: what fails is a problem.
Reference reference_of(const Problem& problem, const Run& pilot, RunOptions options);

/// m, the largest of the rms distances at the set times that both have reached.
double max_distance(const std::vector<std::vector<Vec3>>& a, const std::vector<std::vector<Vec3>>& b,
                    const std::vector<double>& mass);

Json to_json(const Reference& reference);
Reference reference_from(const Json& json);

}  // namespace heml
