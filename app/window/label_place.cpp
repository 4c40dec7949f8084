#include <algorithm>
#include <app/window/label_place.hpp>
#include <array>

namespace heml::window {
namespace {

using panel::Area;

/// Cuts a stretch 0 to 1 down to where from + t·by lies between two limits. Returns whether any is left.
bool cut(float from, float by, float low, float high, std::array<float, 2>& stretch) {
  if (by == 0) return from > low && from < high;
  const float a = (low - from) / by, b = (high - from) / by;
  stretch[0] = std::max(stretch[0], std::min(a, b));
  stretch[1] = std::min(stretch[1], std::max(a, b));
  return stretch[0] < stretch[1];
}

bool is_crossed(const Area& area, const ImVec2& a, const ImVec2& b) {
  std::array<float, 2> stretch{0, 1};
  return cut(a.x, b.x - a.x, area.from.x, area.to.x, stretch) && cut(a.y, b.y - a.y, area.from.y, area.to.y, stretch);
}

bool is_free(const Area& area, std::span<const ImVec2> points) {
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (area.contains(points[k].x, points[k].y)) return false;
    if (k > 0 && is_crossed(area, points[k - 1], points[k])) return false;
  }
  return true;
}

Area box_of(std::span<const ImVec2> points) {
  Area box{points[0], points[0]};
  for (const ImVec2& at : points) {
    box.from = {std::min(box.from.x, at.x), std::min(box.from.y, at.y)};
    box.to = {std::max(box.to.x, at.x), std::max(box.to.y, at.y)};
  }
  return box;
}

/// Upper left corners of labels at the right, left, bottom and top of a box.
std::array<ImVec2, 4> corners_beside(const Area& box, ImVec2 size, float gap) {
  const float x = (box.from.x + box.to.x - size.x) / 2, y = (box.from.y + box.to.y - size.y) / 2;
  return {ImVec2(box.to.x + gap, y), ImVec2(box.from.x - gap - size.x, y), ImVec2(x, box.to.y + gap),
          ImVec2(x, box.from.y - gap - size.y)};
}

}  // namespace

ImVec2 place_beside(std::span<const ImVec2> points, ImVec2 size, const Area& within, float gap) {
  const auto inside = [&](const ImVec2& from) {
    return ImVec2(std::max(within.from.x, std::min(from.x, within.to.x - size.x)),
                  std::max(within.from.y, std::min(from.y, within.to.y - size.y)));
  };
  const ImVec2 second = points[std::min<std::size_t>(1, points.size() - 1)];
  const ImVec2 middle((points[0].x + second.x) / 2, (points[0].y + second.y) / 2);
  const float clear = gap * 0.9f;  // of the label: rounding is not to decide
  ImVec2 last = inside(points[0]);
  for (const Area& box : {Area{middle, middle}, box_of(points)})
    for (const ImVec2& wanted : corners_beside(box, size, gap)) {
      last = inside(wanted);
      const Area covered{{last.x - clear, last.y - clear}, {last.x + size.x + clear, last.y + size.y + clear}};
      if (is_free(covered, points)) return last;
    }
  return last;
}

}  // namespace heml::window
