#pragma once
// The six views along the axes.
#include <array>
#include <string_view>

namespace heml {

/// By the side of the body that faces the camera: front is +z, right is +x, top is +y.
enum class StandardView { front, back, left, right, top, bottom };

inline constexpr std::array<std::string_view, 6> standard_view_names{"front", "back", "left", "right", "top", "bottom"};

/// Of the camera, degrees: about the vertical, from +z towards +x; above the horizon.
struct ViewAngles {
  double azimuth = 0, elevation = 0;
};

constexpr ViewAngles angles_of(StandardView view) {
  switch (view) {
    case StandardView::front:
      return {0, 0};
    case StandardView::back:
      return {180, 0};
    case StandardView::left:
      return {-90, 0};
    case StandardView::right:
      return {90, 0};
    case StandardView::top:
      return {0, 90};
    case StandardView::bottom:
      return {0, -90};
  }
  return {};
}

constexpr StandardView opposite(StandardView view) { return static_cast<StandardView>(static_cast<int>(view) ^ 1); }

}  // namespace heml
