#pragma once
// The reference of time errors: the same mesh and element with its true masses, integrated by Verlet in double with a
// tenth of the stable step and with half of that. It resolves errors down to ten times the change due to the halving.
// The methods under study do not use it, and it is not one of them.
#include <heml/scenario/json_text.hpp>
#include <studies/accuracy_run.hpp>

namespace heml {

struct Reference {
  std::string failure;                ///< why there is no reference; empty: success
  double stable_step = 0;             ///< s, smallest stable step of Verlet during the run
  double step = 0;                    ///< s, of the finer of the two runs
  double change = 0;                  ///< m, largest rms distance of the two runs at a set time
  double motion = 0;                  ///< m, largest rms displacement at a set time; relative errors are divided by it
  double seconds = 0;                 ///< s, wall time of both runs
  std::vector<std::vector<Vec3>> at;  ///< #times × #V × 3, m, positions
  std::optional<FirstMode> first_mode;

  /// m, smallest error it resolves.
  double resolution() const { return 10 * change; }
};

/// pilot: Verlet with its stable steps. On failure, Reference::failure is set.
Reference reference_of(const Problem& problem, const Run& pilot, RunOptions options);

/// m, largest rms distance of a and b (#times × #V × 3) over the set times that both reached. mass: #V, kg.
double max_distance(const std::vector<std::vector<Vec3>>& a, const std::vector<std::vector<Vec3>>& b,
                    const std::vector<double>& mass);

Json to_json(const Reference& reference);
Reference reference_from(const Json& json);

}  // namespace heml
