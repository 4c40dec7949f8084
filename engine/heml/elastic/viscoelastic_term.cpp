#include <algorithm>
#include <cassert>
#include <cmath>
#include <heml/elastic/viscoelastic_loops.hpp>
#include <heml/elastic/viscoelastic_term.hpp>

namespace heml {
template <class Real>
RelaxationBranch<Real> branch_during(Real gamma, Real tau, Real h) {
  return {natural_exp(-h / tau), gamma * natural_exp(-h / (2 * tau))};
}

template <class Real>
ViscoelasticTerm<Real>::ViscoelasticTerm(std::unique_ptr<GroupTerm<Real>> law, const Material& material)
    : law_(std::move(law)),
      eta_(static_cast<Real>(material.viscosity)),
      zeta_(static_cast<Real>(material.bulk_viscosity)) {
  for (const PronyTerm& term : material.relaxation) {
    branches_.push_back({static_cast<Real>(term.gamma), static_cast<Real>(term.tau)});
    total_gamma_ += branches_.back().gamma;
  }
  stride_ = 12 + 6 * branches_.size();
  begin_step(0);
}

template <class Real>
void ViscoelasticTerm<Real>::begin_step(Real h) {
  per_step_ = h > 0 ? 1 / h : 0;
  weight_ = 0;
  steps_.clear();
  for (const Branch& branch : branches_) {
    steps_.push_back(branch_during(branch.gamma, branch.tau, h));
    weight_ += steps_.back().gain;
  }
}

template <class Real>
MemoryOf<Real> ViscoelasticTerm<Real>::memory() const {
  return {eta_, zeta_, per_step_, weight_, stride_, steps_, nullptr};
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
  MemoryOf<Real> of = memory();
  if (has_avx2() && branches_.empty()) return wide_store_memory(of, group, x, 0, group.packets(), state_.data());
  if (has_avx2())
    return each_run_with_law(*law_, group, x, 0, group.packets(),
                             [&](std::size_t begin, std::size_t end, const Real* law) {
                               of.law = law;
                               wide_store_memory(of, group, x, begin, end, state_.data());
                             });
  for (std::size_t s = 0; s < group.volume.size(); ++s) {
    const auto rest = rest_shape(group, s);
    const auto kinematics = full_kinematics(group, x, s, rest);
    Real T[6];
    std::copy_n(kinematics.G, 6, state_of(s));
    if (branches_.empty()) continue;
    total_tensions(group, s, kinematics, rest, T);
    store_tensions<Real>(steps_, T, state_of(s));
  }
}

template <class Real>
void ViscoelasticTerm<Real>::put_in_points(PointTerms<Real>& terms) {
  if (next_.size() != state_.size()) next_ = state_;
  terms.eta = eta_, terms.zeta = zeta_, terms.per_step = per_step_;
  terms.branches = steps_.data(), terms.branch_count = steps_.size(), terms.weight = weight_;
  terms.state = stride_, terms.before = state_.data(), terms.next = next_.data();
}

template <class Real>
void ViscoelasticTerm<Real>::advance(const Group& group) {
  assert(next_.size() == state_.size());
  std::swap(state_, next_);
  for (std::size_t s = group.size(); s < group.volume.size(); ++s)  // padding repeats the last slot
    std::copy_n(state_of(group.size() - 1), stride_, state_of(s));
}

template <class Real>
void ViscoelasticTerm<Real>::strain_change(std::size_t s, const ElementKinematics<Real>& kinematics, Real dG[6]) const {
  for (std::size_t i = 0; i < 6; ++i) dG[i] = kinematics.G[i] - state_[stride_ * s + i];
}

/// Tensions that are constant during a step: Σ_branches (decay Q − gain T_iso) of the committed state.
template <class Real>
Tensions<Real> ViscoelasticTerm<Real>::fixed_tensions(std::size_t s) const {
  Tensions<Real> t{};
  add_fixed_tensions<Real>(steps_, &state_[stride_ * s], t.T);
  return t;
}

template <class Real>
void ViscoelasticTerm<Real>::add_viscous(const Real dG[6], const RestShape<Real>& rest, Real T[6]) const {
  add_viscous_tensions(dG, rest, eta_, zeta_, per_step_, T);
}

template <class Real>
bool ViscoelasticTerm<Real>::forces(const Group& group, const Real* x, std::size_t begin, std::size_t end, Real* corner,
                                    bool add) const {
  if (!has_avx2()) return GroupTerm<Real>::forces(group, x, begin, end, corner, add);
  MemoryOf<Real> of = memory();
  if (branches_.empty()) {
    wide_memory_forces(of, group, x, state_.data(), begin, end, corner, add);
    return true;
  }
  each_run_with_law(*law_, group, x, begin, end, [&](std::size_t first, std::size_t last, const Real* law) {
    of.law = law;
    wide_memory_forces(of, group, x, state_.data(), first, last, corner, add);
  });
  return true;
}

template <class Real>
void ViscoelasticTerm<Real>::stiffness(const Group& group, const Real* x, std::size_t begin, std::size_t end,
                                       Real scale, Real* K, bool add) const {
  if (!has_avx2()) return GroupTerm<Real>::stiffness(group, x, begin, end, scale, K, add);
  if (!branches_.empty()) law_->stiffness(group, x, begin, end, scale * weight_, K, add);
  wide_memory_stiffness(memory(), group, x, state_.data(), begin, end, scale, K, add || !branches_.empty());
}

template <class Real>
void ViscoelasticTerm<Real>::energies(const Group& group, const Real* x, std::size_t begin, std::size_t end,
                                      double scale, double* of_packet, bool add) const {
  if (!has_avx2()) return GroupTerm<Real>::energies(group, x, begin, end, scale, of_packet, add);
  if (!branches_.empty()) law_->energies(group, x, begin, end, scale * static_cast<double>(weight_), of_packet, add);
  wide_memory_energies(memory(), group, x, state_.data(), begin, end, scale, of_packet, add || !branches_.empty());
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
                                                  const RestShape<Real>& rest,
                                                  const CornerWeights<Real>& weights) const {
  if (branches_.empty()) return 0;
  return total_gamma_ * law_->slot_frequency_bound(group, s, kinematics, rest, weights) +
         slot_state_bound(group, s, weights);
}

template <class Real>
Real ViscoelasticTerm<Real>::slot_state_bound(const Group& group, std::size_t s,
                                              const CornerWeights<Real>& weights) const {
  const auto rest = rest_shape(group, s);
  StressSum<Real> fixed;
  fixed.add(fixed_tensions(s), rest);
  return 4 / group.density * std::sqrt(double_contraction3(fixed.S, fixed.S)) * max_gradient(rest.A, weights);
}

template <class Real>
void ViscoelasticTerm<Real>::frequency_bounds(const Group& group, const Real* weights, const Real* x, std::size_t begin,
                                              std::size_t end, Real* bounds, bool add) const {
  constexpr std::size_t lanes = Group::lanes;
  if (!add) std::fill_n(bounds, (end - begin) * lanes, Real(0));
  if (branches_.empty()) return;
  Real of_law[lanes];
  for (std::size_t p = begin; p < end; ++p, bounds += lanes) {
    law_->frequency_bounds(group, weights, x, p, p + 1, of_law, false);
    for (std::size_t l = 0; l < lanes; ++l) bounds[l] += total_gamma_ * of_law[l];
    for (std::size_t l = 0; l < lanes && !in_fans_; ++l) {
      const std::size_t s = p * lanes + l;
      bounds[l] += slot_state_bound(group, s, weights_of_slot(group, weights, s));
    }
  }
}

template <class Real>
void ViscoelasticTerm<Real>::damping_bounds(const Group& group, const Real* weights, const Real* x, std::size_t begin,
                                            std::size_t end, Real* bounds, bool add) const {
  if (eta_ == 0 && zeta_ == 0) return GroupTerm<Real>::damping_bounds(group, weights, x, begin, end, bounds, add);
  const MemoryOf<Real> of = memory();
  if (has_avx2()) return wide_viscous_bounds(of, group, weights, x, begin, end, bounds, add);
  viscous_bounds(of, group, weights, x, begin, end, bounds, add);
}

template <class Real>
double ViscoelasticTerm<Real>::energy(const Group& group, std::size_t s, const ElementKinematics<Real>& kinematics,
                                      const RestShape<Real>& rest) const {
  Real dG[6];
  strain_change(s, kinematics, dG);
  const Real own = memory_energy(dG, fixed_tensions(s).T, kinematics.G, rest, eta_, zeta_, per_step_);
  const double law = branches_.empty() ? 0 : law_->energy(group, s, kinematics, rest);
  return static_cast<double>(own) + static_cast<double>(weight_) * law;
}

/// put_total_tensions() of the isochoric law.
template <class Real>
void ViscoelasticTerm<Real>::total_tensions(const Group& group, std::size_t s,
                                            const ElementKinematics<Real>& kinematics, const RestShape<Real>& rest,
                                            Real T[6]) const {
  put_total_tensions(law_->tensions(group, s, kinematics, rest), kinematics.cross, kinematics.at.J, rest.volume, T);
}

template RelaxationBranch<float> branch_during(float, float, float);
template RelaxationBranch<double> branch_during(double, double, double);
template class ViscoelasticTerm<float>;
template class ViscoelasticTerm<double>;

}  // namespace heml
