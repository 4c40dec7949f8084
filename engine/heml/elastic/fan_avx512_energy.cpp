#include <heml/elastic/fan_avx512.hpp>
#include <heml/elastic/fan_energy.hpp>

namespace heml {

template <>
FanKernel<float> avx512_energy_kernel(bool with_fibre) {
  return fan::energy_kernel<float, Avx512>(with_fibre);
}
template <>
FanKernel<double> avx512_energy_kernel(bool with_fibre) {
  return fan::energy_kernel<double, Avx512>(with_fibre);
}

}  // namespace heml
