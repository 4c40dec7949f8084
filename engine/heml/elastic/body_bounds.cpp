// Bounds of the eigenvalues of stiffness and damping.
#include <algorithm>
#include <cmath>
#include <heml/elastic/body.hpp>
#include <heml/elastic/mass_scaling.hpp>

namespace heml {

/// The maximum over the nodes of B (step_weights.hpp). bound(part,
/// begin, end, bounds) writes those of the slots of packets, 8 a packet.
template <class Real>
template <class Bound>
Real ElasticBody<Real>::max_at_nodes(ThreadTeam& team, NodeBounds<Real>& nodes, int steps, Real bearable,
                                     const Bound& bound) {
  constexpr std::size_t lanes = ElementGroup<Real>::lanes;
  nodes.begin(this->nodes(), steps, bearable);
  find_packets(nodes.due());
  weighted_bound_.resize(layout_->bounded_elements());
  std::size_t first = 0;
  auto due = due_packets_.begin();
  for (std::size_t g = 0; g < parts_.size(); ++g) {
    const ElementGroup<Real>& group = *parts_[g].group;
    const std::size_t end = first + group.packets();
    const auto due_end = std::lower_bound(due, due_packets_.end(), static_cast<int>(end));
    team.parallel_for(static_cast<std::size_t>(due_end - due), grain_ / 8 / lanes,
                      [&](std::size_t begin, std::size_t last) {
                        Real bounds[lanes];
                        for (auto k = due + static_cast<long>(begin); k < due + static_cast<long>(last); ++k) {
                          const auto p = static_cast<std::size_t>(*k) - first;
                          bound(g, p, p + 1, bounds);
                          weigh_bounds(group, p, bounds);
                        }
                      });
    due = due_end;
    first = end;
  }
  team.parallel_for(nodes.due().size(), grain_ / 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const auto n = static_cast<std::size_t>(nodes.due()[k]);
      nodes.set(n, mean_bound(n));
    }
  });
  return nodes.end();
}

template <class Real>
void ElasticBody<Real>::need_step_weights(ThreadTeam& team) {
  if (step_weights_) return;
  const auto found = step_weights(team);
  step_weights_ = found;
  if (!(options_.mass_scaling > 0)) return;
  NodeBounds<Real> all;
  inner_frequency_bound(at_rest().data(), team, all, 0);
  found->mass_factor = heml::mass_factors(all.bounds(), masses(), options_.mass_scaling);
}

template <class Real>
const std::vector<Real>& ElasticBody<Real>::mass_factors(ThreadTeam& team) {
  static const std::vector<Real> none;
  if (!(options_.mass_scaling > 0)) return none;  // weights are found when they are asked for
  need_step_weights(team);
  return step_weights_->mass_factor;
}

template <class Real>
std::shared_ptr<StepWeights<Real>> ElasticBody<Real>::step_weights(ThreadTeam& team) const {
  std::vector<StiffElements<Real>> stiff;
  for (const Part& part : parts_) {
    const Material& material = materials_[part.material];
    if (part.terms.empty()) {
      stiff.push_back({&*part.group, 0, 0});
      continue;
    }
    const auto [shear, bulk] = small_strain_moduli(material);
    stiff.push_back({&*part.group, shear, std::max(bulk - 2 * shear / 3, 0.0)});
  }
  return std::make_shared<StepWeights<Real>>(find_step_weights(stiff, *layout_, team));
}

/// Lists in due_packets_, ascending, the packets with an element at one of the nodes. Packets are numbered through all
/// parts.
template <class Real>
void ElasticBody<Real>::find_packets(const std::vector<int>& nodes) {
  constexpr std::size_t lanes = ElementGroup<Real>::lanes;
  std::size_t count = 0;
  for (const Part& part : parts_) count += part.group->packets();
  std::vector<bool> is_due(count, nodes.size() == this->nodes());
  if (nodes.size() < this->nodes()) {
    std::vector<bool> at_node(layout_->virtual_corners ? elements() : 0, false);
    for (const int n : nodes)
      layout_->each_element_at(static_cast<std::size_t>(n), [&](std::size_t e) {
        if (layout_->virtual_corners)
          at_node[e] = true;
        else
          is_due[e / lanes] = true;
      });
    std::size_t first = 0;
    for (const Part& part : parts_) {
      for (std::size_t s = 0; layout_->virtual_corners && s < part.group->size(); s += element_points)
        if (at_node[element_at(*part.group, s)]) is_due[first + s / lanes] = true;
      first += part.group->packets();
    }
  }
  due_packets_.clear();
  for (std::size_t p = 0; p < count; ++p)
    if (is_due[p]) due_packets_.push_back(static_cast<int>(p));
}

/// Writes the bounds of a packet's slots times their masses, and the masses, into weighted_bound_; of a quadratic
/// element that of its worst point.
template <class Real>
void ElasticBody<Real>::weigh_bounds(const ElementGroup<Real>& group, std::size_t packet, const Real* bounds) {
  constexpr std::size_t lanes = ElementGroup<Real>::lanes;
  const std::size_t end = std::min((packet + 1) * lanes, group.size());
  const std::size_t points = points_per_element();
  for (std::size_t s = packet * lanes; s < end; s += points) {
    Real largest = 0, mass = 0;  // largest: of the mass of a point times its bound
    for (std::size_t q = s; q < s + points; ++q) {
      const Real of_point = group.density * group.volume[q], bound = bounds[q % lanes] * of_point;
      largest = bound > largest || std::isnan(bound) ? bound : largest;
      mass += of_point;
    }
    const std::size_t e = layout_->bounded_element(group, s);
    const Real factor = points == 1 ? 1 : static_cast<Real>(points) * step_weights_->factor[e];
    weighted_bound_[e] = {factor * largest, mass};
  }
}

