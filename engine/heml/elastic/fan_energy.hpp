#pragma once
// Force kernels of laws by expression of invariants. They run each operation on a pack of tetrahedra. Each is compiled
// in a file of its own (fan_portable_energy.cpp, fan_avx2_energy.cpp, fan_avx512_energy.cpp).
#include <heml/elastic/fan_force_kernel.hpp>
#include <heml/elastic/fan_kernels.hpp>
#include <heml/elastic/noting_energy.hpp>

namespace heml {

/// The kernel of InvariantEnergy<Real, false, with_fibre>. isa: one of instruction_sets().
template <class Real>
FanKernel<Real> energy_fan_kernel(InstructionSet isa, bool with_fibre);

template <class Real>
FanKernel<Real> portable_energy_kernel(bool with_fibre);
template <class Real>
FanKernel<Real> avx2_energy_kernel(bool with_fibre);
template <class Real>
FanKernel<Real> avx512_energy_kernel(bool with_fibre);

namespace fan {

template <class Real, class Isa, bool with_fibre>
bool energy_block(const void* law, const FanBlock<Real>& block, const Real* x, Real* f) {
  using P = typename Isa::template pack<Real>;
  Mask<P> defined = true;
  const auto* numbers = static_cast<const InvariantEnergy<Real, false, with_fibre>*>(law);
  const NotingEnergy<P, with_fibre> noting{numbers->template broadcast<P>(), &defined};
  ForceKernel<Real, Isa, NotingEnergy<P, with_fibre>>::block(noting, block, x, f);
  return defined.all();
}

template <class Real, class Isa>
FanKernel<Real> energy_kernel(bool with_fibre) {
  return with_fibre ? energy_block<Real, Isa, true> : energy_block<Real, Isa, false>;
}

}  // namespace fan
}  // namespace heml
