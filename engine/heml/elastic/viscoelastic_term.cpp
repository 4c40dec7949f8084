#include <algorithm>
#include <cmath>
#include <heml/elastic/avx2_dispatch.hpp>
#include <heml/elastic/viscoelastic_term.hpp>

namespace heml {
namespace {

/// Adds the viscous tensions V (η A dG A + ζ/2 (A:dG) A) / h.
template <class Real>
[[gnu::always_inline]] inline void add_viscous_tensions(const Real dG[6], const RestShape<Real>& rest, Real eta,
                                                        Real zeta, Real per_step, Real T[6]) {
  const Real* A = rest.A;
  const Real a[3][3] = {{A[0], A[3], A[4]}, {A[3], A[1], A[5]}, {A[4], A[5], A[2]}};
  Real AdGA[6];
  congruence3(a, dG, AdGA);
  const Real bulk = zeta / 2 * double_contraction3(A, dG), scale = rest.volume * per_step;
  for (int i = 0; i < 6; ++i) T[i] += scale * (eta * AdGA[i] + bulk * A[i]);
}

/// Parameters of a term without relaxation.
template <class Real>
struct Viscous {
  Real eta, zeta, per_step;
  std::size_t stride;
};

template <class Real>
HEML_WIDE void viscous_forces(const Viscous<Real>& of, const ElementGroup<Real>& group, const Real* x,
                              const Real* state, std::size_t begin, std::size_t end, Real* corner, bool add) {
  constexpr std::size_t lanes = ElementGroup<Real>::lanes;
  for (std::size_t p = begin; p < end; ++p) {
    const Packet<Real, false> packet(group, x, p * lanes);
    Real before[6][lanes], out[12][lanes];
    for (std::size_t l = 0; l < lanes; ++l)
      for (std::size_t i = 0; i < 6; ++i) before[i][l] = state[of.stride * (p * lanes + l) + i];
#pragma GCC ivdep
    for (std::size_t l = 0; l < lanes; ++l) {
      const Corners<Real> at(packet.x, l);
      const RestShape<Real> rest = packet.rest(l);
      const auto kinematics = element_kinematics<false, false, false, false>(at.x[0], at.x[1], at.x[2], at.x[3], rest);
      Real dG[6], f[12];
      for (std::size_t i = 0; i < 6; ++i) dG[i] = kinematics.G[i] - before[i][l];
      Tensions<Real> t{};
      add_viscous_tensions(dG, rest, of.eta, of.zeta, of.per_step, t.T);
      forces_from_tensions<false>(t, kinematics.e, kinematics.cross, f);
      for (int i = 0; i < 12; ++i) out[i][l] = f[i];
    }
    write_packet_corners(out, corner + 3 * (group.first_corner + 4 * p * lanes), add);
  }
}

/// Stores the Gram matrices at x, from which the next step starts.
template <class Real>
HEML_WIDE void store_gram(const ElementGroup<Real>& group, const Real* x, std::size_t stride, Real* state) {
  constexpr std::size_t lanes = ElementGroup<Real>::lanes;
  for (std::size_t p = 0; p < group.packets(); ++p) {
    const Packet<Real, false> packet(group, x, p * lanes);
    Real G[6][lanes];
#pragma GCC ivdep
    for (std::size_t l = 0; l < lanes; ++l) {
      const Corners<Real> at(packet.x, l);
      const auto kinematics =
          element_kinematics<false, false, false, false>(at.x[0], at.x[1], at.x[2], at.x[3], packet.rest(l));
      for (int i = 0; i < 6; ++i) G[i][l] = kinematics.G[i];
    }
    for (std::size_t l = 0; l < lanes; ++l)
      for (std::size_t i = 0; i < 6; ++i) state[stride * (p * lanes + l) + i] = G[i][l];
  }
}

/// Largest bound of the damping of packets [begin, end), 1/s: uᵀDu = V/2 (η |dC|² + ζ/2 (tr dC)²).
template <class Real>
[[gnu::always_inline]] inline Real viscous_bound(const Viscous<Real>& of, const ElementGroup<Real>& group,
                                                 const Real* x, std::size_t begin, std::size_t end) {
  constexpr std::size_t lanes = ElementGroup<Real>::lanes;
  Real largest = 0;
  for (std::size_t p = begin; p < end; ++p) {
    const Packet<Real, false> packet(group, x, p * lanes);
    Real bound[lanes];
#pragma GCC ivdep
    for (std::size_t l = 0; l < lanes; ++l) {
      const Corners<Real> at(packet.x, l);
      const RestShape<Real> rest = packet.rest(l);
      const auto kinematics = element_kinematics<true, true, false, false>(at.x[0], at.x[1], at.x[2], at.x[3], rest);
      bound[l] = 4 / group.density *
                 (2 * of.eta * stretch_bounds(kinematics.at).max * group.gamma[p * lanes + l] +
                  of.zeta / 4 * corner_sums(kinematics, rest).n1);
    }
    for (std::size_t l = 0; l < lanes; ++l) largest = bound[l] > largest || std::isnan(bound[l]) ? bound[l] : largest;
  }
  return largest;
}

template <class Real>
HEML_WIDE Real wide_viscous_bound(const Viscous<Real>& of, const ElementGroup<Real>& group, const Real* x,
                                  std::size_t begin, std::size_t end) {
  return viscous_bound(of, group, x, begin, end);
}

}  // namespace

template <class Real>
FanBranch<Real> branch_during(Real gamma, Real tau, Real h) {
  return {natural_exp(-h / tau), gamma * natural_exp(-h / (2 * tau))};
}

template <class Real>
ViscoelasticTerm<Real>::ViscoelasticTerm(std::unique_ptr<GroupTerm<Real>> law, const Material& material)
    : law_(std::move(law)),
      eta_(static_cast<Real>(material.viscosity)),
      zeta_(static_cast<Real>(material.bulk_viscosity)) {
  for (const PronyTerm& term : material.relaxation) {
    branches_.push_back({static_cast<Real>(term.gamma), static_cast<Real>(term.tau), {1, 0}});
    total_gamma_ += branches_.back().gamma;
  }
  stride_ = 12 + 6 * branches_.size();
  begin_step(0);
}

template <class Real>
void ViscoelasticTerm<Real>::begin_step(Real h) {
  per_step_ = h > 0 ? 1 / h : 0;
  weight_ = 0;
  for (Branch& branch : branches_) {
    branch.step = branch_during(branch.gamma, branch.tau, h);
    weight_ += branch.step.gain;
  }
}

template <class Real>
void ViscoelasticTerm<Real>::reset_history(const Group& group, const Real* x) {
  state_.assign(stride_ * group.volume.size(), 0);
  for (std::size_t s = 0; s < group.volume.size(); ++s)
    std::copy_n(full_kinematics(group, x, s, rest_shape(group, s)).G, 6, &state_[stride_ * s]);
}

template <class Real>
void ViscoelasticTerm<Real>::reshape(const std::vector<SubelementMap<Real>>& subelement_maps) {
  for (std::size_t s = 0; s < subelement_maps.size(); ++s) {
    Real* state = &state_[stride_ * s];
    subelement_maps[s].lengths(state);
    for (std::size_t k = 6; k < stride_; k += 6) subelement_maps[s].tensions(state + k);
  }
}

template <class Real>
void ViscoelasticTerm<Real>::add_present(const Group& group, std::size_t s, const Real* x, Real sign,
                                         Real* state) const {
  const auto rest = rest_shape(group, s);
  const auto kinematics = full_kinematics(group, x, s, rest);
  for (int i = 0; i < 6; ++i) state[i] += sign * kinematics.G[i];
  if (branches_.empty()) return;
  Real T[6];
  total_tensions(group, s, kinematics, rest, T);
  for (int i = 0; i < 6; ++i) state[6 + i] += sign * T[i];
}

template <class Real>
void ViscoelasticTerm<Real>::commit(const Group& group, const Real* x) {
  if (branches_.empty() && has_avx2()) return store_gram(group, x, stride_, state_.data());
  for (std::size_t s = 0; s < group.volume.size(); ++s) {
    const auto rest = rest_shape(group, s);
    const auto kinematics = full_kinematics(group, x, s, rest);
    Real* state = &state_[stride_ * s];
    std::copy_n(kinematics.G, 6, state);
    if (branches_.empty()) continue;
    Real T[6];
    total_tensions(group, s, kinematics, rest, T);
    for (std::size_t b = 0; b < branches_.size(); ++b) {
      Real* Q = state + 12 + 6 * b;
      for (int i = 0; i < 6; ++i)
        Q[i] = branches_[b].step.decay * Q[i] + branches_[b].step.gain * (T[i] - state[6 + i]);
    }
    std::copy_n(T, 6, state + 6);
  }
}

template <class Real>
void ViscoelasticTerm<Real>::strain_change(std::size_t s, const ElementKinematics<Real>& kinematics, Real dG[6]) const {
  for (std::size_t i = 0; i < 6; ++i) dG[i] = kinematics.G[i] - state_[stride_ * s + i];
}

/// Tensions that are constant during a step: Σ_branches (decay Q − gain T_iso) of the committed state.
template <class Real>
Tensions<Real> ViscoelasticTerm<Real>::fixed_tensions(std::size_t s) const {
  Tensions<Real> t{};
  const Real* state = &state_[stride_ * s];
  for (std::size_t b = 0; b < branches_.size(); ++b)
    for (std::size_t i = 0; i < 6; ++i)
      t.T[i] += branches_[b].step.decay * state[12 + 6 * b + i] - branches_[b].step.gain * state[6 + i];
  return t;
}

template <class Real>
void ViscoelasticTerm<Real>::add_viscous(const Real dG[6], const RestShape<Real>& rest, Real T[6]) const {
  add_viscous_tensions(dG, rest, eta_, zeta_, per_step_, T);
}

template <class Real>
bool ViscoelasticTerm<Real>::forces(const Group& group, const Real* x, std::size_t begin, std::size_t end, Real* corner,
                                    bool add) const {
  if (!branches_.empty() || !has_avx2()) return GroupTerm<Real>::forces(group, x, begin, end, corner, add);
  viscous_forces<Real>({eta_, zeta_, per_step_, stride_}, group, x, state_.data(), begin, end, corner, add);
  return true;
}

template <class Real>
Tensions<Real> ViscoelasticTerm<Real>::tensions(const Group& group, std::size_t s,
                                                const ElementKinematics<Real>& kinematics,
                                                const RestShape<Real>& rest) const {
  Tensions<Real> t = fixed_tensions(s);
  if (!branches_.empty()) {
    const auto law = law_->tensions(group, s, kinematics, rest);
    for (int i = 0; i < 6; ++i) t.T[i] += weight_ * law.T[i];
    t.wJ = weight_ * law.wJ;
  }
  Real dG[6];
  strain_change(s, kinematics, dG);
  add_viscous(dG, rest, t.T);
  return t;
}

template <class Real>
Tensions<Real> ViscoelasticTerm<Real>::tension_differential(const Group& group, std::size_t s,
                                                            const ElementKinematics<Real>& kinematics,
                                                            const RestShape<Real>& rest,
                                                            const KinematicsDifferential<Real>& change) const {
  Tensions<Real> dt{};
  if (!branches_.empty()) {
    dt = law_->tension_differential(group, s, kinematics, rest, change);
    for (Real& value : dt.T) value *= weight_;
    dt.wJ *= weight_;
  }
  add_viscous(change.G, rest, dt.T);
  return dt;
}

template <class Real>
Real ViscoelasticTerm<Real>::slot_frequency_bound(const Group& group, std::size_t s,
                                                  const ElementKinematics<Real>& kinematics,
                                                  const RestShape<Real>& rest) const {
  if (branches_.empty()) return 0;
  return total_gamma_ * law_->slot_frequency_bound(group, s, kinematics, rest) + slot_state_bound(group, s);
}

template <class Real>
Real ViscoelasticTerm<Real>::slot_state_bound(const Group& group, std::size_t s) const {
  StressSum<Real> fixed;
  fixed.add(fixed_tensions(s), rest_shape(group, s));
  return 4 / group.density * std::sqrt(double_contraction3(fixed.S, fixed.S)) * group.gamma[s];
}

template <class Real>
Real ViscoelasticTerm<Real>::frequency_bound(const Group& group, const Real* x, std::size_t begin,
                                             std::size_t end) const {
  if (branches_.empty()) return 0;
  Real largest = 0;
  for (std::size_t s = begin * Group::lanes; s < end * Group::lanes && !in_fans_; ++s) {
    const Real bound = slot_state_bound(group, s);
    largest = bound > largest || std::isnan(bound) ? bound : largest;
  }
  return total_gamma_ * law_->frequency_bound(group, x, begin, end) + largest;
}

template <class Real>
Real ViscoelasticTerm<Real>::damping_bound(const Group& group, const Real* x, std::size_t begin,
                                           std::size_t end) const {
  if (eta_ == 0 && zeta_ == 0) return 0;
  const Viscous<Real> of{eta_, zeta_, per_step_, stride_};
  return has_avx2() ? wide_viscous_bound(of, group, x, begin, end) : viscous_bound(of, group, x, begin, end);
}

template <class Real>
double ViscoelasticTerm<Real>::energy(const Group& group, std::size_t s, const ElementKinematics<Real>& kinematics,
                                      const RestShape<Real>& rest) const {
  Real dG[6], dC[6], factor[3][3];
  strain_change(s, kinematics, dG);
  cholesky3(rest.A, factor);
  into_rest_frame(factor, dG, dC);
  const Real trace = dC[0] + dC[1] + dC[2];
  const Real viscous = rest.volume * per_step_ * (eta_ / 4 * double_contraction3(dC, dC) + zeta_ / 8 * trace * trace);
  const Real fixed = double_contraction3(fixed_tensions(s).T, kinematics.G) / 2;
  const double law = branches_.empty() ? 0 : law_->energy(group, s, kinematics, rest);
  return static_cast<double>(viscous + fixed) + static_cast<double>(weight_) * law;
}

template <class Real>
void ViscoelasticTerm<Real>::deviatoric_stress(const Group&, std::size_t, const Real[3], Real, Real tau[3]) const {
  std::fill_n(tau, 3, Real(0));
}

/// Tensions of the isochoric law with its wJ expressed as tensions, wJ (cross_a·cross_b) / (36 V J). J is taken as at
/// least 0.05, so that crushed elements keep finite values.
template <class Real>
void ViscoelasticTerm<Real>::total_tensions(const Group& group, std::size_t s,
                                            const ElementKinematics<Real>& kinematics, const RestShape<Real>& rest,
                                            Real T[6]) const {
  const auto t = law_->tensions(group, s, kinematics, rest);
  const Real scale = t.wJ / (36 * rest.volume * std::max(kinematics.at.J, Real(0.05)));
  constexpr int row[6] = {0, 1, 2, 0, 0, 1}, col[6] = {0, 1, 2, 1, 2, 2};
  for (int k = 0; k < 6; ++k) {
    const Real *p = kinematics.cross[row[k]], *q = kinematics.cross[col[k]];
    T[k] = t.T[k] + scale * (p[0] * q[0] + p[1] * q[1] + p[2] * q[2]);
  }
}

template FanBranch<float> branch_during(float, float, float);
template FanBranch<double> branch_during(double, double, double);
template class ViscoelasticTerm<float>;
template class ViscoelasticTerm<double>;

}  // namespace heml
