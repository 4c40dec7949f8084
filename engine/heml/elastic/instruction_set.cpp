#include <array>
#include <cassert>
#include <heml/elastic/instruction_set.hpp>

namespace heml {

std::string_view name_of(InstructionSet isa) {
  switch (isa) {
    case InstructionSet::best:
      return "best";
    case InstructionSet::portable:
      return "portable";
    case InstructionSet::avx2:
      return "avx2";
    case InstructionSet::avx512:
      return "avx512";
  }
  return "";
}

std::span<const InstructionSet> instruction_sets() {
  static constexpr std::array all = {InstructionSet::portable, InstructionSet::avx2, InstructionSet::avx512};
#if HEML_X86_KERNELS
  static const std::size_t count = [] {
    const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq");
    return std::size_t{1} + (avx2 ? 1 : 0) + (avx512 ? 1 : 0);
  }();
#else
  static constexpr std::size_t count = 1;
#endif
  return {all.data(), count};
}

InstructionSet resolve(InstructionSet isa) {
  if (isa == InstructionSet::best) return instruction_sets().back();
  assert(isa <= instruction_sets().back());
  return isa;
}

}  // namespace heml
