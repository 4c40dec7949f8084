#pragma once
// The force kernels of this build by instruction set, each compiled in a file of its own (engine/CMakeLists.txt).
#include <heml/elastic/fan_block.hpp>
#include <heml/elastic/instruction_set.hpp>

namespace heml {

/// Lanes per pack.
template <class Real>
constexpr std::size_t lanes_of(InstructionSet isa) {
  const std::size_t bytes = isa == InstructionSet::avx512 ? 64 : isa == InstructionSet::avx2 ? 32 : 16;
  return bytes / sizeof(Real);
}

/// The kernel of the law with that index in LawList. isa: one of instruction_sets().
template <class Real>
FanKernel<Real> fan_kernel(InstructionSet isa, std::size_t law, bool continued);

// Each is defined in its own file.
template <class Real>
FanKernel<Real> portable_fan_kernel(std::size_t law, bool continued);
template <class Real>
FanKernel<Real> avx2_fan_kernel(std::size_t law, bool continued);
template <class Real>
FanKernel<Real> avx512_fan_kernel(std::size_t law, bool continued);

}  // namespace heml
