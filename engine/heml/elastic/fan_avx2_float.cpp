#include <heml/elastic/fan_avx2.hpp>

namespace heml {

template <>
FanKernel<float> avx2_fan_kernel(std::size_t law, bool continued) {
  return fan::force_kernel<float, Avx2>(law, continued);
}

}  // namespace heml
