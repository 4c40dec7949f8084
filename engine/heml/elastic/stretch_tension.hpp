#pragma once
// Tensions, stiffness and step bound of laws by expression of principal stretches (materials/stretch_energy.hpp); the
// counterparts for other laws are in tension.hpp, edge_stiffness.hpp and step_bound.hpp.
#include <heml/elastic/edge_stiffness.hpp>
#include <heml/elastic/step_bound.hpp>
#include <heml/materials/stretch_energy.hpp>

namespace heml {

/// T = V L S Lᵀ + 2V w4 m mᵀ with S in the rest frame of the Cholesky factor L.
template <class Real>
[[gnu::always_inline]] inline void stretch_tensions(const Real factor[3][3], const Real S[6], Real w4,
                                                    const RestShape<Real>& rest, Real T[6]) {
  Real mm[6];
  congruence3(factor, S, T);
  outer3(rest.fibre, mm);
  for (int i = 0; i < 6; ++i) T[i] = rest.volume * (T[i] + Real(2) * w4 * mm[i]);
}

template <class Real, StretchLaw L>
[[gnu::always_inline]] inline Tensions<Real> tensions(const L& law, const ElementKinematics<Real>& kinematics,
                                                      const RestShape<Real>& rest) {
  Real factor[3][3], C[6], S[6];
  cholesky3(rest.A, factor);
  into_rest_frame(factor, kinematics.G, C);
  const StretchState<Real> state = stretch_state(law, C, kinematics.at.J, kinematics.at.I4);
  state.stress(S);
  Tensions<Real> t;
  stretch_tensions(factor, S, state.first.w4, rest, t.T);
  t.wJ = state.first.wJ;
  return t;
}

template <class Real, StretchLaw L>
[[gnu::always_inline]] inline Real law_energy(const L& law, const ElementKinematics<Real>& kinematics,
                                              const RestShape<Real>& rest) {
  Real factor[3][3], C[6];
  cholesky3(rest.A, factor);
  into_rest_frame(factor, kinematics.G, C);
  return law.energy(sorted_eigen3(C).value, kinematics.at.J, kinematics.at.I4);
}

/// The tangent at one element: what all tension differentials share.
template <class Real>
class ElementStretchTangent {
 public:
  template <class L>
  [[gnu::always_inline]] ElementStretchTangent(const L& law, const ElementKinematics<Real>& kinematics,
                                               const RestShape<Real>& rest)
      : rest_(rest) {
    Real C[6];
    cholesky3(rest.A, factor_);
    into_rest_frame(factor_, kinematics.G, C);
    tangent_ = stretch_tangent(law, C, kinematics.at.J, kinematics.at.I4);
  }

  [[gnu::always_inline]] Tensions<Real> operator()(const KinematicsDifferential<Real>& d) const {
    Real dC[6];
    into_rest_frame(factor_, d.G, dC);
    const auto change = tangent_(dC, d.J, bilinear3(rest_.fibre, d.G, rest_.fibre));
    Tensions<Real> t;
    stretch_tensions(factor_, change.S, change.w4, rest_, t.T);
    t.wJ = change.wJ;
    return t;
  }

  const StretchTangent<Real>& tangent() const { return tangent_; }

