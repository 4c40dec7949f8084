#include <heml/dynamics/front_kernel_code.hpp>

namespace heml {
namespace {
struct Avx512Front {};
}  // namespace

const FrontKernels avx512_front_kernels = FrontCode<Pack<double, 8, Avx512Front>, 3, 8>::kernels;

}  // namespace heml
