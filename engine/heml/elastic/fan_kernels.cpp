#include <heml/elastic/fan_kernels.hpp>

namespace heml {

template <class Real>
FanKernel<Real> fan_kernel(InstructionSet isa, std::size_t law, bool continued) {
#if HEML_X86_KERNELS
  if (isa == InstructionSet::avx512) return avx512_fan_kernel<Real>(law, continued);
  if (isa == InstructionSet::avx2) return avx2_fan_kernel<Real>(law, continued);
#endif
  return portable_fan_kernel<Real>(law, continued);
}

template FanKernel<float> fan_kernel(InstructionSet, std::size_t, bool);
template FanKernel<double> fan_kernel(InstructionSet, std::size_t, bool);

}  // namespace heml
