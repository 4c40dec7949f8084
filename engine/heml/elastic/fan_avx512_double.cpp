#include <heml/elastic/fan_avx512.hpp>

namespace heml {

template <>
FanKernel<double> avx512_fan_kernel(std::size_t law, bool continued) {
  return fan::force_kernel<double, Avx512>(law, continued);
}

}  // namespace heml
