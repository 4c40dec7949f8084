#include <heml/elastic/fan_avx2.hpp>
#include <heml/elastic/fan_term_stages.hpp>

namespace heml {

template <>
FanTermKernels<double> avx2_term_kernels() {
  return fan::term_kernels<double, Avx2>();
}

}  // namespace heml
