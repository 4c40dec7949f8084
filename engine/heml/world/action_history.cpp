#include <algorithm>
#include <heml/world/action_history.hpp>

namespace heml {
namespace {

constexpr double pause = 0.5;  // s, simulated, that ends a drag of a slider

/// Whether two commands set the same thing, as the positions of a dragged slider do.
bool sets_the_same(const Command& one, const Command& next) {
  if (one.index() != next.index()) return false;
  if (const auto* material = std::get_if<SetMaterial>(&one)) {
    const auto& other = std::get<SetMaterial>(next);
    return material->region == other.region && material->material.law == other.material.law;
  }
  if (const auto* active = std::get_if<SetActiveStress>(&one))
    return active->region == std::get<SetActiveStress>(next).region;
  return std::holds_alternative<SetGravity>(one) || std::holds_alternative<SetDamping>(one) ||
         std::holds_alternative<SetRate>(one);
}

}  // namespace

template <class Real>
bool ActionHistory<Real>::begins_action(const Command& command, long tick, double seconds_per_tick,
                                        bool has_probe) const {
  if (!is_action(command)) return false;
  if (lists_.past.empty() || !lists_.last) return true;
  const Command& last = *lists_.last;
  if (const auto continues = continues_stroke(command)) return !*continues || last.index() != command.index();
  if (std::holds_alternative<MoveProbe>(command)) return !has_probe || !std::holds_alternative<MoveProbe>(last);
  if (std::holds_alternative<SetRate>(command) && std::holds_alternative<SetIntegrator>(last) &&
      tick == lists_.last_tick)
    return false;  // the rate that suits a method is chosen with it
  return !sets_the_same(last, command) || static_cast<double>(tick - lists_.last_tick) * seconds_per_tick > pause;
}

template <class Real>
void ActionHistory<Real>::carried_out(const Command& command, long tick, std::shared_ptr<const Moment<Real>> before) {
  if (!is_action(command)) return;
  lists_.future.clear();
  lists_.last = command;
  lists_.last_tick = tick;
  if (!before) return;
  lists_.past.push_back({std::move(before), command});
  while (lists_.past.size() > max_actions || (lists_.past.size() > 1 && bytes() > max_bytes))
    lists_.past.erase(lists_.past.begin());
}

template <class Real>
std::shared_ptr<const Moment<Real>> ActionHistory<Real>::step(int by, std::shared_ptr<const Moment<Real>> now) {
  auto& from = by < 0 ? lists_.past : lists_.future;
  auto& to = by < 0 ? lists_.future : lists_.past;
  if (from.empty()) return nullptr;
  auto [moment, action] = std::move(from.back());
  from.pop_back();
  to.push_back({std::move(now), std::move(action)});
  lists_.last.reset();
  return moment;
}

/// Snapshots share the mesh between edits, so that this bounds the sum from above.
template <class Real>
std::size_t ActionHistory<Real>::bytes() const {
  std::size_t sum = 0;
  for (const auto* list : {&lists_.past, &lists_.future})
    for (const auto& entry : *list) sum += entry.moment->simulation.bytes();
  return sum;
}

template class ActionHistory<float>;
template class ActionHistory<double>;

}  // namespace heml
