#include <algorithm>
#include <atomic>
#include <cmath>
#include <heml/elastic/avx2_dispatch.hpp>
#include <heml/elastic/group_term.hpp>
#include <heml/elastic/nodal_pressure.hpp>
#include <heml/elastic/volume_function.hpp>

namespace heml {
namespace {
constexpr std::size_t slot_grain = 2048, node_grain = 4096;

template <class Real>
ElementKinematics<Real> volume_kinematics(const ElementGroup<Real>& group, const Real* x, std::size_t s,
                                          RestShape<Real>& rest) {
  rest = rest_shape(group, s);
  const SlotNodes<Real> n(group, x, s);
  return element_kinematics<false, true, false, false>(n.x0, n.x1, n.x2, n.x3, rest);
}

/// Deformed volume V J of every slot of packets [begin, end).
template <class Real>
HEML_WIDE void packet_volumes(const ElementGroup<Real>& group, const Real* x, std::size_t begin, std::size_t end,
                              Real* of_slot) {
  constexpr std::size_t lanes = ElementGroup<Real>::lanes;
  for (std::size_t p = begin; p < end; ++p) {
    const Packet<Real, false> packet(group, x, p * lanes);
    Real* to = of_slot + p * lanes;
#pragma GCC ivdep
    for (std::size_t l = 0; l < lanes; ++l) {
      const Corners<Real> at(packet.x, l);
      const RestShape<Real> rest = packet.rest(l);
      to[l] =
          rest.volume * element_kinematics<false, true, false, false>(at.x[0], at.x[1], at.x[2], at.x[3], rest).at.J;
    }
  }
}

/// Adds the corner forces of the mean pressure of four nodes, for packets [begin, end).
template <class Real>
HEML_WIDE void add_packet_pressures(const ElementGroup<Real>& group, const Real* x, const Real* pressure,
                                    std::size_t begin, std::size_t end, Real* corner) {
  constexpr std::size_t lanes = ElementGroup<Real>::lanes;
  for (std::size_t p = begin; p < end; ++p) {
    const Packet<Real, false> packet(group, x, p * lanes);
    Real mean[lanes] = {}, out[12][lanes];
    for (const auto& list : group.node)
      for (std::size_t l = 0; l < lanes; ++l) mean[l] += pressure[list[p * lanes + l]];
#pragma GCC ivdep
    for (std::size_t l = 0; l < lanes; ++l) {
      const Corners<Real> at(packet.x, l);
      const auto kinematics =
          element_kinematics<false, true, false, false>(at.x[0], at.x[1], at.x[2], at.x[3], packet.rest(l));
      Real f[12];
      forces_from_tensions<true>(Tensions<Real>{{}, mean[l] / 4}, kinematics.e, kinematics.cross, f);
      for (int i = 0; i < 12; ++i) out[i][l] = f[i];
    }
    write_packet_corners(out, corner + 3 * (group.first_corner + 4 * p * lanes), true);
  }
}

/// Changes of V J with changes dx of the positions, for every slot of packets [begin, end). gradient: V ∂J/∂e,
/// [packet][9][lanes].
template <class Real>
[[gnu::always_inline]] inline void volume_changes(const ElementGroup<Real>& group, const Real* gradient, const Real* dx,
                                                  std::size_t begin, std::size_t end, Real* of_slot) {
  constexpr std::size_t lanes = ElementGroup<Real>::lanes;
  for (std::size_t p = begin; p < end; ++p) {
    const Packet<Real, false> packet(group, dx, p * lanes);
    const Real* of_packet = gradient + 9 * lanes * p;
    Real* to = of_slot + p * lanes;
#pragma GCC ivdep
    for (std::size_t l = 0; l < lanes; ++l) {
      Real sum = 0;
      for (std::size_t r = 0; r < 9; ++r) sum += of_packet[lanes * r + l] * (packet.x[3 + r][l] - packet.x[r % 3][l]);
      to[l] = sum;
    }
  }
}
template <class Real>
HEML_WIDE void wide_volume_changes(const ElementGroup<Real>& group, const Real* gradient, const Real* dx,
                                   std::size_t begin, std::size_t end, Real* of_slot) {
  volume_changes(group, gradient, dx, begin, end, of_slot);
}

/// Adds the corner forces of the mean change dp of the pressure of four nodes.
template <class Real>
[[gnu::always_inline]] inline void add_pressure_changes(const ElementGroup<Real>& group, const Real* gradient,
                                                        const Real* dp, std::size_t begin, std::size_t end,
                                                        Real* corner) {
  constexpr std::size_t lanes = ElementGroup<Real>::lanes;
  for (std::size_t p = begin; p < end; ++p) {
    const Real* of_packet = gradient + 9 * lanes * p;
    Real sum[lanes] = {}, out[12][lanes];
    for (const auto& list : group.node)
      for (std::size_t l = 0; l < lanes; ++l) sum[l] += dp[list[p * lanes + l]];
#pragma GCC ivdep
    for (std::size_t l = 0; l < lanes; ++l) {
      const Real mean = sum[l] / 4;
      for (std::size_t r = 0; r < 9; ++r) out[3 + r][l] = -mean * of_packet[lanes * r + l];
      for (std::size_t i = 0; i < 3; ++i) out[i][l] = -(out[3 + i][l] + out[6 + i][l] + out[9 + i][l]);
    }
    write_packet_corners(out, corner + 3 * (group.first_corner + 4 * p * lanes), true);
  }
}
template <class Real>
HEML_WIDE void add_wide_pressure_changes(const ElementGroup<Real>& group, const Real* gradient, const Real* dp,
                                         std::size_t begin, std::size_t end, Real* corner) {
  add_pressure_changes(group, gradient, dp, begin, end, corner);
}

/// Adds to bounds (8 a packet), with the largest stiffness κ ψ'' and the mean pressure of four nodes.
template <class Real>
[[gnu::always_inline]] inline void add_bounds(const ElementGroup<Real>& group, const Real* weights, const Real* x,
                                              const Real* stiffness, const Real* pressure, std::size_t begin,
                                              std::size_t end, Real* bounds) {
  constexpr std::size_t lanes = ElementGroup<Real>::lanes;
  for (std::size_t p = begin; p < end; ++p, bounds += lanes) {
    const Packet<Real, false> packet(group, x, p * lanes);
    const PacketWeights<Real> of_corners(group, weights, p);
    Real kappa[lanes] = {}, mean[lanes] = {}, bound[lanes];
    for (const auto& list : group.node)
      for (std::size_t l = 0; l < lanes; ++l) {
        kappa[l] = std::max(kappa[l], stiffness[list[p * lanes + l]]);
        mean[l] += pressure[list[p * lanes + l]];
      }
#pragma GCC ivdep
    for (std::size_t l = 0; l < lanes; ++l) {
      const Corners<Real> at(packet.x, l);
      const RestShape<Real> rest = packet.rest(l);
      const auto kinematics = element_kinematics<true, true, false, false>(at.x[0], at.x[1], at.x[2], at.x[3], rest);
      bound[l] = 4 / group.density *
                 (kappa[l] * corner_sums(kinematics, rest, of_corners.at(l)).nJ +
                  2 * std::abs(mean[l] / 4) * std::sqrt(stretch_bounds(kinematics.at).max) *
                      max_gradient(rest.A, of_corners.at(l)));
    }
    for (std::size_t l = 0; l < lanes; ++l) bounds[l] += bound[l];
  }
}

template <class Real>
HEML_WIDE void add_wide_bounds(const ElementGroup<Real>& group, const Real* weights, const Real* x,
                               const Real* stiffness, const Real* pressure, std::size_t begin, std::size_t end,
                               Real* bounds) {
  add_bounds(group, weights, x, stiffness, pressure, begin, end, bounds);
}
}  // namespace

template <class Real>
NodalPressure<Real>::NodalPressure(std::vector<const ElementGroup<Real>*> groups, const CornerMap& corners,
                                   const std::vector<std::vector<Real>>& kappa, VolumeTerm term, bool continuation)
    : groups_(std::move(groups)), corners_(corners), kappa_(kappa), term_(term), continuation_(continuation) {
  std::size_t count = 0;
  for (const auto* group : groups_) count += 4 * group->volume.size();
  of_corner_.assign(count / 4, 0);  // one value for the four corners of a slot
  ThreadTeam alone(1);
  gather(node_volume_, alone,
         [](const ElementGroup<Real>& group, std::size_t, std::size_t s) { return group.volume[s]; });
  gather(node_kappa_, alone,
         [&](const ElementGroup<Real>& group, std::size_t g, std::size_t s) { return group.volume[s] * kappa_[g][s]; });
  for (std::size_t n = 0; n < node_volume_.size(); ++n)
    if (node_volume_[n] > 0) node_kappa_[n] /= node_volume_[n];
}

/// Sums a value of every slot at its four nodes, in ascending order of corner.
template <class Real>
static void sum_at_nodes(const CornerMap& corners, const std::vector<Real>& of_slot, std::vector<Real>& node_sums,
                         ThreadTeam& team) {
  const std::size_t nodes = corners.start.size() - 1;
  node_sums.resize(nodes);
  team.parallel_for(nodes, node_grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      Real sum = 0;
      for (std::size_t k = corners.start[n]; k < corners.start[n + 1]; ++k) sum += of_slot[corners.corners[k] / 4];
      node_sums[n] = sum;
    }
  });
}

