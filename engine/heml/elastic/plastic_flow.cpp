#include <algorithm>
#include <cmath>
#include <heml/elastic/edge_stiffness.hpp>
#include <heml/elastic/plastic_flow.hpp>
#include <heml/elastic/term_parts.hpp>
#include <limits>
#include <utility>

namespace heml {
namespace {

constexpr double min_J = 0.05;                    // no flow below this J, where the logarithmic strain is meaningless
constexpr double surely_below = 0.999;  // of the yield stress: bounds of the stress are less exact than stresses

template <class Real>
void put_rest_shape(ElementGroup<Real>& group, std::size_t s, const Real A[6]) {
  for (std::size_t i = 0; i < 6; ++i) group.A[i][s] = A[i];
}

/// Adds the change of stiffness that comes with flow (return_mapping.hpp) in terms of ε_i and of the turning of the
/// principal axes. With q_i = L N_i and F_i = Σ_b q_ib e_b,
///     ∂C_ij/∂e_a = q_ia F_j + q_ja F_i,   ∂ε_i/∂e_a = q_ia F_i / c_i,
/// and the factor of (dC_ij)² is (τ_i − τ_j)/(2 c_i c_j) (coth(ε_i − ε_j) − coth((ε_i − d_i) − (ε_j − d_j))).
template <class Real>
void add_flow_stiffness(const SymmetricEigen3<Real>& e, const Real factor[3][3], const Real edges[3][3], Real volume,
                        const PlasticReturn<Real>& flow, const FlowStress<Real>& yield, Real K[edge_entries]) {
  Real q[3][3], F[3][3], strain[3][9], turn[3][9], change[3][3], turning[3][3] = {};
  for (int i = 0; i < 3; ++i) {
    for (int a = 0; a < 3; ++a)
      q[i][a] = factor[a][0] * e.vector[i][0] + factor[a][1] * e.vector[i][1] + factor[a][2] * e.vector[i][2];
    sum_of_edges(q[i], edges, F[i]);
    for (int a = 0; a < 3; ++a)
      for (int k = 0; k < 3; ++k) strain[i][3 * a + k] = q[i][a] * F[i][k] / e.value[i];
  }
  flow_tangent(flow, yield, change);
  add_outer_products(strain, change, volume, K);
  constexpr int row[3] = {0, 0, 1}, column[3] = {1, 2, 2};
  for (int pair = 0; pair < 3; ++pair) {
    const int i = row[pair], j = column[pair];
    for (int a = 0; a < 3; ++a)
      for (int k = 0; k < 3; ++k) turn[pair][3 * a + k] = q[i][a] * F[j][k] + q[j][a] * F[i][k];
    const Real flowed = flow.flow[i] - flow.flow[j];
    const Real apart = (natural_log(e.value[i]) - natural_log(e.value[j])) / 2 - flowed;
    const Real stress = flow.stress.tau[i] - flow.stress.tau[j];
    // (τ_i − τ_j) (coth(x + flowed) − coth(x)), whose limit at x = 0 has τ_i − τ_j = slope x and flowed/x of the same.
    const Real slope = flow.stress.slope[i][i] - flow.stress.slope[i][j];
    const Real ratio = slope * flow.length / flow.stress.norm();
    const bool are_same = std::abs(apart) < std::sqrt(std::numeric_limits<Real>::epsilon());
    const Real difference =
        are_same ? slope * (1 / (1 + ratio) - 1) : stress * (1 / std::tanh(apart + flowed) - 1 / std::tanh(apart));
    turning[pair][pair] = difference / (2 * e.value[i] * e.value[j]);
  }
  add_outer_products(turn, turning, volume, K);
}

}  // namespace

template <class Real>
PlasticFlow<Real>::PlasticFlow(std::unique_ptr<GroupTerm<Real>> law, const Plasticity& plasticity, const Group& group)
    : law_(std::move(law)),
      yield_(static_cast<Real>(plasticity.yield)),
      hardening_(static_cast<Real>(plasticity.hardening)),
      rest_A_(group.A),
      strain_(group.volume.size(), 0),
      stress_bounds_(group.volume.size(), 0) {}

/// Returns the plastic work, J; padding does none.
template <class Real>
double PlasticFlow<Real>::add_flow(Group& group, std::size_t s, const Yielding& yielding) {
  Real A[6];
  strain_[s] += yielding.flow.equivalent_strain();
  yielding.rest_A(A);
  put_rest_shape(group, s, A);
  flowed_.push_back(s);
  return s < group.size() ? static_cast<double>(group.volume[s]) * yielding.flow.work() : 0.0;
}

template <class Real>
double PlasticFlow<Real>::flow(Group& group, const Real* x) {
  law_->mises_bounds(group, x, 0, group.packets(), stress_bounds_.data());
  return flow_beyond_bounds(group, x);
}

template <class Real>
double PlasticFlow<Real>::flow_at_stress(Group& group, const Real* x) {
  for (std::size_t s = group.size(); s < group.volume.size(); ++s)  // padding repeats the last slot
    stress_bounds_[s] = stress_bounds_[group.size() - 1];
  return flow_beyond_bounds(group, x);
}

template <class Real>
double PlasticFlow<Real>::flow_beyond_bounds(Group& group, const Real* x) {
  double work = 0;
  forget_trial();
  flowed_.clear();
  each_yielding(group, x, 0, group.packets(),
                [&](std::size_t s, const Yielding& yielding) { work += add_flow(group, s, yielding); });
  return work;
}

template <class Real>
double PlasticFlow<Real>::flow(Group& group, const Real* x, std::span<const std::size_t> slots) {
  double work = 0;
  forget_trial();
  flowed_.clear();
  const auto flow_at = [&](std::size_t s) {
    Yielding yielding;
    if (find_flow(group, x, s, rest_shape(group, s), yielding)) work += add_flow(group, s, yielding);
  };
  for (const std::size_t s : slots) flow_at(s);
  const bool has_last = !slots.empty() && slots.back() + 1 == group.size();
  for (std::size_t s = group.size(); has_last && s < group.volume.size(); ++s) flow_at(s);  // padding repeats it
  return work;
}

template <class Real>
Real PlasticFlow<Real>::least_stress_of_flow(std::size_t s) const {
  return Real(surely_below) * flow_stress(s).at_start;
}

template <class Real>
bool PlasticFlow<Real>::begin_trial(Group& group, std::span<const Real> x) {
  is_on_trial_ = true;
  if (std::equal(x.begin(), x.end(), trial_x_.begin(), trial_x_.end())) {
    std::swap(group.A, other_A_);
    return true;
  }
  trial_x_.assign(x.begin(), x.end());
  other_A_ = group.A;
  trial_strain_.assign(group.volume.size(), Real(0));
  return false;
}

template <class Real>
void PlasticFlow<Real>::try_flow(Group& group, const Real* x, std::size_t begin, std::size_t end) {
  law_->mises_bounds(group, x, begin, end, stress_bounds_.data() + begin * Group::lanes);
  each_yielding(group, x, begin, end, [&](std::size_t s, const Yielding& yielding) {
    trial_strain_[s] = yielding.flow.equivalent_strain();
    Real A[6];
    yielding.rest_A(A);
    for (std::size_t i = 0; i < 6; ++i) group.A[i][s] = A[i];
  });
}

template <class Real>
std::vector<std::size_t> PlasticFlow<Real>::trial_slots() const {
  std::vector<std::size_t> slots;
  for (std::size_t s = 0; s < trial_strain_.size(); ++s)
    if (trial_strain_[s] != 0) slots.push_back(s);
  return slots;
}

template <class Real>
double PlasticFlow<Real>::trial_potential(const Group& group) const {
  if (!is_on_trial_) return 0;
  double sum = 0;
  for (std::size_t s = 0; s < group.size(); ++s) {
    if (trial_strain_[s] == 0) continue;
    const double p = static_cast<double>(trial_strain_[s]), H = static_cast<double>(hardening_);
    sum += static_cast<double>(group.volume[s]) * p *
           (static_cast<double>(yield_) + H * static_cast<double>(strain_[s]) + H * p / 2);
  }
  return sum;
}

template <class Real>
void PlasticFlow<Real>::end_trial(Group& group) {
  std::swap(group.A, other_A_);
  is_on_trial_ = false;
}

template <class Real>
void PlasticFlow<Real>::add_stiffness(const Group& group, const Real* x, std::size_t begin, std::size_t end,
                                      Real* K) const {
  if (!is_on_trial_) return;
  for (std::size_t s = begin * Group::lanes; s < end * Group::lanes; ++s) {
    if (trial_strain_[s] == 0) continue;
    RestShape<Real> start = rest_shape(group, s);
    for (std::size_t i = 0; i < 6; ++i) start.A[i] = other_A_[i][s];
    Yielding yielding;
    if (!find_flow(group, x, s, start, yielding) || !yielding.flow.is_minimum) continue;
    Real k[edge_entries] = {};
    add_flow_stiffness(yielding.e, yielding.factor, yielding.edges, group.volume[s], yielding.flow, flow_stress(s), k);
    write_edge_stiffness(k, s, K, true);
  }
}

template <class Real>
ElementGroup<Real> PlasticFlow<Real>::at_rest(Group group) const {
  group.A = rest_A_;
  return group;
}

template <class Real>
void PlasticFlow<Real>::reset(Group& group) {
  forget_trial();
  group = at_rest(std::move(group));
  std::fill(strain_.begin(), strain_.end(), Real(0));
}

template <class Real>
SlotStates<Real> PlasticFlow<Real>::slot_states(Group& group) {
  forget_trial();  // who asks may write
  SlotStates<Real> states = {{&strain_, 1}};
  for (auto& list : group.A) states.push_back({&list, 1});
  return states;
}

template <class Real>
void PlasticFlow<Real>::scale_rest_shape(std::size_t s, Real factor) {
  forget_trial();
  for (auto& list : rest_A_) list[s] /= factor * factor;
}

template <class Real>
void PlasticFlow<Real>::gather_slots(std::span<const std::size_t> from) {
  forget_trial();
  for (auto& list : rest_A_) heml::gather_slots(list, from);
  heml::gather_slots(strain_, from);
  stress_bounds_.resize(strain_.size());
}

template <class Real>
void PlasticFlow<Real>::transfer_state(const PlasticFlow& other, const Group& of_other,
                                       std::span<const std::size_t> from,
                                       const std::vector<SubelementMap<Real>>& subelement_maps, Group& group) {
  forget_trial();
  for (std::size_t s = 0; s < from.size(); ++s) {
    strain_[s] = other.strain_[from[s]];
    if (strain_[s] == 0) continue;
    Real A[6];
    for (std::size_t i = 0; i < 6; ++i) A[i] = of_other.A[i][from[s]];
    subelement_maps[s].metric(A);
    put_rest_shape(group, s, A);
  }
}

/// Slots that flow, of those whose bound of the stress says that they may.
template <class Real>
template <class Visit>
void PlasticFlow<Real>::each_yielding(const Group& group, const Real* x, std::size_t begin, std::size_t end,
                                      const Visit& visit) {
  for (std::size_t s = begin * Group::lanes; s < end * Group::lanes; ++s) {
    if (stress_bounds_[s] < least_stress_of_flow(s)) continue;
    Yielding yielding;
    if (find_flow(group, x, s, rest_shape(group, s), yielding)) visit(s, yielding);
  }
}

template <class Real>
bool PlasticFlow<Real>::find_flow(const Group& group, const Real* x, std::size_t s, const RestShape<Real>& rest,
                                  Yielding& yielding) const {
  const auto kinematics = full_kinematics(group, x, s, rest);
  if (!(kinematics.at.J > Real(min_J))) return false;
  Real C[6];
  cholesky3(rest.A, yielding.factor);
  into_rest_frame(yielding.factor, kinematics.G, C);
  yielding.e = symmetric_eigen3(C);
  std::copy_n(&kinematics.e[0][0], 9, &yielding.edges[0][0]);
  yielding.flow = return_mapping(*law_, group, s, yielding.e.value, kinematics.at.J, flow_stress(s));
  return yielding.flow.length > 0;
}

/// A = L N exp(−2d) Nᵀ Lᵀ.
template <class Real>
void PlasticFlow<Real>::Yielding::rest_A(Real A[6]) const {
  Real shrink[3], R[6];
  for (int i = 0; i < 3; ++i) shrink[i] = natural_exp(-2 * flow.flow[i]);
  spectral_sum3(e, shrink, R);
  congruence3(factor, R, A);
}

template <class Real>
std::unique_ptr<PlasticFlow<Real>> make_flow(const Material& material, bool continuation,
                                             const ElementGroup<Real>& group) {
  if (!material.plasticity) return nullptr;
  return std::make_unique<PlasticFlow<Real>>(make_law_term<Real>(material, continuation, false), *material.plasticity,
                                             group);
}

template class PlasticFlow<float>;
template class PlasticFlow<double>;
template std::unique_ptr<PlasticFlow<float>> make_flow(const Material&, bool, const ElementGroup<float>&);
template std::unique_ptr<PlasticFlow<double>> make_flow(const Material&, bool, const ElementGroup<double>&);

}  // namespace heml
