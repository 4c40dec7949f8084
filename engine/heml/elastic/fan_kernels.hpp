#pragma once
// The force kernels this build has, by instruction set; each is a file compiled for it (engine/CMakeLists.txt).
#include <heml/elastic/fan_block.hpp>
#include <span>
#include <string_view>

namespace heml {

/// What a processor may be asked for. The results of each differ from those of the others by round-off.
enum class InstructionSet {
  best,      ///< the last of these that the processor has
  portable,  ///< what the rest of the program is compiled for; no multiplication and addition in one
  avx2,      ///< AVX2 and FMA
  avx512     ///< AVX-512 F, DQ and FMA
};

std::string_view name_of(InstructionSet isa);

/// What this build and this processor have, `best` not among them; the last is the best.
std::span<const InstructionSet> instruction_sets();

/// isa, which this processor must have; the best there is for `best`.
InstructionSet chosen(InstructionSet isa);

/// Lanes of a pack.
template <class Real>
constexpr std::size_t lanes_of(InstructionSet isa) {
  const std::size_t bytes = isa == InstructionSet::avx512 ? 64 : isa == InstructionSet::avx2 ? 32 : 16;
  return bytes / sizeof(Real);
}

/// The kernel of the law with that index in LawList. isa: one of instruction_sets().
template <class Real>
FanKernel<Real> fan_kernel(InstructionSet isa, std::size_t law, bool continued);

// One a file.
template <class Real>
FanKernel<Real> portable_fan_kernel(std::size_t law, bool continued);
template <class Real>
FanKernel<Real> avx2_fan_kernel(std::size_t law, bool continued);
template <class Real>
FanKernel<Real> avx512_fan_kernel(std::size_t law, bool continued);

}  // namespace heml
