#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <heml/world/failure.hpp>

namespace heml {

template <class Real>
StopReason out_of_range(const Simulation<Real>& s, const std::vector<Real>& x, double time) {
  StopReason halt{StopReason::Cause::out_of_range, -1, -1, {}};
  const int element = s.body.first_undefined(x.data());
  if (element >= 0) halt.element = s.model->order.file_tet[static_cast<std::size_t>(element)];
  halt.message = fmt::format(
      "{} left the range of its law at t = {:.6g} s: it was {} ({}take a smaller step, or load more gently)",
      element < 0 ? "an element" : fmt::format("element {}", halt.element), time,
      s.setup->solver.continuation ? "deformed so far that its forces overflow" : "pressed flat or turned inside out",
      s.setup->solver.continuation ? "" : "set solver.continuation to true, ");
  return halt;
}

template <class Real>
StopReason restore_last_valid(Simulation<Real>& s, StopReason::Cause cause) {
  StopReason reason{cause, -1, -1, {}};
  const double reached = s.state.time, h = s.state.time - s.last_valid.time;
  if (cause == StopReason::Cause::out_of_range) {
    reason = out_of_range(s, s.state.x, reached);
  } else {
    const auto runaway = std::find_if(s.state.v.begin(), s.state.v.end(), [&](Real v) {
      return !(std::abs(v) <= 10 * (s.model->diagonal / h + s.setup->initial_velocity.norm()));
    });
    if (runaway != s.state.v.end())
      reason.node = s.model->order.file_node[static_cast<std::size_t>(runaway - s.state.v.begin()) / 3];
    reason.message = fmt::format(
        "unstable at t = {:.6g} s: node {} ran away with steps of {:.3g} s{}", reached, reason.node, h,
        std::isfinite(s.limit.at_start) ? fmt::format("; at the start the limit was {:.3g} s", s.limit.at_start) : "");
  }
  static_cast<Motion<Real>&>(s.state) = s.last_valid;
  if (s.has_internal_state) s.body.begin_step(0);
  s.evaluate_forces();
  return reason;
}

template <class Real>
StopReason keep_last_solved(Simulation<Real>& s, const StopReason& reason) {
  if (s.has_internal_state) s.body.begin_step(0);
  s.evaluate_forces();
  return reason;
}

template StopReason out_of_range(const Simulation<float>& s, const std::vector<float>& x, double time);
template StopReason restore_last_valid(Simulation<float>& s, StopReason::Cause cause);
template StopReason keep_last_solved(Simulation<float>& s, const StopReason& reason);
template StopReason out_of_range(const Simulation<double>& s, const std::vector<double>& x, double time);
template StopReason restore_last_valid(Simulation<double>& s, StopReason::Cause cause);
template StopReason keep_last_solved(Simulation<double>& s, const StopReason& reason);

}  // namespace heml
