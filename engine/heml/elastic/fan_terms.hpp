#pragma once
// Terms beside the law in the fan kernels: viscosity, relaxation, volume terms of their own, averaged nodal pressure,
// active stress (elastic/viscoelastic_term.hpp, elastic/nodal_pressure.hpp, elastic/active_term.hpp have the formulas).
// A kernel with terms runs one group of fans through stages, of which the second alone depends on the law:
//
//   nodes ──► spokes ──► tensions of the law ──► + terms ──► forces at each ring node ──► nodes
//                                                 │  ▲
//              next state, kept by commit() ◄─────┘  └───── state of the step's beginning
//
//   state: [group][tetrahedron][G0 (6)  if viscous, then T0 (6) Q of branch 0 (6) Q of branch 1 …  if relaxing][lane]
//
// The six numbers are of the edges a, b0, b1 of elastic/fan_block.hpp, as aa 00 11 a0 a1 01; tensions have the reversed
// sign of the kernels.
//
// Rest shapes that plastic flow changes, and what is beyond yield, lie beside the state (elastic/fan_flow.hpp).
//
// Parameters that differ between elements are read before the tensions of each tetrahedron, from behind the constants
// of its rest shape (elastic/fan_block.hpp). Only kernels with terms do that.
//
// Plain data only: files compiled for other instruction sets include this header.
#include <heml/elastic/fan_block.hpp>
#include <heml/elastic/term_values.hpp>

namespace heml {

/// Numbers a tetrahedron of elastic/fan_flow.hpp.
constexpr std::size_t fan_flow_numbers = 7;

/// The volume modulus κ, if it differs between elements, is not one of the law's where a volume term takes it.
template <class Real>
struct FanTerms {
  bool flows = false;         ///< rest shapes are those of elastic/fan_flow.hpp
  bool is_principal = false;  ///< the constants of the rest shape are those of a law of principal stretches
  std::size_t constants = 0;  ///< a tetrahedron, with the parameters that differ
  const std::size_t* parameters = nullptr;  ///< which of the law's each of those is; not_of_the_law: none
  std::size_t parameter_count = 0;
  static constexpr std::size_t not_of_the_law = static_cast<std::size_t>(-1);
  Real eta = 0, zeta = 0;         ///< Pa s
  Real per_step = 0;              ///< 1/h, or 0
  std::size_t viscous_state = 0;  ///< numbers of state a tetrahedron: 6 or 0
  const RelaxationBranch<Real>* branches = nullptr;
  std::size_t branch_count = 0;
  Real weight = 0;        ///< Σ gain
  std::size_t state = 0;  ///< numbers of state a tetrahedron
  bool has_volume = false;  ///< a volume term that the law does not have
  VolumeTerm volume = VolumeTerm::quadratic;
  bool is_continued = false;
  Real kappa = 0;                  ///< Pa
  std::size_t kappa_constant = 0;  ///< which constant is κ instead; 0: none
  const Real* pressure = nullptr;  ///< Pa, of every node; null without averaged nodal pressure
  Real active = 0;                 ///< Pa, of muscle (elastic/active_term.hpp)
  std::size_t fibre_constant = 0;  ///< which constant its fibre begins at; 0: none
};

/// What the elements of a block remember, as their kernel reads and writes it; null: nothing.
template <class Real>
struct FanMemory {
  const Real* state = nullptr;  ///< at the beginning of the step
  Real* next = nullptr;         ///< after it, overwritten
  const Real* shape = nullptr;  ///< FanFlow::shape(), of elements that flow
  Real* beyond = nullptr;       ///< FanFlow::beyond_of(), overwritten
};

/// As FanKernel, for the law and these terms. The law has no volume term where `terms` has one or a pressure.
template <class Real>
using FanTermKernel = bool (*)(const void* law, const FanBlock<Real>& block, const FanTerms<Real>& terms,
                               FanMemory<Real> memory, const Real* x, Real* f);

/// Writes the sums of V J (m³) of the tetrahedra at each node: those of own nodes to sum (#V), those of shared nodes to
/// block.shared_force, one a node.
template <class Real>
using FanVolumeKernel = void (*)(const FanBlock<Real>& block, std::size_t constants, const Real* x, Real* sum);

}  // namespace heml
