#include <heml/elastic/fan_term_kernels.hpp>

namespace heml {

template <class Real>
FanTermKernels<Real> fan_term_kernels(InstructionSet isa) {
#if HEML_X86_KERNELS
  if (isa == InstructionSet::avx512) return avx512_term_kernels<Real>();
  if (isa == InstructionSet::avx2) return avx2_term_kernels<Real>();
#endif
  (void)isa;
  return portable_term_kernels<Real>();
}

template FanTermKernels<float> fan_term_kernels(InstructionSet);
template FanTermKernels<double> fan_term_kernels(InstructionSet);

}  // namespace heml
