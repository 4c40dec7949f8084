#include <heml/elastic/fan_avx2.hpp>
#include <heml/elastic/fan_energy.hpp>

namespace heml {

template <>
FanKernel<float> avx2_energy_kernel(bool with_fibre) {
  return fan::energy_kernel<float, Avx2>(with_fibre);
}
template <>
FanKernel<double> avx2_energy_kernel(bool with_fibre) {
  return fan::energy_kernel<double, Avx2>(with_fibre);
}

}  // namespace heml
