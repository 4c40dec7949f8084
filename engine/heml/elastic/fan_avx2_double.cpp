#include <heml/elastic/fan_avx2.hpp>

namespace heml {

template <>
FanKernel<double> avx2_fan_kernel(std::size_t law, bool continued) {
  return fan::force_kernel<double, Avx2>(law, continued);
}

}  // namespace heml