 private:
  const RestShape<Real>& rest_;
  Real factor_[3][3];
  StretchTangent<Real> tangent_;
};

template <class Real, StretchLaw L>
[[gnu::always_inline]] inline Tensions<Real> tension_differential(const L& law,
                                                                  const ElementKinematics<Real>& kinematics,
                                                                  const RestShape<Real>& rest,
                                                                  const KinematicsDifferential<Real>& d) {
  return ElementStretchTangent<Real>(law, kinematics, rest)(d);
}

template <class Real, StretchLaw L>
[[gnu::always_inline]] inline void add_edge_stiffness(const L& law, const ElementKinematics<Real>& kinematics,
                                                      const RestShape<Real>& rest, Real K[edge_entries]) {
  const Tensions<Real> t = tensions(law, kinematics, rest);
  const ElementStretchTangent<Real> tangent(law, kinematics, rest);
  add_columns(
      [&](const Real(&de)[3][3], Real* f) {
        corner_force_differential(t, tangent(kinematics_differential(kinematics, de, rest.volume)), kinematics, de, f);
      },
      K);
}

/// Upper bound of λ_max(M_t⁻¹K_t), 1/s². In the frames of the singular values σ_i of F, with X = dF there, d²W is block
/// diagonal but for the fibre: X_ii, in which dC_ii = 2 σ_i X_ii and dJ = J Σ X_ii/σ_i, and the pairs X_ij, X_ji, in
/// which |dC_ij|² ≤ (c_i + c_j)(X_ij² + X_ji²), d²J = −2 J X_ij X_ji/(σ_i σ_j), and S adds at most 2 max h_i. |X|² ≤ γ
/// |u|². The part wJJ (dJ)² may instead count as nJ |u|² (step_bound.hpp), which is sharper for flat elements.
template <class Real, StretchLaw L>
Real element_frequency_bound(const L& law, const ElementKinematics<Real>& kinematics, const RestShape<Real>& rest,
                             const CornerWeights<Real>& weights, Real density) {
  const ElementStretchTangent<Real> element(law, kinematics, rest);
  const auto& tangent = element.tangent();
  const auto& state = tangent.state;
  const auto& second = tangent.second;
  const Real* theta = tangent.theta;
  const auto sums = corner_sums(kinematics, rest, weights);
  const Real gamma = max_gradient(rest.A, weights);
  const auto positive = [](Real value) { return std::max(value, Real(0)); };
  const Real *c = state.e.value, *h = state.first.h, J = kinematics.at.J, wJ = state.first.wJ;
  Real s[3], volume[3];  // dJ = Σ volume_i X_ii
  for (int i = 0; i < 3; ++i) s[i] = std::sqrt(c[i]), volume[i] = J / s[i];
  const auto block = [&](Real wJJ) {
    Real H[6];
    constexpr int row[6] = {0, 1, 2, 0, 0, 1}, col[6] = {0, 1, 2, 1, 2, 2};
    for (int k = 0; k < 6; ++k) {
      const int i = row[k], j = col[k];
      H[k] = 4 * s[i] * s[j] * second.h[i][j] + 2 * s[i] * second.hJ[i] * volume[j] +
             2 * s[j] * second.hJ[j] * volume[i] + wJJ * volume[i] * volume[j];
      H[k] += i == j ? 2 * h[i] : wJ * J / (s[i] * s[j]);
    }
    const auto e = symmetric_eigen3(H);
    return std::max({e.value[0], e.value[1], e.value[2]});
  };
  const auto both = [&](Real wJJ) {
    Real most = block(wJJ);
    constexpr int row[3] = {0, 0, 1}, col[3] = {1, 2, 2};
    for (int k = 0; k < 3; ++k) {
      const int i = row[k], j = col[k];
      most = std::max(
          most, 2 * positive(theta[k]) * (c[i] + c[j]) + 2 * std::max(h[i], h[j]) + std::abs(wJ) * J / (s[i] * s[j]));
    }
    return positive(most);
  };
  Real bound = std::min(both(second.wJJ) * gamma, both(0) * gamma + positive(second.wJJ) * sums.nJ);
  if constexpr (L::uses_I4) {
    Real coupling = 0;  // |Σ h_i4 dC_ii|² ≤ coupling |X|²
    for (int i = 0; i < 3; ++i) coupling += 4 * c[i] * second.h4[i] * second.h4[i];
    const Real n44 = 4 * kinematics.at.I4 * sums.m;
    bound += 2 * positive(state.first.w4) * sums.m + positive(second.w44) * n44;
    bound += 2 * std::sqrt(coupling * gamma * n44) + 2 * std::abs(second.wJ4) * std::sqrt(sums.nJ * n44);
  }
  if (std::isnan(second.wJJ + wJ + h[0] + h[1] + h[2])) return std::numeric_limits<Real>::quiet_NaN();
  return 4 / density * bound;
}

}  // namespace heml
