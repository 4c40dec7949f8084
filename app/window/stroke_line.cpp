#include <algorithm>
#include <app/window/stroke_line.hpp>
#include <heml/math/closest.hpp>
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
  Point point;
  std::array<Vec3f, 3> x;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto node = static_cast<std::size_t>(surface_mesh.triangles[static_cast<std::size_t>(hit.triangle)][k]);
    point.nodes[k] = surface_mesh.nodes[node];
    x[k] = frame.positions[node];
  }
  const auto weights =
      closest_point_weights(hit.point.cast<double>(), x[0].cast<double>(), x[1].cast<double>(), x[2].cast<double>());
  for (std::size_t k = 0; k < 3; ++k) point.weights[k] = static_cast<float>(weights[k]);
  point.extent = longest_side(x);
  point.begins = std::exchange(lifted_, false) || points_.empty();
  points_.push_back(point);
}

void StrokeLine::lift() { lifted_ = true; }

std::vector<std::array<Vec3f, 2>> StrokeLine::segments(const Frame& frame, const SurfaceMesh& surface_mesh) const {
  const auto place = [&](const Point& point) -> std::optional<Vec3f> {
    std::array<Vec3f, 3> x;
    Vec3f sum = Vec3f::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      const auto at = std::lower_bound(surface_mesh.nodes.begin(), surface_mesh.nodes.end(), point.nodes[k]);
      if (at == surface_mesh.nodes.end() || *at != point.nodes[k]) return std::nullopt;
      x[k] = frame.positions[static_cast<std::size_t>(at - surface_mesh.nodes.begin())];
      sum += point.weights[k] * x[k];
    }
    if (longest_side(x) > parted * point.extent) return std::nullopt;
    return sum;
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
