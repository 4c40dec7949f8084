#pragma once
// Laws by expression of principal stretches, W(c1, c2, c3, J, I4) with the eigenvalues c1 ≥ c2 ≥ c3 of C and their
// eigenvectors n_i. With h_i = ∂W/∂c_i:
//   S  = 2 Σ_i h_i n_i n_iᵀ + 2 w4 a0 a0ᵀ
//   dH = Σ_i dh_i n_i n_iᵀ + Σ_{i≠j} θ_ij (n_i·dC n_j) n_i n_jᵀ,   θ_ij = (h_i − h_j)/(c_i − c_j)
// Where c_i and c_j are equal up to round-off, θ_ij is its limit ½ (h_ii + h_jj) − h_ij, exact to second order in their
// difference; W is symmetric in stretches that coincide, or has no second derivative there.
#include <heml/materials/continuum.hpp>
#include <heml/materials/energy_law.hpp>

namespace heml {

/// First derivatives of W, Pa.
template <class Real>
struct StretchFirst {
  Real h[3], wJ, w4;
};

/// Second derivatives of W, Pa.
template <class Real>
struct StretchSecond {
  Real h[3][3], hJ[3], h4[3], wJJ, wJ4, w44;
};

/// A law by expression of stretches.
template <class Real, bool continued, bool with_fibre>
struct StretchEnergy : EnergyLawBase<Real> {
  static constexpr bool uses_I4 = with_fibre, is_of_stretches = true;

  template <class Pack>
  [[gnu::always_inline]] StretchEnergy<Pack, continued, with_fibre> broadcast() const {
    return this->template borrowed<StretchEnergy<Pack, continued, with_fibre>>();
  }

  Mask<Real> valid(const Invariants<Real>& at) const { return at.J > min_volume_ratio<Real>; }

  [[gnu::always_inline]] Real energy(const Real c[3], Real J, Real I4) const {
    Real r[max_energy_registers];
    run(this->W, c, J, I4, r);
    return r[this->W.results[0]];
  }
  [[gnu::always_inline]] StretchFirst<Real> first_derivatives(const Real c[3], Real J, Real I4) const {
    Real r[max_energy_registers];
    run(this->first, c, J, I4, r);
    const std::uint16_t* k = this->first.results;
    return {{r[k[0]], r[k[1]], r[k[2]]}, r[k[3]], r[k[4]]};
  }
  [[gnu::always_inline]] StretchSecond<Real> second_derivatives(const Real c[3], Real J, Real I4) const {
    Real r[max_energy_registers];
    run(this->second, c, J, I4, r);
    const auto at = [&](int k) { return r[this->second.results[k]]; };
    // 11 12 13 1J 14 22 23 2J 24 33 3J 34 JJ J4 44
    return {{{at(0), at(1), at(2)}, {at(1), at(5), at(6)}, {at(2), at(6), at(9)}},
            {at(3), at(7), at(10)},
            {at(4), at(8), at(11)},
            at(12),
            at(13),
            at(14)};
  }

 private:
  [[gnu::always_inline]] static void run(const EnergySteps<Lane<Real>>& program, const Real c[3], Real J, Real I4,
                                         Real* r) {
    r[static_cast<int>(EnergyInput::J)] = J, r[static_cast<int>(EnergyInput::I4)] = I4;
    for (int i = 0; i < 3; ++i) r[static_cast<int>(EnergyInput::c1) + i] = c[i];
    run_energy(program, r);
  }
};

template <class L>
concept StretchLaw = L::is_of_stretches;

/// Eigenvalues in descending order with their eigenvectors.
template <class Real>
[[gnu::always_inline]] inline SymmetricEigen3<Real> sorted_eigen3(const Real C[6]) {
  SymmetricEigen3<Real> e = symmetric_eigen3(C);
  constexpr int pairs[3][2] = {{0, 1}, {1, 2}, {0, 1}};
  for (const auto& [i, j] : pairs) {
    const auto swapped = e.value[i] < e.value[j];
    const auto exchange = [&](Real& a, Real& b) {
      const Real first = select(swapped, b, a);
      b = select(swapped, a, b);
      a = first;
    };
    exchange(e.value[i], e.value[j]);
    for (int k = 0; k < 3; ++k) exchange(e.vector[i][k], e.vector[j][k]);
  }
  return e;
}

/// The law at one state; S without the part of the fibre.
template <class Real>
struct StretchState {
  SymmetricEigen3<Real> e;
  StretchFirst<Real> first;

