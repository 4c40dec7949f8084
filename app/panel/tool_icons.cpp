// Icons of tools, and of what is done to the picture and the scene: lines and areas in units of the half size.
#include <app/panel/icons.hpp>
#include <cmath>
#include <initializer_list>
#include <numbers>

namespace heml::panel {
namespace {

/// Draws in units of an icon's half size, from its centre.
class Pen {
 public:
  Pen(ImDrawList& list, ImVec2 centre, float half, ImU32 colour)
      : list_(list), centre_(centre), half_(half), colour_(colour) {}

  void line(std::initializer_list<ImVec2> points, float width = 0.24f, bool closed = false) const {
    for (const ImVec2& point : points) list_.PathLineTo(at(point));
    list_.PathStroke(colour_, closed ? ImDrawFlags_Closed : ImDrawFlags_None, width * half_);
  }
  void curve(ImVec2 from, ImVec2 a, ImVec2 b, ImVec2 to, float width = 0.24f) const {
    list_.PathLineTo(at(from));
    list_.PathBezierCubicCurveTo(at(a), at(b), at(to), 12);
    list_.PathStroke(colour_, ImDrawFlags_None, width * half_);
  }
  void arc(ImVec2 middle, float radius, float from, float to, float width = 0.24f) const {
    constexpr float pi = std::numbers::pi_v<float>;
    list_.PathArcTo(at(middle), radius * half_, from * pi, to * pi, 16);
    list_.PathStroke(colour_, ImDrawFlags_None, width * half_);
  }
  void area(std::initializer_list<ImVec2> points) const {
    for (const ImVec2& point : points) list_.PathLineTo(at(point));
    list_.PathFillConvex(colour_);
  }
  void disc(ImVec2 middle, float radius) const { list_.AddCircleFilled(at(middle), radius * half_, colour_, 20); }
  void box(ImVec2 from, ImVec2 to, float rounding) const {
    list_.AddRectFilled(at(from), at(to), colour_, rounding * half_);
  }
  void frame(ImVec2 from, ImVec2 to, float rounding, float width = 0.2f) const {
    list_.AddRect(at(from), at(to), colour_, rounding * half_, ImDrawFlags_None, width * half_);
  }

 private:
  ImVec2 at(ImVec2 point) const { return {centre_.x + point.x * half_, centre_.y + point.y * half_}; }

