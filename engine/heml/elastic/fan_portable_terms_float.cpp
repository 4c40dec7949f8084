#include <heml/elastic/fan_portable.hpp>
#include <heml/elastic/fan_term_stages.hpp>

namespace heml {

template <>
FanTermKernels<float> portable_term_kernels() {
  return fan::term_kernels<float, Portable>();
}

}  // namespace heml
