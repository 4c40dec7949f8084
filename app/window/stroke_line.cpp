#include <algorithm>
#include <app/window/stroke_line.hpp>
#include <optional>
#include <utility>

namespace heml::window {
namespace {

constexpr float parted = 1.3f;  // growth of the longest side of a triangle from which tissue has come apart

float longest_side(const std::array<Vec3f, 3>& x) {
  return std::max({(x[0] - x[1]).norm(), (x[1] - x[2]).norm(), (x[2] - x[0]).norm()});
}

}  // namespace

void StrokeLine::add(const render::Hit& hit, const Frame& frame, const SurfaceMesh& surface_mesh) {
  const render::SurfacePoint at = render::surface_point(hit, frame, surface_mesh);
  points_.push_back({at, longest_side(*render::corners_of(at, frame, surface_mesh)),
                     std::exchange(lifted_, false) || points_.empty()});
}

void StrokeLine::lift() { lifted_ = true; }

std::vector<std::array<Vec3f, 2>> StrokeLine::segments(const Frame& frame, const SurfaceMesh& surface_mesh) const {
  const auto place = [&](const Point& point) -> std::optional<Vec3f> {
    const auto corners = render::corners_of(point.at, frame, surface_mesh);
    if (!corners || longest_side(*corners) > parted * point.extent) return std::nullopt;
    return point.at.among(*corners);
  };
  std::vector<std::array<Vec3f, 2>> segments;
  std::optional<Vec3f> last;
  for (const Point& point : points_) {
    const std::optional<Vec3f> next = place(point);
    if (last && next && !point.begins) segments.push_back({*last, *next});
    last = next;
  }
  return segments;
}

}  // namespace heml::window
