#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <heml/base/error.hpp>
#include <heml/mesh/labels/label_field.hpp>
#include <numbers>

namespace heml {
namespace {

constexpr double deviation = 0.7;  // of the Gaussian, voxels: hides their steps, keeps what is two of them thick
constexpr int reach = 3;           // voxels
constexpr double max_stored = 7e8;

std::array<float, 2 * reach + 1> gaussian() {
  std::array<float, 2 * reach + 1> kernel;
  double sum = 0;
  for (int k = -reach; k <= reach; ++k) sum += std::exp(-0.5 * k * k / (deviation * deviation));
  for (int k = -reach; k <= reach; ++k)
    kernel[static_cast<std::size_t>(k + reach)] =
        static_cast<float>(std::exp(-0.5 * k * k / (deviation * deviation)) / sum);
  return kernel;
}

/// Convolves lines of values along one axis in place; zero beyond the ends.
void smooth_along(std::size_t axis, const std::array<int, 3>& size, std::vector<float>& values) {
  const auto kernel = gaussian();
  std::array<std::size_t, 3> stride{1, static_cast<std::size_t>(size[0]),
                                    static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1])};
  const auto length = static_cast<std::size_t>(size[axis]);
  // Blocks of neighbouring lines, so that memory is read in order.
  const std::size_t inner = stride[axis], outer = values.size() / (inner * length);
  std::vector<float> padded((length + 2 * reach) * std::min<std::size_t>(inner, 64));
  for (std::size_t o = 0; o < outer; ++o)
    for (std::size_t first = 0; first < inner; first += 64) {
      const std::size_t width = std::min<std::size_t>(64, inner - first);
      float* block = &values[o * inner * length + first];
      std::fill(padded.begin(), padded.end(), 0.0f);
      for (std::size_t n = 0; n < length; ++n) std::copy_n(block + n * inner, width, &padded[(n + reach) * width]);
      for (std::size_t n = 0; n < length; ++n) {
        float* out = block + n * inner;
        std::fill_n(out, width, 0.0f);
        for (std::size_t k = 0; k < kernel.size(); ++k)
          for (std::size_t w = 0; w < width; ++w) out[w] += kernel[k] * padded[(n + k) * width + w];
      }
    }
}

}  // namespace

LabelField::LabelField(const LabelMap& map)
    : indicators_(map.values.size()),
      weights_(map.values.size(), 0.0),
      to_voxel_(map.axes.inverse()),
      origin_(map.origin) {
  const std::size_t count = map.values.size();
  std::vector<std::array<int, 3>> low(count, map.size), high(count, {-1, -1, -1});
  std::size_t v = 0;
  for (int k = 0; k < map.size[2]; ++k)
    for (int j = 0; j < map.size[1]; ++j)
      for (int i = 0; i < map.size[0]; ++i, ++v) {
        const std::array<int, 3> at{i, j, k};
        const std::size_t label = map.voxels[v];
        for (std::size_t d = 0; d < 3; ++d) {
          low[label][d] = std::min(low[label][d], at[d]);
          high[label][d] = std::max(high[label][d], at[d]);
        }
      }
  double values = 0;
  for (std::size_t label = 1; label < count; ++label) {
    double box = 1;
    for (std::size_t d = 0; d < 3; ++d) box *= std::max(0, high[label][d] - low[label][d] + 1) + 2 * reach;
    values += box;
  }
  if (values > max_stored)
    throw InputError(map.source, "",
                     fmt::format("its {} labels fill boxes of {:.2g} voxels together", count - 1, values),
                     fmt::format("{:.0e} at most: choose labels (--labels 1,2), or resample it", max_stored));
  for (std::size_t label = 1; label < count; ++label)
    if (high[label][0] >= 0) indicators_[label] = smoothed(map, static_cast<int>(label), low[label], high[label]);
}

LabelField::Indicator LabelField::smoothed(const LabelMap& map, int label, const std::array<int, 3>& low,
                                           const std::array<int, 3>& high) {
  Indicator result;
  for (std::size_t d = 0; d < 3; ++d) {
    result.low[d] = low[d] - reach;
    result.size[d] = high[d] - low[d] + 1 + 2 * reach;
  }
  const auto nx = static_cast<std::size_t>(result.size[0]), ny = static_cast<std::size_t>(result.size[1]);
  result.values.assign(nx * ny * static_cast<std::size_t>(result.size[2]), 0.0f);
  for (int k = low[2]; k <= high[2]; ++k)
    for (int j = low[1]; j <= high[1]; ++j) {
      const std::uint8_t* from = &map.voxels[map.index(low[0], j, k)];
      float* to = &result.values[reach + nx * (static_cast<std::size_t>(j - result.low[1]) +
                                               ny * static_cast<std::size_t>(k - result.low[2]))];
      for (int i = 0; i <= high[0] - low[0]; ++i) to[i] = from[i] == label ? 1.0f : 0.0f;
    }
  for (std::size_t axis = 0; axis < 3; ++axis) smooth_along(axis, result.size, result.values);
  return result;
}

/// Trilinear.
float LabelField::Indicator::at(const Vec3& voxel) const {
  if (values.empty()) return 0;
  std::array<std::size_t, 3> cell;
  std::array<float, 3> part;
  for (std::size_t d = 0; d < 3; ++d) {
    const double local = voxel[static_cast<int>(d)] - low[d];
    if (!(local > 0) || !(local < size[d] - 1)) return 0;
    cell[d] = static_cast<std::size_t>(local);
    part[d] = static_cast<float>(local - static_cast<double>(cell[d]));
  }
  const auto nx = static_cast<std::size_t>(size[0]), nxy = nx * static_cast<std::size_t>(size[1]);
  const float* corner = &values[cell[0] + nx * cell[1] + nxy * cell[2]];
  const auto along = [&](const float* from) { return from[0] + part[0] * (from[1] - from[0]); };
  const auto plane = [&](const float* from) {
    const float near = along(from);
    return near + part[1] * (along(from + nx) - near);
  };
  const float near = plane(corner);
  return near + part[2] * (plane(corner + nxy) - near);
}

double LabelField::value(int label, const Vec3& voxel) const {
  if (label > 0) return static_cast<double>(indicators_[label].at(voxel)) + weights_[label];
  double rest = 1;
  for (std::size_t k = 1; k < indicators_.size(); ++k) rest -= static_cast<double>(indicators_[k].at(voxel));
  return rest;
}

int LabelField::label_at(const Vec3& x) const {
  const Vec3 voxel = voxel_of(x);
  double rest = 1, largest = -1;
  int label = 0;
  for (std::size_t k = 1; k < indicators_.size(); ++k) {
    const double share = static_cast<double>(indicators_[k].at(voxel));
    if (share <= 0) continue;
    rest -= share;
    if (share + weights_[k] > largest) {
      largest = share + weights_[k];
      label = static_cast<int>(k);
    }
  }
  return largest > rest ? label : 0;
}

double LabelField::difference(int a, int b, const Vec3& x) const {
  const Vec3 voxel = voxel_of(x);
  return value(a, voxel) - value(b, voxel);
}

/// Across a flat interface the difference of two labels has the slope 2/(deviation √2π) per voxel; interpolation
/// flattens it a little.
double LabelField::offset_of_weight() {
  return 0.5 * std::sqrt(deviation * deviation + 1.0 / 6) * std::sqrt(2 * std::numbers::pi);
}

}  // namespace heml