/// Sums of_slot(group, group index, slot) at the four nodes of every slot.
template <class Real>
template <class OfSlot>
void NodalPressure<Real>::gather(std::vector<Real>& node_sums, ThreadTeam& team, const OfSlot& of_slot) {
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const ElementGroup<Real>& group = *groups_[g];
    team.parallel_for(group.size(), slot_grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t s = begin; s < end; ++s) of_corner_[group.first_corner / 4 + s] = of_slot(group, g, s);
    });
  }
  sum_at_nodes(corners_, of_corner_, node_sums, team);
}

template <class Real>
VolumeDerivatives<Real> NodalPressure<Real>::psi(Real J) const {
  return unit_volume_term(term_, continuation_, J);
}

template <class Real>
void NodalPressure<Real>::average(const Real* x, NodeValues& values, ThreadTeam& team) {
  std::vector<Real>& ratio = values.ratio;
  if (has_avx2()) {
    for (const ElementGroup<Real>* group : groups_)
      team.parallel_for(group->packets(), slot_grain / group->lanes, [&](std::size_t begin, std::size_t end) {
        packet_volumes(*group, x, begin, end, &of_corner_[group->first_corner / 4]);
      });
    sum_at_nodes(corners_, of_corner_, ratio, team);
  } else {
    gather(ratio, team, [&](const ElementGroup<Real>& group, std::size_t, std::size_t s) {
      RestShape<Real> rest;
      return group.volume[s] * volume_kinematics(group, x, s, rest).at.J;
    });
  }
  evaluate(values, team);
}

