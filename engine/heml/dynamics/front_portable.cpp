#include <heml/dynamics/front_kernel_code.hpp>

namespace heml {
namespace {
struct PortableFront {};
}  // namespace

const FrontKernels portable_front_kernels = FrontCode<Pack<double, 2, PortableFront>, 1, 2>::kernels;

}  // namespace heml
