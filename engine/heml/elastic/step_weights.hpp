#pragma once
// Numbers z_a > 0 of the nodes that make the bound of the stable step sharp (node_bounds.hpp). With K_e ≤ b_e M_e Z of
// every element e, Z = diag(z_a),
//
//     K ≤ Σ b_e M_e Z,  so  λ_max(M⁻¹K) ≤ max_a B_a,  B_a = z_a Σ_e b_e m_ea / Σ_e m_ea  over the elements e at a,
//
// for any z. Where the mean round a node is large, a small z_a moves what its elements need to their other nodes: z_a
// is divided by B_a a few times, which brings the B_a of neighbours together. The numbers are of a body at rest, of its
// moduli for small strains; bounds with them hold in any state.
#include <heml/base/thread_team.hpp>
#include <heml/elastic/body_layout.hpp>
#include <vector>

namespace heml {

template <class Real>
struct StepWeights {
  std::vector<Real> node;  ///< #V, w_a = 1/z_a
  std::vector<Real>
      factor;  ///< #T of quadratic elements: b_e over the largest bound of their points as linear elements
  std::vector<Real> mass_factor;  ///< #V, of lumped masses (mass_scaling.hpp), which bounds are divided by; empty: 1
  std::size_t bytes() const { return bytes_of(node, factor, mass_factor); }
};

/// The elements of one material.
template <class Real>
struct StiffElements {
  const ElementGroup<Real>* group;
  double shear, lame;  ///< Pa, μ and λ for small strains; 0: springs
};

/// The same for any number of threads.
template <class Real>
StepWeights<Real> find_step_weights(const std::vector<StiffElements<Real>>& parts, const BodyLayout<Real>& layout,
                                    ThreadTeam& team);

}  // namespace heml
