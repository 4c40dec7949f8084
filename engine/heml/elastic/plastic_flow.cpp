#include <algorithm>
#include <cmath>
#include <heml/elastic/plastic_flow.hpp>
#include <heml/elastic/term_parts.hpp>

namespace heml {
namespace {

constexpr double min_J = 0.05;                    // no flow below this J, where the logarithmic strain is meaningless
constexpr double equivalent = 0.816496580927726;  // √(2/3)
constexpr double surely_below = 0.999;  // of the yield stress: bounds of the stress are less exact than stresses

template <class Real>
Real mises(const Real tau[3]) {
  return std::sqrt(Real(1.5) * (tau[0] * tau[0] + tau[1] * tau[1] + tau[2] * tau[2]));
}

/// Stores A and gamma, the largest eigenvalue of Σ_a g_a g_aᵀ, similar to Lᵀ(I + 1 1ᵀ)L with A = LLᵀ.
template <class Real>
void put_rest_shape(ElementGroup<Real>& group, std::size_t s, const Real A[6]) {
  Real L[3][3], sum[6];
  for (std::size_t i = 0; i < 6; ++i) group.A[i][s] = A[i];
  cholesky3(A, L);
  const Real ones[6] = {2, 2, 2, 1, 1, 1};
  into_rest_frame(L, ones, sum);
  const auto spread = symmetric_eigen3(sum);
  group.gamma[s] = std::max({spread.value[0], spread.value[1], spread.value[2]});
}

/// A = L N exp(−2 Δγ n) Nᵀ Lᵀ.
template <class Real>
void replace_rest_shape(ElementGroup<Real>& group, std::size_t s, const Real factor[3][3],
                        const SymmetricEigen3<Real>& e, Real gamma, const Real n[3]) {
  Real shrink[3], R[6], A[6];
  for (int i = 0; i < 3; ++i) shrink[i] = natural_exp(-2 * gamma * n[i]);
  spectral_sum3(e, shrink, R);
  congruence3(factor, R, A);
  put_rest_shape(group, s, A);
}

/// Writes the direction n (unit) of the deviatoric logarithmic strain at eigenvalues c of C. Returns its norm.
template <class Real>
Real flow_direction(const Real c[3], Real n[3]) {
  Real mean = 0, length = 0;
  for (int i = 0; i < 3; ++i) {
    n[i] = natural_log(c[i]) / 2;
    mean += n[i] / 3;
  }
  for (int i = 0; i < 3; ++i) length += (n[i] - mean) * (n[i] - mean);
  length = std::sqrt(length);
  for (int i = 0; i < 3; ++i) n[i] = (n[i] - mean) / length;
  return length;
}

}  // namespace

template <class Real>
PlasticFlow<Real>::PlasticFlow(std::unique_ptr<GroupTerm<Real>> law, const Plasticity& plasticity, const Group& group)
    : law_(std::move(law)),
      yield_(static_cast<Real>(plasticity.yield)),
      hardening_(static_cast<Real>(plasticity.hardening)),
      rest_A_(group.A),
      rest_gamma_(group.gamma),
      strain_(group.volume.size(), 0) {}

template <class Real>
double PlasticFlow<Real>::flow(Group& group, const Real* x) {
  double work = 0;
  stress_bounds_.resize(group.volume.size());
  law_->mises_bounds(group, x, 0, group.packets(), stress_bounds_.data());
  for (std::size_t s = 0; s < group.volume.size(); ++s) {
    if (stress_bounds_[s] < Real(surely_below) * (yield_ + hardening_ * strain_[s])) continue;
    const double of_slot = return_map(group, x, s);
    if (s < group.size()) work += of_slot;  // padding does not count
  }
  return work;
}

template <class Real>
ElementGroup<Real> PlasticFlow<Real>::at_rest(Group group) const {
  group.A = rest_A_;
  group.gamma = rest_gamma_;
  return group;
}

template <class Real>
void PlasticFlow<Real>::reset(Group& group) {
  group = at_rest(std::move(group));
  std::fill(strain_.begin(), strain_.end(), Real(0));
}

template <class Real>
SlotStates<Real> PlasticFlow<Real>::slot_states(Group& group) {
  SlotStates<Real> states = {{&strain_, 1}, {&group.gamma, 1}};
  for (auto& list : group.A) states.push_back({&list, 1});
  return states;
}

template <class Real>
void PlasticFlow<Real>::scale_rest_shape(std::size_t s, Real factor) {
  for (auto& list : rest_A_) list[s] /= factor * factor;
  rest_gamma_[s] /= factor * factor;
}

template <class Real>
void PlasticFlow<Real>::gather_slots(std::span<const std::size_t> from) {
  for (auto& list : rest_A_) heml::gather_slots(list, from);
  heml::gather_slots(rest_gamma_, from);
  heml::gather_slots(strain_, from);
}

template <class Real>
void PlasticFlow<Real>::transfer_state(const PlasticFlow& other, const Group& of_other,
                                       std::span<const std::size_t> from,
                                       const std::vector<SubelementMap<Real>>& subelement_maps, Group& group) {
  for (std::size_t s = 0; s < from.size(); ++s) {
    strain_[s] = other.strain_[from[s]];
    if (strain_[s] == 0) continue;
    Real A[6];
    for (std::size_t i = 0; i < 6; ++i) A[i] = of_other.A[i][from[s]];
    subelement_maps[s].metric(A);
    put_rest_shape(group, s, A);
  }
}

template <class Real>
double PlasticFlow<Real>::return_map(Group& group, const Real* x, std::size_t s) {
  const auto rest = rest_shape(group, s);
  const auto kinematics = full_kinematics(group, x, s, rest);
  if (!(kinematics.at.J > Real(min_J))) return 0;
  Real factor[3][3], C[6], tau[3], n[3];
  cholesky3(rest.A, factor);
  into_rest_frame(factor, kinematics.G, C);
  const auto e = symmetric_eigen3(C);
  law_->deviatoric_stress(group, s, e.value, kinematics.at.J, tau);
  if (!(mises(tau) > yield_ + hardening_ * strain_[s])) return 0;

  const Real length = flow_direction(e.value, n);
  const auto yield_function = [&](Real gamma) {  // stress beyond yield after a flow of gamma; sets tau
    Real c[3];
    for (int i = 0; i < 3; ++i) c[i] = e.value[i] * natural_exp(-2 * gamma * n[i]);
    law_->deviatoric_stress(group, s, c, kinematics.at.J, tau);
    return mises(tau) - yield_ - hardening_ * (strain_[s] + Real(equivalent) * gamma);
  };
  Real low = 0, high = length;  // the deviatoric strain is 0 at the upper end
  for (int i = 0; i < 60 && high - low > Real(1e-14) * length; ++i) {
    const Real middle = (low + high) / 2;
    (yield_function(middle) > 0 ? low : high) = middle;
  }
  yield_function(high);
  double power = 0;
  for (int i = 0; i < 3; ++i) power += static_cast<double>(tau[i] * n[i]);
  strain_[s] += Real(equivalent) * high;
  replace_rest_shape(group, s, factor, e, high, n);
  return static_cast<double>(rest.volume) * power * static_cast<double>(high);
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