/// Turns the sums of V J in `ratio` into ratios, and evaluates the pressures.
template <class Real>
void NodalPressure<Real>::evaluate(NodeValues& values, ThreadTeam& team) const {
  std::vector<Real>&ratio = values.ratio, &pressure = values.pressure;
  pressure.resize(ratio.size());
  team.parallel_for(ratio.size(), node_grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      ratio[n] = node_volume_[n] > 0 ? ratio[n] / node_volume_[n] : Real(1);
      pressure[n] = node_kappa_[n] * psi(ratio[n]).w1;
    }
  });
}

template <class Real>
const Real* NodalPressure<Real>::at_volumes(const std::vector<Real>& sums, ThreadTeam& team) {
  last_.ratio = sums;
  evaluate(last_, team);
  return last_.pressure.data();
}

template <class Real>
bool NodalPressure<Real>::is_defined() const {
  return std::all_of(last_.ratio.begin(), last_.ratio.end(),
                     [this](Real J) { return volume_term_defined(term_, continuation_, J); });
}

template <class Real>
Real NodalPressure<Real>::pressure(const NodeValues& values, std::size_t g, std::size_t s) const {
  const ElementGroup<Real>& group = *groups_[g];
  Real sum = 0;
  for (const auto& list : group.node) sum += values.pressure[static_cast<std::size_t>(list[s])];
  return sum / 4;
}

template <class Real>
bool NodalPressure<Real>::add_forces(const Real* x, Real* corner, ThreadTeam& team) {
  average(x, last_, team);
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const ElementGroup<Real>& group = *groups_[g];
    if (has_avx2()) {
      team.parallel_for(group.packets(), slot_grain / group.lanes, [&](std::size_t begin, std::size_t end) {
        add_packet_pressures(group, x, last_.pressure.data(), begin, end, corner);
      });
      continue;
    }
    team.parallel_for(group.size(), slot_grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t s = begin; s < end; ++s) {
        RestShape<Real> rest;
        const auto kinematics = volume_kinematics(group, x, s, rest);
        Real f[12];
        forces_from_tensions<true>(Tensions<Real>{{}, pressure(last_, g, s)}, kinematics.e, kinematics.cross, f);
        Real* to = corner + 3 * (group.first_corner + 4 * s);
        for (int i = 0; i < 12; ++i) to[i] += f[i];
      }
    });
  }
  return is_defined();
}

template <class Real>
void NodalPressure<Real>::linearise(const Real* x, ThreadTeam& team) {
  average(x, linear_, team);
  node_stiffness_.resize(linear_.ratio.size());
  for (std::size_t n = 0; n < node_stiffness_.size(); ++n)
    node_stiffness_[n] = node_kappa_[n] * psi(linear_.ratio[n]).w2;
  gradient_.resize(groups_.size());
  for (std::size_t g = 0; g < groups_.size(); ++g) gradient_[g].resize(9 * groups_[g]->volume.size());
}

