#include <app/panel/icons.hpp>
#include <app/panel/theme.hpp>
#include <cmath>
#include <numbers>

namespace heml::panel {
namespace {

void triangle_right(ImDrawList& list, float left, float right, float middle, float half, ImU32 colour) {
  list.AddTriangleFilled({left, middle - half}, {right, middle}, {left, middle + half}, colour);
}

void bar(ImDrawList& list, float left, float right, float middle, float half, ImU32 colour) {
  list.AddRectFilled({left, middle - half}, {right, middle + half}, colour, (right - left) * 0.25f);
}

/// An arrow that goes up, over and back down to one side; direction: −1 to the left, 1 to the right.
void turned_arrow(ImDrawList& list, ImVec2 c, float half, ImU32 colour, float direction) {
  const auto at = [&](float x, float y) { return ImVec2(c.x + direction * x * half, c.y + y * half); };
  list.PathLineTo(at(-0.6f, 0.8f));
  list.PathBezierCubicCurveTo(at(-1.3f, 0.1f), at(-0.9f, -0.5f), at(0.2f, -0.35f), 16);
  list.PathStroke(colour, ImDrawFlags_None, half * 0.3f);
  const ImVec2 a = at(0.2f, -0.95f), b = at(1, -0.35f), d = at(0.2f, 0.25f);
  direction > 0 ? list.AddTriangleFilled(a, b, d, colour) : list.AddTriangleFilled(a, d, b, colour);
}

}  // namespace

void draw_play(ImDrawList& list, ImVec2 c, float half, ImU32 colour) {
  triangle_right(list, c.x - half * 0.7f, c.x + half, c.y, half, colour);
}

void draw_pause(ImDrawList& list, ImVec2 c, float half, ImU32 colour) {
  bar(list, c.x - half * 0.8f, c.x - half * 0.2f, c.y, half, colour);
  bar(list, c.x + half * 0.2f, c.x + half * 0.8f, c.y, half, colour);
}

void draw_step(ImDrawList& list, ImVec2 c, float half, ImU32 colour) {
  bar(list, c.x - half * 0.95f, c.x - half * 0.5f, c.y, half, colour);
  triangle_right(list, c.x - half * 0.3f, c.x + half, c.y, half, colour);
}

void draw_reset(ImDrawList& list, ImVec2 c, float half, ImU32 colour) {
  constexpr float pi = std::numbers::pi_v<float>, start = -0.25f * pi, end = 1.3f * pi;
  const float radius = half * 0.88f;
  list.PathArcTo(c, radius, start, end, 24);
  list.PathStroke(colour, ImDrawFlags_None, half * 0.3f);
  // The arrow head, at the start of the arc and pointing away from it.
  const ImVec2 tip(c.x + radius * std::cos(start), c.y + radius * std::sin(start));
  const ImVec2 along(std::sin(start), -std::cos(start)), across(std::cos(start), std::sin(start));
  const float s = half * 0.55f;
  list.AddTriangleFilled({tip.x + along.x * s * 1.3f, tip.y + along.y * s * 1.3f},
                         {tip.x - across.x * s, tip.y - across.y * s}, {tip.x + across.x * s, tip.y + across.y * s},
                         colour);
}

void draw_undo(ImDrawList& list, ImVec2 c, float half, ImU32 colour) { turned_arrow(list, c, half, colour, -1); }

void draw_redo(ImDrawList& list, ImVec2 c, float half, ImU32 colour) { turned_arrow(list, c, half, colour, 1); }

void draw_folder(ImDrawList& list, ImVec2 c, float half, ImU32 colour) {
  list.AddRectFilled({c.x - half, c.y - half * 0.75f}, {c.x - half * 0.05f, c.y}, colour, half * 0.2f);
  list.AddRectFilled({c.x - half, c.y - half * 0.45f}, {c.x + half, c.y + half * 0.75f}, colour, half * 0.2f);
}

void draw_cross(ImDrawList& list, ImVec2 c, float half, ImU32 colour) {
  const float h = half * 0.75f;
  list.AddLine({c.x - h, c.y - h}, {c.x + h, c.y + h}, colour, half * 0.3f);
  list.AddLine({c.x - h, c.y + h}, {c.x + h, c.y - h}, colour, half * 0.3f);
}

void draw_question(ImDrawList& list, ImVec2 c, float, ImU32 colour) {
  const ImVec2 size = ImGui::CalcTextSize("?");
  list.AddText({c.x - size.x / 2, c.y - size.y / 2}, colour, "?");
}

void draw_eye(ImDrawList& list, ImVec2 centre, float half, ImU32 colour, bool open) {
  const float wide = 1.5f * half, high = 1.3f * half, line = 0.26f * half;
  const ImVec2 left(centre.x - wide, centre.y), right(centre.x + wide, centre.y);
  list.PathLineTo(left);
  list.PathBezierQuadraticCurveTo({centre.x, centre.y + (open ? -1.6f : 1.2f) * high}, right, 16);
  if (open) list.PathBezierQuadraticCurveTo({centre.x, centre.y + 1.6f * high}, left, 16);
  list.PathStroke(colour, ImDrawFlags_None, line);
  if (open) list.AddCircleFilled(centre, 0.5f * half, colour, 16);
}

}  // namespace heml::panel
