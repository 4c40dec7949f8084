#include <heml/elastic/fan_energy.hpp>

namespace heml {

template <class Real>
FanKernel<Real> energy_fan_kernel(InstructionSet isa, bool with_fibre) {
#if HEML_X86_KERNELS
  if (isa == InstructionSet::avx512) return avx512_energy_kernel<Real>(with_fibre);
  if (isa == InstructionSet::avx2) return avx2_energy_kernel<Real>(with_fibre);
#endif
  (void)isa;
  return portable_energy_kernel<Real>(with_fibre);
}

template FanKernel<float> energy_fan_kernel(InstructionSet, bool);
template FanKernel<double> energy_fan_kernel(InstructionSet, bool);

}  // namespace heml