/// B of a node whose packets have been evaluated; 0 at a node without an element.
template <class Real>
Real ElasticBody<Real>::mean_bound(std::size_t node) const {
  Real sum = 0, mass = 0;
  layout_->each_element_at(node, [&](std::size_t e) {
    sum += weighted_bound_[e].first;
    mass += weighted_bound_[e].second;
  });
  if (!(mass > 0)) return 0;
  if (!step_weights_->mass_factor.empty()) mass *= step_weights_->mass_factor[node];
  return sum / (mass * step_weights_->node[node]);
}

template <class Real>
typename ElasticBody<Real>::Contribution ElasticBody<Real>::largest_contribution(std::size_t node) const {
  Real most = 0, sum = 0;
  std::size_t largest = 0;
  layout_->each_element_at(node, [&](std::size_t e) {
    const Real own = weighted_bound_[e].first;
    sum += own;
    if (own > most) most = own, largest = e;
  });
  if (!(most > 0)) return {};
  const double share = static_cast<double>(most / sum);
  if (layout_->virtual_corners) return {static_cast<int>(largest), share};
  for (const Part& part : parts_) {
    const std::size_t first = part.group->first_corner / 4;
    if (largest - first < part.group->size()) return {part.group->element[largest - first], share};
  }
  return {};
}

template <class Real>
Real ElasticBody<Real>::frequency_bound(const Real* x, ThreadTeam& team) {
  NodeBounds<Real> all;
  return frequency_bound(x, team, all, 0);
}

template <class Real>
Real ElasticBody<Real>::damping_bound(const Real* x, ThreadTeam& team) {
  NodeBounds<Real> all;
  return damping_bound(x, team, all, 0);
}

template <class Real>
Real ElasticBody<Real>::frequency_bound(const Real* x, ThreadTeam& team, NodeBounds<Real>& nodes, int steps,
                                        Real bearable) {
  need_step_weights(team);
  return inner_frequency_bound(inner_positions(x, team), team, nodes, steps, bearable);
}

/// x: of virtual corners, if the elements are quadratic.
template <class Real>
Real ElasticBody<Real>::inner_frequency_bound(const Real* x, ThreadTeam& team, NodeBounds<Real>& nodes, int steps,
                                              Real bearable) {
  if (pressure_) pressure_->begin_bounds(x, team);
  if (fans_.needs_state()) fans_.read_state(fan_slots());
  Real of_all = fans_.state_bound(fan_slots());  // added to every node's
  if (!layout_->joints.springs.empty()) of_all += layout_->joints.springs.frequency_bound(masses());
  const auto of_elements = [&](std::size_t g, std::size_t begin, std::size_t end, Real* bounds) {
    const Part& part = parts_[g];
    const Real* weights = corner_weights();
    std::fill_n(bounds, (end - begin) * ElementGroup<Real>::lanes, Real(0));
    for (const auto& term : part.terms) term->frequency_bounds(*part.group, weights, x, begin, end, bounds, true);
    if (pressure_) pressure_->add_frequency_bounds(g, weights, x, begin, end, bounds);
    if (part.dilatation)
      part.dilatation->add_frequency_bounds(*part.group, *layout_->virtual_corners, *step_weights_, x, begin, end,
                                            bounds);
  };
  return max_at_nodes(team, nodes, steps, bearable - of_all, of_elements) + of_all;
}

template <class Real>
Real ElasticBody<Real>::damping_bound(const Real* x, ThreadTeam& team, NodeBounds<Real>& nodes, int steps) {
  if (!has_internal_state()) return 0;
  need_step_weights(team);
  x = inner_positions(x, team);
  return max_at_nodes(team, nodes, steps, Real(0),
                      [&](std::size_t g, std::size_t begin, std::size_t end, Real* bounds) {
                        std::fill_n(bounds, (end - begin) * ElementGroup<Real>::lanes, Real(0));
                        for (const auto& term : parts_[g].terms)
                          term->damping_bounds(*parts_[g].group, corner_weights(), x, begin, end, bounds, true);
                      });
}

template float ElasticBody<float>::frequency_bound(const float*, ThreadTeam&);
template float ElasticBody<float>::frequency_bound(const float*, ThreadTeam&, NodeBounds<float>&, int, float);
template double ElasticBody<double>::frequency_bound(const double*, ThreadTeam&);
template double ElasticBody<double>::frequency_bound(const double*, ThreadTeam&, NodeBounds<double>&, int, double);
template float ElasticBody<float>::damping_bound(const float*, ThreadTeam&);
template float ElasticBody<float>::damping_bound(const float*, ThreadTeam&, NodeBounds<float>&, int);
template double ElasticBody<double>::damping_bound(const double*, ThreadTeam&);
template double ElasticBody<double>::damping_bound(const double*, ThreadTeam&, NodeBounds<double>&, int);
template const std::vector<float>& ElasticBody<float>::mass_factors(ThreadTeam&);
template const std::vector<double>& ElasticBody<double>::mass_factors(ThreadTeam&);
template ElasticBody<float>::Contribution ElasticBody<float>::largest_contribution(std::size_t) const;
template ElasticBody<double>::Contribution ElasticBody<double>::largest_contribution(std::size_t) const;

}  // namespace heml
