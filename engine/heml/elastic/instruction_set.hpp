#pragma once
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
InstructionSet resolve(InstructionSet isa);

}  // namespace heml
