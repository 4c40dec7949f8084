#include <heml/elastic/fan_avx512.hpp>
#include <heml/elastic/fan_term_stages.hpp>

namespace heml {

template <>
FanTermKernels<double> avx512_term_kernels() {
  return fan::term_kernels<double, Avx512>();
}

}  // namespace heml
