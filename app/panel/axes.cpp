#include <fmt/format.h>

#include <algorithm>
#include <app/panel/axes.hpp>
#include <app/panel/keys.hpp>
#include <array>

namespace heml::panel {
namespace {

constexpr float axes_arm = 2.1f, axis_end = 0.56f, axes_gap = 0.5f, axis_line = 0.16f;  // em
constexpr float is_seen = 0.9999f;  // cosine from which on the camera looks along an axis

constexpr ImGuiWindowFlags axes_flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                        ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing |
                                        ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoBackground;

struct AxisEnd {
  StandardView view;
  const char *name, *letter;  // no letter: the negative end
  ImU32 colour;
};
constexpr ImU32 x_colour = colours::rgba(0xe58a7f), y_colour = colours::rgba(0x8bbf5a),
                z_colour = colours::rgba(0x6f9be8);
constexpr AxisEnd axis_ends[] = {{StandardView::right, "+x", "X", x_colour}, {StandardView::left, "−x", "", x_colour},
                                 {StandardView::top, "+y", "Y", y_colour},   {StandardView::bottom, "−y", "", y_colour},
                                 {StandardView::front, "+z", "Z", z_colour}, {StandardView::back, "−z", "", z_colour}};

struct DrawnEnd {
  const AxisEnd* end;
  ImVec2 at;
  float depth;  // towards the eye
};

/// From back to front.
std::array<DrawnEnd, 6> drawn_ends(const render::Camera& camera, ImVec2 middle) {
  std::array<DrawnEnd, 6> drawn;
  for (std::size_t k = 0; k < drawn.size(); ++k) {
    const Vec3f along = render::direction_of(axis_ends[k].view);
    drawn[k] = {&axis_ends[k],
                {middle.x + em(axes_arm) * along.dot(camera.right()), middle.y - em(axes_arm) * along.dot(camera.up())},
                along.dot(camera.backward())};
  }
  std::sort(drawn.begin(), drawn.end(), [](const DrawnEnd& a, const DrawnEnd& b) { return a.depth < b.depth; });
  return drawn;
}

const DrawnEnd* end_at(const std::array<DrawnEnd, 6>& drawn, ImVec2 mouse) {
  for (auto end = drawn.rbegin(); end != drawn.rend(); ++end) {
    const float x = mouse.x - end->at.x, y = mouse.y - end->at.y;
    if (x * x + y * y < em(axis_end) * em(axis_end)) return &*end;
  }
  return nullptr;
}

void draw_end(const DrawnEnd& drawn, ImVec2 middle, bool hovered) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const AxisEnd& end = *drawn.end;
  const bool behind = drawn.depth < -0.3f;
  const ImU32 colour = (end.colour & 0x00ffffff) | (behind ? 0xa0000000 : 0xff000000);
  if (end.letter[0]) {
    list.AddLine(middle, drawn.at, colour, em(axis_line));
    list.AddCircleFilled(drawn.at, em(axis_end), colour, 24);
  } else {
    list.AddCircleFilled(drawn.at, em(axis_end), (end.colour & 0x00ffffff) | 0x48000000, 24);
    list.AddCircle(drawn.at, em(axis_end), colour, 24, em(0.09f));
  }
  if (hovered) list.AddCircle(drawn.at, em(axis_end), colours::text, 24, em(0.13f));
  const char* letters = end.letter[0] ? end.letter : hovered ? end.name : "";
  const UseFont small(Font::small);
  const ImVec2 size = ImGui::CalcTextSize(letters);
  list.AddText({drawn.at.x - size.x / 2, drawn.at.y - size.y / 2},
               end.letter[0] ? colours::rgba(0x101415) : colours::text, letters);
}

}  // namespace

Action look_at(StandardView view) {
  return static_cast<Action>(static_cast<int>(Action::look_front) + static_cast<int>(view));
}

StandardView view_after_click(StandardView end, const render::Camera& camera) {
  return render::direction_of(end).dot(camera.backward()) > is_seen ? opposite(end) : end;
}

void draw_axes(Rows& rows, const render::Camera& camera, const Area& free, float top, std::vector<Action>& pressed,
               Area& place) {
  const float side = 2 * em(axes_arm + axis_end) + em(0.3f);
  place.to = {free.to.x - em(axes_gap), top + em(axes_gap) + side};
  place.from = {place.to.x - side, place.to.y - side};
  const ImVec2 middle((place.from.x + place.to.x) / 2, (place.from.y + place.to.y) / 2);
  ImGui::SetNextWindowPos(place.from);
  ImGui::SetNextWindowSize({side, side});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  const bool shown = ImGui::Begin("axes", nullptr, axes_flags);
  ImGui::PopStyleVar();
  if (shown) {
    const bool clicked = ImGui::InvisibleButton("ends", {side, side});
    const auto drawn = drawn_ends(camera, middle);
    const DrawnEnd* under = ImGui::IsItemHovered() ? end_at(drawn, ImGui::GetIO().MousePos) : nullptr;
    ImGui::GetWindowDrawList()->AddCircleFilled(middle, side / 2, under ? 0x30ffffff : 0x14ffffff, 48);
    for (const DrawnEnd& end : drawn) draw_end(end, middle, &end == under);
    if (under) {
      const StandardView view = view_after_click(under->end->view, camera);
      const auto name = standard_view_names[static_cast<std::size_t>(view)];
      rows.explain({fmt::format("Axis {}", under->end->name),
                    fmt::format("Axis {}; a click looks from the {}. Keys: numpad 1, 3, 7, with Ctrl the opposite; 5 "
                                "switches perspective.",
                                under->end->name, name)});
      if (clicked) pressed.push_back(look_at(view));
    }
  }
  ImGui::End();
}

}  // namespace heml::panel
