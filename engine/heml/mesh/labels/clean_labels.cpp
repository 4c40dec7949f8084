#include <fmt/format.h>

#include <algorithm>
#include <heml/base/log.hpp>
#include <heml/mesh/labels/clean_labels.hpp>

namespace heml {
namespace {

constexpr std::size_t min_component = 8;  // voxels
constexpr std::size_t max_listed_voxels = 1 << 20;
constexpr double min_share = 0.001;  // of its label

/// Floods components of equal voxels one at a time.
class SpeckFinder {
 public:
  explicit SpeckFinder(LabelMap& map) : map_(map), seen_(map.voxels.size(), 0) {
    const auto row = static_cast<std::ptrdiff_t>(map.size[0]);
    steps_ = {1, -1, row, -row, row * map.size[1], -row * map.size[1]};
  }

  /// Calls found(size, voxels) for each component; of large ones only some voxels.
  template <class Found>
  void for_each(Found found) {
    for (std::size_t v = 0; v < map_.voxels.size(); ++v)
      if (!seen_[v]) {
        const std::size_t size = flood(v);
        found(size, component_);
      }
  }

  /// What borders on a component by most faces; ties: the smaller label.
  std::uint8_t surrounding(const std::vector<std::size_t>& component) const {
    std::array<std::size_t, 256> faces{};
    const std::uint8_t label = map_.voxels[component.front()];
    for (const std::size_t v : component)
      for (const std::ptrdiff_t step : steps_)
        if (has(v, step) && map_.voxels[next(v, step)] != label) ++faces[map_.voxels[next(v, step)]];
    return static_cast<std::uint8_t>(std::max_element(faces.begin(), faces.end()) - faces.begin());
  }

 private:
  std::size_t flood(std::size_t first) {
    component_.clear();
    open_.assign(1, static_cast<std::uint32_t>(first));
    seen_[first] = 1;
    std::size_t size = 0;
    while (!open_.empty()) {
      const std::size_t v = open_.back();
      open_.pop_back();
      if (++size <= max_listed_voxels) component_.push_back(v);
      for (const std::ptrdiff_t step : steps_) {
        if (!has(v, step)) continue;
        const std::size_t n = next(v, step);
        if (seen_[n] || map_.voxels[n] != map_.voxels[v]) continue;
        seen_[n] = 1;
        open_.push_back(static_cast<std::uint32_t>(n));
      }
    }
    return size;
  }
  bool has(std::size_t v, std::ptrdiff_t step) const {
    const auto ni = static_cast<std::size_t>(map_.size[0]);
    const std::size_t i = v % ni;
    if (step == 1) return i + 1 < ni;
    if (step == -1) return i > 0;
    const auto j = static_cast<std::ptrdiff_t>((v / ni) % static_cast<std::size_t>(map_.size[1]));
    if (step == steps_[2]) return j + 1 < map_.size[1];
    if (step == steps_[3]) return j > 0;
    const std::ptrdiff_t n = static_cast<std::ptrdiff_t>(v) + step;
    return n >= 0 && n < static_cast<std::ptrdiff_t>(map_.voxels.size());
  }
  static std::size_t next(std::size_t v, std::ptrdiff_t step) {
    return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(v) + step);
  }

  const LabelMap& map_;
  std::vector<char> seen_;
  std::array<std::ptrdiff_t, 6> steps_{};
  std::vector<std::size_t> component_;
  std::vector<std::uint32_t> open_;
};

}  // namespace

std::vector<std::size_t> count_labels(const LabelMap& map) {
  std::vector<std::size_t> counts(map.values.size(), 0);
  for (const std::uint8_t voxel : map.voxels) ++counts[voxel];
  return counts;
}

void crop(LabelMap& map) {
  std::array<int, 3> low = map.size, high{-1, -1, -1};
  std::size_t v = 0;
  for (int k = 0; k < map.size[2]; ++k)
    for (int j = 0; j < map.size[1]; ++j)
      for (int i = 0; i < map.size[0]; ++i, ++v)
        if (map.voxels[v]) {
          const std::array<int, 3> at{i, j, k};
          for (std::size_t d = 0; d < 3; ++d) {
            low[d] = std::min(low[d], at[d]);
            high[d] = std::max(high[d], at[d]);
          }
        }
  LabelMap cropped = map;
  for (std::size_t d = 0; d < 3; ++d) cropped.size[d] = high[d] - low[d] + 3;
  cropped.origin += map.axes * (Vec3(low[0], low[1], low[2]) - Vec3::Ones());
  cropped.voxels.assign(cropped.index(0, 0, cropped.size[2]), 0);
  for (int k = low[2]; k <= high[2]; ++k)
    for (int j = low[1]; j <= high[1]; ++j)
      std::copy_n(&map.voxels[map.index(low[0], j, k)], high[0] - low[0] + 1,
                  &cropped.voxels[cropped.index(1, j - low[1] + 1, k - low[2] + 1)]);
  map = std::move(cropped);
}

void remove_specks(LabelMap& map) {
  const std::vector<std::size_t> counts = count_labels(map);
  std::vector<std::size_t> removed(counts.size(), 0);
  // Outside, the labels' volume decides what a small hole is.
  const std::size_t all = map.voxels.size() - counts[0];
  std::vector<std::vector<std::size_t>> specks;
  SpeckFinder finder(map);
  finder.for_each([&](std::size_t voxels, const std::vector<std::size_t>& component) {
    const std::uint8_t label = map.voxels[component.front()];
    const double whole = static_cast<double>(label == 0 ? all : counts[label]);
    const auto size = static_cast<double>(voxels);
    if (voxels == counts[label] || size >= std::max<double>(min_component, min_share * whole)) return;
    specks.push_back(component);
  });
  for (const auto& component : specks) {
    const std::uint8_t label = map.voxels[component.front()], other = finder.surrounding(component);
    for (const std::size_t v : component) map.voxels[v] = other;
    ++removed[label];
  }
  for (std::size_t label = 0; label < removed.size(); ++label)
    if (removed[label] > 0)
      warn("{}: {}", map.source,
           label == 0 ? fmt::format("{} small hole{} filled", removed[label], removed[label] == 1 ? " was" : "s were")
                      : fmt::format("label {}: {} speck{} apart from it left out", map.values[label], removed[label],
                                    removed[label] == 1 ? "" : "s"));
}

}  // namespace heml
