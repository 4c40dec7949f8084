#pragma once
#include <span>
#include <string_view>

namespace heml {

/// Instruction set of the fan kernels. Results of different sets differ by round-off.
enum class InstructionSet {
  best,      ///< the best set that the processor has
  portable,  ///< target of the rest of the program; no fused multiply-add
  avx2,      ///< AVX2 and FMA
  avx512     ///< AVX-512 F, DQ and FMA
};

std::string_view name_of(InstructionSet isa);

/// The sets that this build and this processor support, from `portable` to the best.
std::span<const InstructionSet> instruction_sets();

/// The best supported set for `best`, else isa, which must be supported (asserted).
InstructionSet resolve(InstructionSet isa);

}  // namespace heml