template <class Real>
void NodalPressure<Real>::linearise_group(std::size_t g, const Real* x, std::size_t begin, std::size_t end, Real* K) {
  const ElementGroup<Real>& group = *groups_[g];
  constexpr std::size_t lanes = ElementGroup<Real>::lanes;
  for (std::size_t s = begin * lanes; s < end * lanes; ++s) {
    RestShape<Real> rest;
    const auto kinematics = volume_kinematics(group, x, s, rest);
    Real* gradient = &gradient_[g][9 * lanes * (s / lanes) + s % lanes];
    for (std::size_t r = 0; r < 9; ++r) gradient[lanes * r] = kinematics.cross[r / 3][r % 3] / 6;
    Real k[edge_entries] = {};
    add_geometric_stiffness(Tensions<Real>{{}, pressure(g, s)}, kinematics.e, k);
    write_edge_stiffness(k, s, K, true);
  }
}

template <class Real>
void NodalPressure<Real>::add_force_differential(const Real* dx, Real* corner, ThreadTeam& team) {
  const auto each_packet = [&](std::size_t g, const auto& work) {
    team.parallel_for(groups_[g]->packets(), slot_grain / ElementGroup<Real>::lanes, work);
  };
  for (std::size_t g = 0; g < groups_.size(); ++g)
    each_packet(g, [&, &group = *groups_[g], gradient = gradient_[g].data()](std::size_t begin, std::size_t end) {
      Real* of_slot = &of_corner_[group.first_corner / 4];
      if (has_avx2()) return wide_volume_changes(group, gradient, dx, begin, end, of_slot);
      volume_changes(group, gradient, dx, begin, end, of_slot);
    });
  std::vector<Real> dp;
  sum_at_nodes(corners_, of_corner_, dp, team);
  for (std::size_t n = 0; n < dp.size(); ++n)
    dp[n] = node_volume_[n] > 0 ? node_stiffness_[n] * dp[n] / node_volume_[n] : Real(0);
  for (std::size_t g = 0; g < groups_.size(); ++g)
    each_packet(g, [&, &group = *groups_[g], gradient = gradient_[g].data()](std::size_t begin, std::size_t end) {
      if (has_avx2()) return add_wide_pressure_changes(group, gradient, dp.data(), begin, end, corner);
      add_pressure_changes(group, gradient, dp.data(), begin, end, corner);
    });
}

template <class Real>
double NodalPressure<Real>::energy(const Real* x) {
  ThreadTeam alone(1);
  average(x, last_, alone);
  double sum = 0;
  for (std::size_t n = 0; n < last_.ratio.size(); ++n)
    sum += static_cast<double>(node_volume_[n] / 4 * node_kappa_[n]) * static_cast<double>(psi(last_.ratio[n]).w);
  return sum;
}

/// (Σ w dJ)² ≤ Σ w (dJ)² at every node (Jensen), so the averaged form is bounded by the form per element with the
/// largest κ ψ'' of its corners; p_t d²J is bounded by |d²J| ≤ 2 σ1 |dF|².
template <class Real>
void NodalPressure<Real>::begin_bounds(const Real* x, ThreadTeam& team) {
  average(x, last_, team);
  stiffness_.resize(last_.ratio.size());
  for (std::size_t n = 0; n < stiffness_.size(); ++n)
    stiffness_[n] = node_kappa_[n] * std::max(psi(last_.ratio[n]).w2, Real(0));
}

template <class Real>
void NodalPressure<Real>::add_frequency_bounds(std::size_t g, const Real* weights, const Real* x, std::size_t begin,
                                               std::size_t end, Real* bounds) const {
  const Real *stiffness = stiffness_.data(), *pressure = last_.pressure.data();
  if (has_avx2()) return add_wide_bounds(*groups_[g], weights, x, stiffness, pressure, begin, end, bounds);
  add_bounds(*groups_[g], weights, x, stiffness, pressure, begin, end, bounds);
}

template <class Real>
void NodalPressure<Real>::add_stiffness(std::size_t g, std::size_t s, Real K[edge_entries]) const {
  const ElementGroup<Real>& group = *groups_[g];
  constexpr std::size_t lanes = ElementGroup<Real>::lanes;
  Real stiffness = 0, gradient[1][9];
  for (const auto& list : group.node) stiffness += node_stiffness_[static_cast<std::size_t>(list[s])] / 4;
  for (std::size_t r = 0; r < 9; ++r) gradient[0][r] = gradient_[g][9 * lanes * (s / lanes) + lanes * r + s % lanes];
  add_outer_products<1>(gradient, {{stiffness}}, 1 / group.volume[s], K);
}

template class NodalPressure<float>;
template class NodalPressure<double>;

}  // namespace heml