  [[gnu::always_inline]] void stress(Real S[6]) const {
    spectral_sum3(e, first.h, S);
    for (int k = 0; k < 6; ++k) S[k] *= Real(2);
  }
};

template <class Real, class L>
[[gnu::always_inline]] inline StretchState<Real> stretch_state(const L& law, const Real C[6], Real J, Real I4) {
  StretchState<Real> state;
  state.e = sorted_eigen3(C);
  state.first = law.first_derivatives(state.e.value, J, I4);
  return state;
}

/// θ of 12, 13, 23.
template <class Real>
[[gnu::always_inline]] inline void stretch_differences(const StretchState<Real>& at, const StretchSecond<Real>& second,
                                                       Real theta[3]) {
  constexpr int row[3] = {0, 0, 1}, col[3] = {1, 2, 2};
  constexpr auto close = static_cast<Lane<Real>>(std::numeric_limits<Lane<Real>>::digits == 24 ? 1e-2 : 1e-5);
  for (int k = 0; k < 3; ++k) {
    const int i = row[k], j = col[k];
    const Real apart = at.e.value[i] - at.e.value[j];
    const Real limit = (second.h[i][i] + second.h[j][j]) * Real(0.5) - second.h[i][j];
    theta[k] = select(apart > Real(close) * at.e.value[i], (at.first.h[i] - at.first.h[j]) / apart, limit);
  }
}

/// The tangent of the law at one state.
template <class Real>
struct StretchTangent {
  StretchState<Real> state;
  StretchSecond<Real> second;
  Real theta[3];

  /// Changes of S (without the fibre), wJ and w4 with dC, dJ and dI4.
  struct Change {
    Real S[6], wJ, w4;
  };
  [[gnu::always_inline]] Change operator()(const Real dC[6], Real dJ, Real dI4) const {
    constexpr int row[3] = {0, 0, 1}, col[3] = {1, 2, 2};
    const auto& n = state.e.vector;
    Real m[3], dH[6];
    for (int i = 0; i < 3; ++i) m[i] = bilinear3(n[i], dC, n[i]);
    Change change;
    change.wJ = second.wJJ * dJ + second.wJ4 * dI4;
    change.w4 = second.wJ4 * dJ + second.w44 * dI4;
    for (int i = 0; i < 3; ++i) {
      dH[i] = second.h[i][0] * m[0] + second.h[i][1] * m[1] + second.h[i][2] * m[2] + second.hJ[i] * dJ +
              second.h4[i] * dI4;
      change.wJ += second.hJ[i] * m[i];
      change.w4 += second.h4[i] * m[i];
    }
    for (int k = 0; k < 3; ++k) dH[3 + k] = theta[k] * bilinear3(n[row[k]], dC, n[col[k]]);
    const Real N[3][3] = {{n[0][0], n[1][0], n[2][0]}, {n[0][1], n[1][1], n[2][1]}, {n[0][2], n[1][2], n[2][2]}};
    congruence3(N, dH, change.S);
    for (Real& s : change.S) s *= Real(2);
    return change;
  }
};

template <class Real, class L>
[[gnu::always_inline]] inline StretchTangent<Real> stretch_tangent(const L& law, const Real C[6], Real J, Real I4) {
  StretchTangent<Real> tangent;
  tangent.state = stretch_state(law, C, J, I4);
  tangent.second = law.second_derivatives(tangent.state.e.value, J, I4);
  stretch_differences(tangent.state, tangent.second, tangent.theta);
  return tangent;
}

// As in continuum.hpp, for a material point.
template <class Real, StretchLaw L>
Real energy_density(const L& law, const Strain<Real>& at) {
  return law.energy(sorted_eigen3(at.C).value, at.J, at.invariants().I4);
}
template <class Real, StretchLaw L>
Stress<Real> stress_of(const L& law, const Strain<Real>& at) {
  const StretchState<Real> state = stretch_state(law, at.C, at.J, at.invariants().I4);
  Stress<Real> stress, fibre;
  state.stress(stress.S);
  to_symmetric6<Real>(2 * state.first.w4 * at.fibre * at.fibre.transpose(), fibre.S);
  for (int k = 0; k < 6; ++k) stress.S[k] += fibre.S[k];
  stress.wJ = state.first.wJ;
  return stress;
}
template <class Real, StretchLaw L>
Stress<Real> stress_differential(const L& law, const Strain<Real>& at, const Real dC[6], Real dJ) {
  const Real dI4 = bilinear3(at.fibre.data(), dC, at.fibre.data());
  const auto change = stretch_tangent(law, at.C, at.J, at.invariants().I4)(dC, dJ, dI4);
  Stress<Real> stress, fibre;
  to_symmetric6<Real>(2 * change.w4 * at.fibre * at.fibre.transpose(), fibre.S);
  for (int k = 0; k < 6; ++k) stress.S[k] = change.S[k] + fibre.S[k];
  stress.wJ = change.wJ;
  return stress;
}

/// Calls use(law) with the material's law as a struct of Real; the law is an EnergyLaw.
template <class Real, class Use>
void with_energy(const Material& material, const Use& use) {
  const EnergyExpression& expression = find_energy_law(material.law)->expression;
  if (!expression.uses_stretches()) return with_invariant_energy<Real>(material, use);
  const auto programs = energy_programs<Real>(material);
  const auto call = [&](auto law) {
    law.set(programs);
    use(law);
  };
  expression.uses_fibre() ? call(StretchEnergy<Real, false, true>{}) : call(StretchEnergy<Real, false, false>{});
}

}  // namespace heml
