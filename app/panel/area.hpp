#pragma once
// Rectangles and insets of the image, pixels.
#include <imgui.h>

namespace heml::panel {

/// Pixels from the top left corner.
struct Area {
  ImVec2 from, to;
  bool contains(float x, float y) const { return x >= from.x && x < to.x && y >= from.y && y < to.y; }
  float width() const { return to.x - from.x; }
  float height() const { return to.y - from.y; }
};

/// Widths covered by the panel at the left and right edge of the image, pixels.
struct Insets {
  float left = 0, right = 0;
  bool operator==(const Insets&) const = default;
};

}  // namespace heml::panel
