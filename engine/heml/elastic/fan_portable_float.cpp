#include <heml/elastic/fan_portable.hpp>

namespace heml {

template <>
FanKernel<float> portable_fan_kernel(std::size_t law, bool continued) {
  return fan::force_kernel<float, Portable>(law, continued);
}

}  // namespace heml
