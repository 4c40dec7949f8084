#include "app/render/outline.hpp"

#include <algorithm>

namespace heml::render {
namespace {

Vec2f on_screen(const Mat4f& to_clip, const Vec3f& point, Size size) {
  const Vec4f clip = to_clip * point.homogeneous();
  return Vec2f(clip.x() * static_cast<float>(size.width), clip.y() * static_cast<float>(size.height)) / (2 * clip.w());
}

}  // namespace

Outline::Outline(std::span<const std::uint32_t> triangles, std::span<const std::uint32_t> same)
    : triangles_(triangles.begin(), triangles.end()), facing_(triangles.size() / 3) {
  struct Side {
    std::uint32_t low, high, from, to, apex;
    int triangle;
  };
  std::vector<Side> sides;
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const std::size_t base = i - i % 3;
    const std::uint32_t from = triangles_[i], to = triangles_[base + (i + 1) % 3];
    const std::uint32_t apex = triangles_[base + (i + 2) % 3];
    const auto [low, high] = std::minmax(same[from], same[to]);
    sides.push_back({low, high, from, to, apex, static_cast<int>(i / 3)});
  }
  std::stable_sort(sides.begin(), sides.end(),
                   [](const Side& a, const Side& b) { return std::pair(a.low, a.high) < std::pair(b.low, b.high); });
  for (std::size_t i = 0; i < sides.size();) {
    const Side& side = sides[i++];
    Edge edge{side.from, side.to, side.triangle, -1, side.apex, side.apex, false};
    if (i < sides.size() && sides[i].low == side.low && sides[i].high == side.high) {
      edge.second = sides[i].triangle;
      edge.second_apex = sides[i].apex;
      edge.sharp = sides[i].from != side.to || sides[i].to != side.from;
      ++i;
    }
    edges_.push_back(edge);
  }
}

const std::vector<Outline::Piece>& Outline::find(std::span<const Vec3f> positions, const Vec3f& eye,
                                                 const Mat4f& to_clip, Size size) {
  for (std::size_t t = 0; t < facing_.size(); ++t) {
    const Vec3f &a = positions[triangles_[3 * t]], &b = positions[triangles_[3 * t + 1]],
                &c = positions[triangles_[3 * t + 2]];
    facing_[t] = (b - a).cross(c - a).dot(eye - a) > 0;
  }
  pieces_.clear();
  for (const Edge& edge : edges_) {
    const bool inside = edge.second >= 0 && facing_[edge.first] == facing_[edge.second];
    if (inside && !(edge.sharp && facing_[edge.first])) continue;
    const std::uint32_t apex = facing_[edge.first] || edge.second < 0 ? edge.first_apex : edge.second_apex;
    const Vec2f from = on_screen(to_clip, positions[edge.from], size);
    const Vec2f to = on_screen(to_clip, positions[edge.to], size);
    const Vec2f across = Vec2f(from.y() - to.y(), to.x() - from.x()).normalized();
    const float side = (on_screen(to_clip, positions[apex], size) - from).dot(across) > 0 ? -1.0f : 1.0f;
    const Vec2f pixel(2 / static_cast<float>(size.width), 2 / static_cast<float>(size.height));
    pieces_.push_back({edge.from, edge.to, side * across.cwiseProduct(pixel)});
  }
  return pieces_;
}

}  // namespace heml::render
