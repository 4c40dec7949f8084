#include <heml/dynamics/front_kernel_code.hpp>

namespace heml {
namespace {
struct Avx2Front {};
}  // namespace

const FrontKernels avx2_front_kernels = FrontCode<Pack<double, 4, Avx2Front>, 1, 4>::kernels;

}  // namespace heml
