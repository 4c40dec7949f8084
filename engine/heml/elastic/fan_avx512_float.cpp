#include <heml/elastic/fan_avx512.hpp>

namespace heml {

template <>
FanKernel<float> avx512_fan_kernel(std::size_t law, bool continued) {
  return fan::force_kernel<float, Avx512>(law, continued);
}

}  // namespace heml
