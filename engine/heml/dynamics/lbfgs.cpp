#include <array>
#include <deque>
#include <heml/dynamics/lbfgs.hpp>
#include <heml/dynamics/line_search.hpp>

namespace heml {
namespace {

constexpr std::size_t memory = 5;

/// A step s and the change y of the gradient along it.
struct Pair {
  Vector s, y;
  double sy;
};

/// d = H r, H the L-BFGS approximation of the inverse stiffness (two-loop recursion). Returns false without
/// preconditioner.
bool apply_inverse(LinearSolver& linear, const std::deque<Pair>& pairs, const Vector& r, Vector& d) {
  std::array<double, memory> alpha;
  Vector q = r;
  for (std::size_t k = pairs.size(); k-- > 0;) {
    alpha[k] = pairs[k].s.dot(q) / pairs[k].sy;
    q -= alpha[k] * pairs[k].y;
  }
  if (!linear.precondition(q, d)) return false;
  if (!pairs.empty()) {
    Vector z;
    linear.precondition(pairs.back().y, z);
    d *= pairs.back().sy / pairs.back().y.dot(z);
  }
  for (std::size_t k = 0; k < pairs.size(); ++k) d += (alpha[k] - pairs[k].y.dot(d) / pairs[k].sy) * pairs[k].s;
  return true;
}

}  // namespace

NewtonResult minimise_lbfgs(Objective& objective, LinearSolver& linear, const StoppingCriterion& stop,
                            int max_iterations, Vector& x) {
  using Status = NewtonResult::Status;
  NewtonResult result;
  SearchPoint at{x, Vector(), std::nullopt};
  if (!objective.residual(at.x, at.r) || !at.r.allFinite()) return result;
  at.value = objective.value(at.x);
  std::deque<Pair> pairs;
  Vector d;
  while (true) {
    result.measure = stop.measure(at.r);
    if (result.measure <= stop.limit)
      result.status = Status::converged;
    else if (result.iterations >= max_iterations || stop.is_interrupted())
      result.status = Status::out_of_iterations;
    else
      result.status = Status::stalled;
    if (result.status != Status::stalled) break;
    ++result.iterations;
    const Vector x_before = at.x, r_before = at.r;
    if (!apply_inverse(linear, pairs, at.r, d)) break;
    if (!line_search(objective, d, at)) {
      if (pairs.empty()) break;
      pairs.clear();  // their direction does not lower Φ
      continue;
    }
    Pair pair{at.x - x_before, r_before - at.r, 0};
    pair.sy = pair.s.dot(pair.y);
    if (!(pair.sy > 1e-12 * pair.s.norm() * pair.y.norm())) continue;  // no positive curvature along s
    pairs.push_back(std::move(pair));
    if (pairs.size() > memory) pairs.pop_front();
  }
  x = at.x;
  if (result.status == Status::stalled) objective.residual(x, at.r);  // leaves the objective at x
  return result;
}

}  // namespace heml
