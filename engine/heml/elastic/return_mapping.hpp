#pragma once
// Return mapping of von Mises plasticity in principal logarithmic strains (Simo 1992), as the minimum of the
// incremental potential (Ortiz & Stainier 1999)
//     Φ(d) = W(ε − d) + k σ |d| + ½ H k² |d|²,   Σ d_i = 0,   k = √(2/3),
// ε: the strains if none flows in this step, d: those that flow, σ: the von Mises stress at which flow begins, H: the
// hardening. At the minimum the deviatoric stress is τ(ε − d) = k (σ + H k |d|) d/|d|: flow is along the stress, whose
// von Mises measure is the flow stress, and dissipates. As a function of ε the minimum is a potential of the stress in
// an implicit step; flow_tangent() is the part of plasticity in its second derivative.
#include <heml/elastic/group_term.hpp>

namespace heml {

template <class Real>
struct FlowStress {
  Real at_start;   ///< σ, Pa
  Real hardening;  ///< H, Pa
};

template <class Real>
struct PlasticReturn {
  Real flow[3] = {0, 0, 0};       ///< d, along the principal axes of C
  Real length = 0;                ///< |d|; 0: none flows
  bool is_minimum = false;        ///< else flow is along ε: the law softens, and Φ is not convex
  DeviatoricStress<Real> stress;  ///< τ(ε − d)

  Real equivalent_strain() const;
  /// Σ τ_i d_i, J/m³.
  double work() const;
};

/// Of slot s at eigenvalues c of C.
template <class Real>
PlasticReturn<Real> return_mapping(const GroupTerm<Real>& law, const ElementGroup<Real>& group, std::size_t s,
                                   const Real c[3], Real J, const FlowStress<Real>& yield);

/// ∂τ_i/∂ε_j less its value at constant d, Pa: symmetric, negative.
template <class Real>
void flow_tangent(const PlasticReturn<Real>& at, const FlowStress<Real>& yield, Real change[3][3]);

}  // namespace heml
