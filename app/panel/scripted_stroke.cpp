#include <algorithm>
#include <app/panel/scripted_stroke.hpp>

namespace heml::panel {
namespace {
constexpr double blade_time = 0.1;  // s after a sweep
}

namespace {
/// Near the end that a stroke's upper end is: where it touches the skin is not said.
render::Electrode electrode_of(const std::array<Vec3, 2>& blade) { return {blade[0].cast<float>()}; }
}  // namespace

render::Blade blade_after(const Sweep& sweep) {
  const auto& last = sweep.blades.back();
  const auto& before = sweep.blades[sweep.blades.size() - 2];
  const Vec3 heading = last[0] + last[1] - before[0] - before[1];
  return {{last[0].cast<float>(), last[1].cast<float>()}, heading.cast<float>()};
}

render::StrokeDrawing scripted_stroke(std::span<const Event> events, long tick, double rate) {
  auto at = std::upper_bound(events.begin(), events.end(), tick,
                             [](long moment, const Event& event) { return moment < event.tick; });
  while (at != events.begin()) {
    --at;
    if (static_cast<double>(tick - at->tick) > blade_time * rate) return {};
    const auto* cut = std::get_if<CutTissue>(&at->command);
    if (cut && cut->sweep.blades.size() > 1) return {blade_after(cut->sweep), {}};
    if (const auto* burn = std::get_if<CauterizeTissue>(&at->command); burn && !burn->sweep.blades.empty())
      return {std::nullopt, {}, std::nullopt, electrode_of(burn->sweep.blades.back())};
  }
  return {};
}

}  // namespace heml::panel
