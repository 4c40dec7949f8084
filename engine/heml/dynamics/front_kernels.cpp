#include <heml/dynamics/front_kernels.hpp>

namespace heml {

const FrontKernels& front_kernels(InstructionSet isa) {
#if HEML_X86_KERNELS
  if (isa == InstructionSet::avx512) return avx512_front_kernels;
  if (isa == InstructionSet::avx2) return avx2_front_kernels;
#endif
  return portable_front_kernels;
}

}  // namespace heml
