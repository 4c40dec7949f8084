#include <heml/elastic/point_force_kernel.hpp>

namespace heml {
namespace {
struct PointsAvx512 {};
}  // namespace

template <>
PointKernel<float> avx512_point_kernel(std::size_t law, bool continued) {
  return point_force_kernel<float, PointsAvx512, 64>(law, continued);
}
template <>
PointKernel<double> avx512_point_kernel(std::size_t law, bool continued) {
  return point_force_kernel<double, PointsAvx512, 64>(law, continued);
}
template <>
PointKernel<float> avx512_point_energy_kernel(bool with_fibre) {
  return point_energy_kernel<float, PointsAvx512, 64>(with_fibre);
}
template <>
PointKernel<double> avx512_point_energy_kernel(bool with_fibre) {
  return point_energy_kernel<double, PointsAvx512, 64>(with_fibre);
}

}  // namespace heml
