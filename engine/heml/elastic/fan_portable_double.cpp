#include <heml/elastic/fan_portable.hpp>

namespace heml {

template <>
FanKernel<double> portable_fan_kernel(std::size_t law, bool continued) {
  return fan::force_kernel<double, Portable>(law, continued);
}

}  // namespace heml
