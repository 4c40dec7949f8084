#pragma once
// The kernels with terms of this build by instruction set (elastic/fan_terms.hpp), each compiled in a file of its own.
#include <heml/elastic/fan_terms.hpp>
#include <heml/elastic/instruction_set.hpp>

namespace heml {

template <class Real>
struct FanTermKernels {
  FanTermKernel<Real> (*of_law)(std::size_t law, bool continued);  ///< by index in LawList
  FanTermKernel<Real> (*of_energy)(bool with_fibre);               ///< InvariantEnergy<Real, false, with_fibre>
  FanVolumeKernel<Real> volumes;
};

/// isa: one of instruction_sets().
template <class Real>
FanTermKernels<Real> fan_term_kernels(InstructionSet isa);

// Each is defined in its own file.
template <class Real>
FanTermKernels<Real> portable_term_kernels();
template <class Real>
FanTermKernels<Real> avx2_term_kernels();
template <class Real>
FanTermKernels<Real> avx512_term_kernels();

}  // namespace heml