  ImDrawList& list_;
  ImVec2 centre_;
  float half_;
  ImU32 colour_;
};

}  // namespace

void draw_forceps(ImDrawList& list, ImVec2 centre, float half, ImU32 colour) {
  const Pen pen(list, centre, half, colour);
  pen.curve({0.05f, -1}, {-0.75f, -0.5f}, {-0.6f, 0.4f}, {-0.12f, 1}, 0.27f);
  pen.curve({-0.05f, -1}, {0.75f, -0.5f}, {0.6f, 0.4f}, {0.12f, 1}, 0.27f);
}

void draw_scalpel(ImDrawList& list, ImVec2 centre, float half, ImU32 colour) {
  const Pen pen(list, centre, half, colour);
  pen.line({{0.95f, -0.95f}, {0.15f, -0.1f}}, 0.36f);
  pen.area({{-0.15f, -0.12f}, {0.3f, 0.22f}, {-0.2f, 0.75f}, {-1, 1}});
}

void draw_scissors(ImDrawList& list, ImVec2 centre, float half, ImU32 colour) {
  const Pen pen(list, centre, half, colour);
  pen.line({{-0.5f, -1}, {0.42f, 0.42f}}, 0.22f);
  pen.line({{0.5f, -1}, {-0.42f, 0.42f}}, 0.22f);
  pen.arc({-0.55f, 0.65f}, 0.3f, 0, 2, 0.2f);
  pen.arc({0.55f, 0.65f}, 0.3f, 0, 2, 0.2f);
}

void draw_electrode(ImDrawList& list, ImVec2 centre, float half, ImU32 colour) {
  const Pen pen(list, centre, half, colour);
  pen.line({{1, -1}, {0.3f, -0.3f}}, 0.42f);
  pen.line({{0.3f, -0.3f}, {-0.35f, 0.35f}}, 0.16f);
  pen.line({{-0.62f, 0.1f}, {-0.95f, -0.2f}}, 0.15f);
  pen.line({{-0.65f, 0.65f}, {-1, 1}}, 0.15f);
  pen.line({{-0.1f, 0.62f}, {0.2f, 0.95f}}, 0.15f);
}

void draw_pin(ImDrawList& list, ImVec2 centre, float half, ImU32 colour) {
  const Pen pen(list, centre, half, colour);
  pen.disc({0.4f, -0.5f}, 0.5f);
  pen.line({{0.3f, -0.4f}, {-0.75f, 1}}, 0.2f);
}

void draw_probe(ImDrawList& list, ImVec2 centre, float half, ImU32 colour) {
  const Pen pen(list, centre, half, colour);
  pen.line({{0.75f, -1}, {0.05f, 0.1f}}, 0.34f);
  pen.disc({0, 0.15f}, 0.33f);
  pen.curve({-1, 0.35f}, {-0.5f, 0.35f}, {-0.45f, 0.8f}, {0, 0.8f}, 0.2f);
  pen.curve({0, 0.8f}, {0.45f, 0.8f}, {0.5f, 0.35f}, {1, 0.35f}, 0.2f);
}

void draw_needle(ImDrawList& list, ImVec2 centre, float half, ImU32 colour) {
  const Pen pen(list, centre, half, colour);
  pen.arc({-0.1f, 0}, 0.82f, -0.02f, 1.05f, 0.26f);
  pen.curve({0.72f, 0}, {0.6f, -0.75f}, {0.1f, -0.2f}, {0.25f, -0.95f}, 0.14f);
}

void draw_eraser(ImDrawList& list, ImVec2 centre, float half, ImU32 colour) {
  const Pen pen(list, centre, half, colour);
  pen.line({{-0.35f, 0.75f}, {-0.95f, 0.15f}, {0.15f, -0.95f}, {0.95f, -0.15f}, {0.05f, 0.75f}}, 0.2f, true);
  pen.area({{-0.35f, 0.75f}, {-0.95f, 0.15f}, {-0.45f, -0.35f}, {0.35f, 0.45f}, {0.05f, 0.75f}});
  pen.line({{0.05f, 0.85f}, {0.95f, 0.85f}}, 0.2f);
}

void draw_ruler(ImDrawList& list, ImVec2 centre, float half, ImU32 colour) {
  const Pen pen(list, centre, half, colour);
  pen.line({{-1.1f, 0.5f}, {0.5f, -1.1f}, {1.1f, -0.5f}, {-0.5f, 1.1f}}, 0.2f, true);
  for (const float k : {-0.4f, 0.0f, 0.4f}) pen.line({{k - 0.3f, -k - 0.3f}, {k, -k}}, 0.16f);
}

void draw_marquee(ImDrawList& list, ImVec2 centre, float half, ImU32 colour) {
  const Pen pen(list, centre, half, colour);
  for (const float side : {-0.9f, 0.9f})
    for (const float from : {-0.9f, -0.2f, 0.5f}) {
      pen.line({{from, side}, {from + 0.4f, side}}, 0.2f);
      pen.line({{side, from}, {side, from + 0.4f}}, 0.2f);
    }
  pen.disc({-0.3f, 0.15f}, 0.24f);
  pen.disc({0.3f, -0.25f}, 0.24f);
}

void draw_table(ImDrawList& list, ImVec2 centre, float half, ImU32 colour) {
  const Pen pen(list, centre, half, colour);
  pen.disc({0, -0.35f}, 0.46f);
  pen.line({{-1, 0.3f}, {1, 0.3f}}, 0.26f);
  pen.line({{-0.65f, 0.3f}, {-0.65f, 0.95f}}, 0.2f);
  pen.line({{0.65f, 0.3f}, {0.65f, 0.95f}}, 0.2f);
}

void draw_frame(ImDrawList& list, ImVec2 centre, float half, ImU32 colour) {
  const Pen pen(list, centre, half, colour);
  for (const float x : {-1.0f, 1.0f})
    for (const float y : {-1.0f, 1.0f})
      pen.line({{0.9f * x, 0.35f * y}, {0.9f * x, 0.85f * y}, {0.4f * x, 0.85f * y}}, 0.2f);
  pen.disc({0, 0}, 0.34f);
}

void draw_camera(ImDrawList& list, ImVec2 centre, float half, ImU32 colour) {
  const Pen pen(list, centre, half, colour);
  pen.frame({-1, -0.55f}, {1, 0.8f}, 0.25f);
  pen.box({-0.42f, -0.85f}, {0.42f, -0.5f}, 0.1f);
  pen.disc({0, 0.12f}, 0.36f);
}

void draw_film(ImDrawList& list, ImVec2 centre, float half, ImU32 colour) {
  const Pen pen(list, centre, half, colour);
  pen.box({-1, -0.6f}, {0.35f, 0.6f}, 0.2f);
  pen.area({{0.48f, -0.05f}, {1, -0.55f}, {1, 0.55f}, {0.48f, 0.05f}});
}

void draw_tray(ImDrawList& list, ImVec2 centre, float half, ImU32 colour) {
  const Pen pen(list, centre, half, colour);
  pen.line({{0, -0.95f}, {0, -0.1f}}, 0.24f);
  pen.area({{-0.5f, -0.25f}, {0.5f, -0.25f}, {0, 0.4f}});
  pen.line({{-0.9f, 0.25f}, {-0.9f, 0.85f}, {0.9f, 0.85f}, {0.9f, 0.25f}}, 0.22f);
}

}  // namespace heml::panel
