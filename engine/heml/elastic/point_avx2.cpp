#include <heml/elastic/point_force_kernel.hpp>

namespace heml {
namespace {
struct PointsAvx2 {};
}  // namespace

template <>
PointKernel<float> avx2_point_kernel(std::size_t law, bool continued) {
  return point_force_kernel<float, PointsAvx2, 32>(law, continued);
}
template <>
PointKernel<double> avx2_point_kernel(std::size_t law, bool continued) {
  return point_force_kernel<double, PointsAvx2, 32>(law, continued);
}
template <>
PointKernel<float> avx2_point_energy_kernel(bool with_fibre) {
  return point_energy_kernel<float, PointsAvx2, 32>(with_fibre);
}
template <>
PointKernel<double> avx2_point_energy_kernel(bool with_fibre) {
  return point_energy_kernel<double, PointsAvx2, 32>(with_fibre);
}

}  // namespace heml
