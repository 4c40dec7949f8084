#include "app/render/pick_grid.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace heml::render {
namespace {

constexpr float margin = 1;           // pixels, that rounding may move a corner by, and more
constexpr float max_pixel = 1e5f;     // farther ones are rounded by more
constexpr float max_cells = 1 << 20;  // however fine the surface is

}  // namespace

PickGrid::PickGrid(const Frame& frame, const SurfaceMesh& surface_mesh, const Camera& camera, Size size)
    : frame_(frame), surface_mesh_(surface_mesh), camera_(camera), size_(size) {
  const Mat4f projection = camera.projection(size) * camera.view();
  std::vector<bool> behind;  // the eye
  for (const Vec3f& x : frame.positions) {
    pixels_.push_back(camera.pixel(x, size));
    behind.push_back(!(projection.row(3).dot(x.homogeneous()) > 0));
    if (behind.back() || !(pixels_.back().cwiseAbs().maxCoeff() < max_pixel))
      pixels_.back().setConstant(std::numeric_limits<float>::quiet_NaN());
  }
  const auto width = static_cast<float>(size.width), height = static_cast<float>(size.height);
  const float wanted = std::clamp(static_cast<float>(surface_mesh.triangles.size()), 1.0f, max_cells);
  side_ = std::max(1.0f, std::sqrt(width * height / wanted));
  columns_ = std::max(1, static_cast<int>(std::ceil(width / side_)));
  rows_ = std::max(1, static_cast<int>(std::ceil(height / side_)));
  list_triangles(behind);
}

int PickGrid::column(float x) const {
  return static_cast<int>(std::clamp(x / side_, 0.0f, static_cast<float>(columns_ - 1)));
}

int PickGrid::row(float y) const {
  return static_cast<int>(std::clamp(y / side_, 0.0f, static_cast<float>(rows_ - 1)));
}

template <class Visit>
void PickGrid::each_cell(const Triangle& triangle, const Visit& visit) const {
  const auto at = [&](std::size_t k) { return pixels_[static_cast<std::size_t>(triangle[k])]; };
  if (!(at(0) + at(1) + at(2)).allFinite()) return;
  const Vec2f low = at(0).cwiseMin(at(1)).cwiseMin(at(2)) - Vec2f::Constant(margin);
  const Vec2f high = at(0).cwiseMax(at(1)).cwiseMax(at(2)) + Vec2f::Constant(margin);
  for (int y = row(low.y()); y <= row(high.y()); ++y)
    for (int x = column(low.x()); x <= column(high.x()); ++x) visit(static_cast<std::size_t>(y * columns_ + x));
}

/// Counts the triangles of each cell, then puts them there. No ray meets what is behind the eye altogether.
void PickGrid::list_triangles(const std::vector<bool>& behind) {
  starts_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
  const auto count = static_cast<int>(surface_mesh_.triangles.size());
  const auto corners = [&](int t) { return surface_mesh_.triangles[static_cast<std::size_t>(t)]; };
  const auto is_behind = [&](int n) { return behind[static_cast<std::size_t>(n)]; };
  const auto has_place = [&](int n) { return pixels_[static_cast<std::size_t>(n)].allFinite(); };
  for (int t = 0; t < count; ++t) {
    const Triangle triangle = corners(t);
    each_cell(triangle, [&](std::size_t cell) { ++starts_[cell + 1]; });
    if (!std::all_of(triangle.begin(), triangle.end(), has_place) &&
        !std::all_of(triangle.begin(), triangle.end(), is_behind))
      everywhere_.push_back(t);
  }
  for (std::size_t cell = 1; cell < starts_.size(); ++cell) starts_[cell] += starts_[cell - 1];
  triangles_.resize(starts_.back());
  std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
  for (int t = 0; t < count; ++t)
    each_cell(corners(t), [&](std::size_t cell) { triangles_[next[cell]++] = t; });
}

std::optional<Hit> PickGrid::pick(const Vec2f& at, const std::optional<SectionPlane>& section) const {
  const auto cell = static_cast<std::size_t>(row(at.y()) * columns_ + column(at.x()));
  const auto first = triangles_.begin() + static_cast<std::ptrdiff_t>(starts_[cell]),
             last = triangles_.begin() + static_cast<std::ptrdiff_t>(starts_[cell + 1]);
  std::vector<int> near;
  std::merge(first, last, everywhere_.begin(), everywhere_.end(), std::back_inserter(near));
  return render::pick(frame_, surface_mesh_, near, camera_.ray(at.x(), at.y(), size_), section);
}

}  // namespace heml::render
