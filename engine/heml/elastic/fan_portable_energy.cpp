#include <heml/elastic/fan_energy.hpp>
#include <heml/elastic/fan_portable.hpp>

namespace heml {

template <>
FanKernel<float> portable_energy_kernel(bool with_fibre) {
  return fan::energy_kernel<float, Portable>(with_fibre);
}
template <>
FanKernel<double> portable_energy_kernel(bool with_fibre) {
  return fan::energy_kernel<double, Portable>(with_fibre);
}

}  // namespace heml
