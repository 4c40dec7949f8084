#include <cmath>
#include <heml/dynamics/line_search.hpp>

namespace heml {
namespace {
constexpr double armijo = 1e-4;
constexpr int max_cuts = 24;
constexpr int max_inversion_cuts = 12;  // cuts for which inversion is refused; later, an element may be recovering
// A step within round-off must reduce the slope to this part of its start value.
constexpr double slope_reduction = 0.95;
}  // namespace

bool line_search(Objective& objective, const Vector& d, SearchPoint& at) {
  const double slope = d.dot(at.r);  // −dΦ/ds
  if (!(slope > 0) && at.value) return false;
  SearchPoint trial;
  double s = 1;
  for (int cut = 0; cut <= max_cuts; ++cut, s /= 2) {
    trial.x = at.x + s * d;
    if (cut < max_inversion_cuts && objective.inverts_elements(at.x, trial.x)) continue;
    if (!objective.residual(trial.x, trial.r) || !trial.r.allFinite()) continue;
    const double slope_there = d.dot(trial.r);
    const bool reduces_slope = std::abs(slope_there) <= slope_reduction * slope;
    if (!at.value) {
      if (!reduces_slope && !(trial.r.norm() <= (1 - armijo * s) * at.r.norm())) continue;
    } else {
      trial.value = objective.value(trial.x);
      const double noise = objective.value_round_off() + 1e-15 * std::abs(*at.value);
      if (!(*trial.value <= *at.value - armijo * s * slope + noise)) continue;
      trial.within_round_off = s * slope < 8 * noise;
      if (trial.within_round_off && !reduces_slope) continue;  // values are round-off
    }
    std::swap(at, trial);
    objective.step_taken(s);
    return true;
  }
  return false;
}

}  // namespace heml
