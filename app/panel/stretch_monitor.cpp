#include <algorithm>
#include <app/panel/stretch_monitor.hpp>
#include <heml/scenario/presets.hpp>

namespace heml::panel {

StretchMonitor::StretchMonitor(const SurfaceMesh& surface_mesh)
    : regions_of_node_(surface_mesh.rest.size()), limit_(surface_mesh.rest.size(), no_limit) {
  for (std::size_t t = 0; t < surface_mesh.triangles.size(); ++t)
    for (const int node : surface_mesh.triangles[t]) {
      std::vector<int>& regions = regions_of_node_[static_cast<std::size_t>(node)];
      const int region = t < surface_mesh.regions.size() ? surface_mesh.regions[t] : 0;
      if (std::find(regions.begin(), regions.end(), region) == regions.end()) regions.push_back(region);
    }
}

void StretchMonitor::set(std::span<const RegionMaterial> materials) {
  const auto limit_of = [](const Material& material) {
    const Preset* preset = preset_of(material);
    return preset && preset->stretch_range ? static_cast<float>(preset->stretch_range->high) : no_limit;
  };
  float elsewhere = no_limit;
  std::vector<std::pair<int, float>> by_region;
  for (const RegionMaterial& entry : materials)
    if (entry.region)
      by_region.emplace_back(*entry.region, limit_of(entry.material));
    else
      elsewhere = limit_of(entry.material);
  for (std::size_t n = 0; n < limit_.size(); ++n) {
    limit_[n] = no_limit;
    for (const int region : regions_of_node_[n]) {
      const auto own = std::find_if(by_region.begin(), by_region.end(), [&](auto& r) { return r.first == region; });
      limit_[n] = std::min(limit_[n], own == by_region.end() ? elsewhere : own->second);
    }
  }
  active_ = std::any_of(limit_.begin(), limit_.end(), [](float limit) { return limit < no_limit; });
  beyond_.clear();
  share_ = 0;
}

void StretchMonitor::update(const Frame& frame) {
  if (!active_ || frame.stretches.size() != limit_.size()) {
    beyond_.clear();
    share_ = 0;
    return;
  }
  beyond_.resize(limit_.size());
  std::size_t limited = 0, outside = 0;
  for (std::size_t n = 0; n < limit_.size(); ++n) {
    const bool has_limit = limit_[n] < no_limit;
    beyond_[n] = has_limit ? frame.stretches[n] - limit_[n] : -1;
    limited += has_limit;
    outside += beyond_[n] > 0;
  }
  share_ = static_cast<double>(outside) / static_cast<double>(limited);
}

}  // namespace heml::panel
