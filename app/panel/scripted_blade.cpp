#include <algorithm>
#include <app/panel/scripted_blade.hpp>

namespace heml::panel {
namespace {
constexpr double blade_time = 0.1;  // s after a sweep
}

render::Blade blade_after(const Sweep& sweep) {
  const auto& last = sweep.blades.back();
  const auto& before = sweep.blades[sweep.blades.size() - 2];
  const Vec3 heading = last[0] + last[1] - before[0] - before[1];
  return {{last[0].cast<float>(), last[1].cast<float>()}, heading.cast<float>()};
}

std::optional<render::Blade> scripted_blade(std::span<const Event> events, long tick, double rate) {
  auto at = std::upper_bound(events.begin(), events.end(), tick,
                             [](long moment, const Event& event) { return moment < event.tick; });
  while (at != events.begin()) {
    --at;
    if (static_cast<double>(tick - at->tick) > blade_time * rate) return std::nullopt;
    const auto* cut = std::get_if<CutTissue>(&at->command);
    if (cut && cut->sweep.blades.size() > 1) return blade_after(cut->sweep);
  }
  return std::nullopt;
}

}  // namespace heml::panel
