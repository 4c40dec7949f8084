// Internal state (viscosity, relaxation, plasticity) over time, and snapshots of it.
#include <algorithm>
#include <cassert>
#include <cstring>
#include <heml/elastic/body.hpp>
#include <heml/elastic/viscoelastic_term.hpp>

namespace heml {
template <class Real>
SlotStates<Real> ElasticBody<Real>::Part::slot_states() {
  SlotStates<Real> lists = flow ? flow->slot_states(group.write()) : SlotStates<Real>();
  for (const auto& term : terms)
    for (const SlotState<Real>& list : term->slot_states()) lists.push_back(list);
  return lists;
}

template <class Real>
void ElasticBody<Real>::Part::reset_history(const Real* x) {
  if (flow) flow->reset(group.write());
  for (const auto& term : terms) term->reset_history(*group, x);
}

template <class Real>
bool ElasticBody<Real>::has_internal_state() const {
  return std::any_of(parts_.begin(), parts_.end(),
                     [&](const Part& part) { return materials_[part.material].has_internal_state(); });
}

template <class Real>
void ElasticBody<Real>::begin_step(Real h) {
  step_ = h;
  evaluated_ = false;
  fans_.begin_step(h);
  for (Part& part : parts_)
    for (const auto& term : part.terms) term->begin_step(h);
}

/// The slots of the parts in fans, in their order.
template <class Real>
std::vector<FanSlots<Real>> ElasticBody<Real>::fan_slots() const {
  std::vector<FanSlots<Real>> result;
  for (const Part& part : parts_) {
    if (!part.in_fans) continue;
    FanSlots<Real>& slots = result.emplace_back(FanSlots<Real>{&*part.group, nullptr, 0});
    for (const auto& term : part.terms)
      for (const SlotState<Real>& list : term->slot_states()) slots.values = list.values, slots.each = list.each;
    slots.flow = part.flow.get();
  }
  return result;
}

template <class Real>
void ElasticBody<Real>::update_slots() const {
  if (!slots_are_old_) return;
  fans_.write_state(fan_slots());
  slots_are_old_ = false;
}

/// Unless the last evaluation was at x, so that point kernels have written what is asked for next.
template <class Real>
void ElasticBody<Real>::evaluate_points(const Real* x) {
  if (!points_remember()) return;
  if (!evaluated_ || std::memcmp(evaluated_x_.data(), x, sizeof(Real) * 3 * nodes()) != 0) {
    ThreadTeam alone(1);
    std::vector<Real> unused(3 * nodes());
    quadratic_forces(x, unused.data(), alone);
  }
  evaluated_ = false;
}

template <class Real>
void ElasticBody<Real>::commit(const Real* x) {
  evaluate_points(x);
  std::vector<Real> y;
  x = inner_positions(x, y);
  if (fans_.needs_state()) fans_.read_state(fan_slots());
  if (fans_.has_state()) slots_are_old_ = true;
  const bool flows = std::any_of(parts_.begin(), parts_.end(), [](const Part& p) { return p.flow != nullptr; });
  const bool fans_know = flows && fans_.is_evaluated_at(x);
  fans_.commit(x);
  for (Part& part : parts_)
    if (part.in_points() && part.memory)
      part.memory->advance(*part.group);
    else if (!part.in_fans && !part.in_points())
      for (const auto& term : part.terms) term->commit(*part.group, x);
  flow(x, fans_know);
}

/// Elements flow that are beyond yield at x, where point kernels were evaluated last. fans_know: their forces were
/// evaluated there last, which tells.
template <class Real>
void ElasticBody<Real>::flow(const Real* x, bool fans_know) {
  std::size_t in_fans = 0;
  for (Part& part : parts_) {
    const std::size_t fans = part.in_fans ? in_fans++ : 0;
    if (!part.flow) continue;
    if (part.in_points()) {
      plastic_work_ += part.flow->flow_at_stress(part.group.write(), x);
    } else if (!part.in_fans || !fans_know) {
      plastic_work_ += part.flow->flow(part.group.write(), x);
    } else if (const std::vector<std::size_t> slots = fans_.beyond_yield(fans); !slots.empty()) {
      plastic_work_ += part.flow->flow(part.group.write(), x, slots);
    } else {
      continue;
    }
    if (part.in_fans) put_rest_shapes(fans, part, part.flow->flowed());
  }
}

template <class Real>
void ElasticBody<Real>::put_rest_shapes(std::size_t in_fans, const Part& part, std::span<const std::size_t> slots) {
  fans_.put_rest_shapes(in_fans, {&*part.group, nullptr, 0, part.flow.get()}, slots);
}

template <class Real>
bool ElasticBody<Real>::flows_within_steps() const {
  return std::any_of(parts_.begin(), parts_.end(), [](const Part& part) { return part.flows_within_steps; });
}

template <class Real>
void ElasticBody<Real>::begin_flow_trial(const Real* x, ThreadTeam& team) {
  if (!flows_within_steps()) return;
  evaluated_ = false;
  x = inner_positions(x, team);
  for (Part& part : parts_) {
    if (!part.flows_within_steps) continue;
    auto& group = part.group.write();
    if (!part.flow->begin_trial(group, {x, 3 * layout_->mesh.nodes.size()}))
      team.parallel_for(group.packets(), grain_ / 4 / group.lanes,
                        [&](std::size_t begin, std::size_t end) { part.flow->try_flow(group, x, begin, end); });
  }
  put_trial_in_fans();
}

/// After rest shapes have become those of a trial, or are no longer.
template <class Real>
void ElasticBody<Real>::put_trial_in_fans() {
  std::size_t in_fans = 0;
  for (const Part& part : parts_) {
    const std::size_t fans = part.in_fans ? in_fans++ : 0;
    if (part.in_fans && part.flow) put_rest_shapes(fans, part, part.flow->trial_slots());
  }
}

template <class Real>
void ElasticBody<Real>::end_flow_trial() {
  for (Part& part : parts_)
    if (part.flows_within_steps) part.flow->end_trial(part.group.write());
  if (!flows_within_steps()) return;
  evaluated_ = false;
  put_trial_in_fans();
}

template <class Real>
void ElasticBody<Real>::reset_history(const Real* x) {
  plastic_work_ = 0;
  evaluated_ = false;
  std::vector<Real> y;
  x = inner_positions(x, y);
  for (Part& part : parts_) part.reset_history(x);
  fans_.forget_state();
  slots_are_old_ = false;
}

template <class Real>
InternalState<Real> ElasticBody<Real>::internal_state() {
  update_slots();
  InternalState<Real> state{{}, plastic_work_};
  for (Part& part : parts_)
    for (const SlotState<Real>& list : part.slot_states()) state.values.push_back(*list.values);
  return state;
}

template <class Real>
void ElasticBody<Real>::set_internal_state(const InternalState<Real>& state) {
  auto values = state.values.begin();
  for (Part& part : parts_)
    for (const SlotState<Real>& list : part.slot_states()) {
      assert(values != state.values.end() && values->size() == list.values->size());
      *list.values = *values++;
    }
  plastic_work_ = state.plastic_work;
  evaluated_ = false;
  fans_.forget_state();
  slots_are_old_ = false;
}

template <class Real>
BodySnapshot<Real> ElasticBody<Real>::snapshot() {
  update_slots();
  BodySnapshot<Real> snapshot{layout_, {}, materials_, fans_, plastic_work_, step_, activation_, step_weights_};
  snapshot.fans.drop_scratch();
  for (Part& part : parts_) {
    snapshot.parts.push_back({part.material, part.group_at_rest(), {}});
    auto& of_part = snapshot.parts.back();
    for (const SlotState<Real>& list : part.slot_states()) of_part.values.push_back(*list.values);
  }
  return snapshot;
}

template <class Real>
void ElasticBody<Real>::restore(const BodySnapshot<Real>& snapshot, const Real* x) {
  layout_ = snapshot.layout;
  std::vector<Real> y;
  x = inner_positions(x, y);
  parts_.clear();
  slots_are_old_ = false;
  evaluated_ = false;
  step_ = snapshot.step;
  activation_ = snapshot.activation;
  for (const auto& of_part : snapshot.parts) {
    const Material& before = snapshot.materials[of_part.material];
    Part& part = parts_.emplace_back(remake_part(of_part.material, before, of_part.group));
    part.reset_history(x);
    Material same = before;
    same.active_stress = materials_[part.material].active_stress;  // the state does not depend on it
    if (!(materials_[part.material] == same)) continue;
    const SlotStates<Real> lists = part.slot_states();
    for (std::size_t k = 0; k < lists.size(); ++k) *lists[k].values = of_part.values[k];
  }
  plastic_work_ = snapshot.plastic_work;
  if (materials_ == snapshot.materials) {
    number_corners();
    make_pressure();
    fans_ = snapshot.fans;
    step_weights_ = snapshot.step_weights;
  } else {
    join_parts();
    make_fans();
  }
}

template <class Real>
void ElasticBody<Real>::restore_all(const BodySnapshot<Real>& snapshot, const Real* x) {
  materials_ = snapshot.materials;
  restore(snapshot, x);
}

template <class Real>
std::size_t BodySnapshot<Real>::bytes() const {
  std::size_t sum = fans.bytes() + layout->bytes() + (step_weights ? step_weights->bytes() : 0);
  for (const Part& part : parts) sum += part.group->bytes() + bytes_of(part.values);
  return sum;
}

template bool ElasticBody<float>::has_internal_state() const;
template bool ElasticBody<double>::has_internal_state() const;
template std::vector<FanSlots<float>> ElasticBody<float>::fan_slots() const;
template std::vector<FanSlots<double>> ElasticBody<double>::fan_slots() const;
template void ElasticBody<float>::update_slots() const;
template void ElasticBody<double>::update_slots() const;
template void ElasticBody<float>::begin_step(float);
template void ElasticBody<double>::begin_step(double);
template void ElasticBody<float>::commit(const float*);
template void ElasticBody<double>::commit(const double*);
template bool ElasticBody<float>::flows_within_steps() const;
template bool ElasticBody<double>::flows_within_steps() const;
template void ElasticBody<float>::flow(const float*, bool);
template void ElasticBody<double>::flow(const double*, bool);
template void ElasticBody<float>::put_rest_shapes(std::size_t, const Part&, std::span<const std::size_t>);
template void ElasticBody<double>::put_rest_shapes(std::size_t, const Part&, std::span<const std::size_t>);
template void ElasticBody<float>::put_trial_in_fans();
template void ElasticBody<double>::put_trial_in_fans();
template void ElasticBody<float>::begin_flow_trial(const float*, ThreadTeam&);
template void ElasticBody<double>::begin_flow_trial(const double*, ThreadTeam&);
template void ElasticBody<float>::end_flow_trial();
template void ElasticBody<double>::end_flow_trial();
template void ElasticBody<float>::Part::reset_history(const float*);
template void ElasticBody<double>::Part::reset_history(const double*);
template void ElasticBody<float>::reset_history(const float*);
template void ElasticBody<double>::reset_history(const double*);
template struct BodySnapshot<float>;
template struct BodySnapshot<double>;
template InternalState<float> ElasticBody<float>::internal_state();
template InternalState<double> ElasticBody<double>::internal_state();
template void ElasticBody<float>::set_internal_state(const InternalState<float>&);
template void ElasticBody<double>::set_internal_state(const InternalState<double>&);
template BodySnapshot<float> ElasticBody<float>::snapshot();
template BodySnapshot<double> ElasticBody<double>::snapshot();
template void ElasticBody<float>::restore(const BodySnapshot<float>&, const float*);
template void ElasticBody<double>::restore(const BodySnapshot<double>&, const double*);
template void ElasticBody<float>::restore_all(const BodySnapshot<float>&, const float*);
template void ElasticBody<double>::restore_all(const BodySnapshot<double>&, const double*);

}  // namespace heml
