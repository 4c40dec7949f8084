#include <app/panel/hints.hpp>
#include <app/panel/keys.hpp>
#include <app/panel/theme.hpp>

namespace heml::panel {
namespace {

constexpr float hint_line = 1.5f, hint_gap = 0.5f, hint_pad = 0.8f;  // em
constexpr auto hint_separator = "  ·  ";

std::string with_key(Action action, const char* meaning) { return key_name(action) + " " + meaning; }

/// What the left button does with a tool, and the tool one may want next.
std::vector<std::string> tool_hints(const Situation& now) {
  switch (now.tool) {
    case Tool::grasper:
      return {"drag the tissue to pull it", "right-drag to turn", with_key(Action::select_scalpel, "to cut")};
    case Tool::scalpel:
      return {"draw across the tissue to cut", "right-drag to turn", with_key(Action::select_grasper, "to grasp"),
              with_key(Action::undo, "takes a cut back")};
    case Tool::scissors:
      return {"click to snip along the line, drag to snip on", "right-drag to turn",
              with_key(Action::select_grasper, "to grasp"), with_key(Action::undo, "takes snips back")};
    case Tool::cautery:
      return {"draw on the tissue to burn it", "right-drag to turn", with_key(Action::select_grasper, "to grasp"),
              with_key(Action::undo, "takes a burn back")};
    case Tool::pin:
      return {"click the tissue to pin it, a pin to remove it", "right-drag to turn",
              with_key(Action::select_grasper, "to grasp")};
    case Tool::probe:
      return {"press on the tissue and move", "right-drag to turn", with_key(Action::select_grasper, "to grasp")};
    case Tool::suture:
      if (now.suture_begun) return {"click the other end of the thread", "Esc forgets the first"};
      return {"click one end of the thread", "right-drag to turn", with_key(Action::select_grasper, "to grasp")};
    case Tool::measure:
      return {"click points: 2 distance, 3 angle", "right-drag to turn", with_key(Action::select_grasper, "to grasp")};
    case Tool::select:
      return {"click or drag to select", "Shift adds, Ctrl takes away", "right-drag to turn", "Esc forgets",
              with_key(Action::select_grasper, "to grasp")};
    case Tool::remover:
      return {"click the tissue to remove it", "right-drag to turn", with_key(Action::undo, "brings it back")};
  }
  return {};
}

std::vector<std::string> idle_hints(const Situation& now) {
  if (now.halted) return {with_key(Action::reset, "starts again"), with_key(Action::undo, "goes back")};
  if (now.past)
    return {"a past frame", with_key(Action::resume, "goes on from here"), "Left, Right: a frame", "Esc: live"};
  std::vector<std::string> hints = tool_hints(now);
  if (now.hides && (now.tool == Tool::scalpel || now.tool == Tool::scissors))
    hints.insert(hints.begin() + 1, "hidden tissue is cut too");
  if (now.hides && now.tool == Tool::cautery) hints.insert(hints.begin() + 1, "hidden tissue is burnt too");
  hints.insert(hints.begin(), now.device.begin(), now.device.end());
  if (now.paused) hints.insert(hints.begin(), "paused: Space runs");
  hints.push_back("H for help");
  return hints;
}

}  // namespace

std::vector<std::string> hints_for(const Situation& now) {
  switch (now.interaction) {
    case Interaction::none:
      return idle_hints(now);
    case Interaction::grasping:
      return {"move to pull", "let go to release", with_key(Action::leave_clamp, "leaves a clamp")};
    case Interaction::cutting:
      if (now.hides) return {"draw across the tissue", "hidden tissue is cut too", "Esc leaves"};
      return {"draw across the tissue", "Esc leaves"};
    case Interaction::snipping:
      return {"drag to snip on", "let go to close the jaws", "Esc leaves"};
    case Interaction::burning:
      return {"draw on along the tissue", "Esc leaves"};
    case Interaction::probing:
      return {"move along the tissue", "the wheel pushes deeper", "let go to withdraw"};
    case Interaction::selecting:
      return {"let go to select", "Esc leaves"};
    case Interaction::aiming:
      return {"drag to set direction and size", "Shift: along an axis", "Esc gives it back"};
    case Interaction::orbiting:
      return {"drag to turn", "Shift + right-drag to move", "wheel to zoom", with_key(Action::fit, "fits the body")};
    case Interaction::panning:
      return {"drag to move the view", "wheel to zoom", with_key(Action::fit, "fits the body")};
  }
  return {};
}

float hint_height() { return em(hint_line + hint_gap); }

void draw_hints(const Situation& situation, const Area& free) {
  const UseFont small(Font::small);
  const float room = free.width() - em(2 * hint_pad) - em(1);
  std::string text;
  for (const std::string& hint : hints_for(situation)) {
    const std::string longer = text.empty() ? hint : text + hint_separator + hint;
    if (!text.empty() && ImGui::CalcTextSize(longer.c_str()).x > room) break;
    text = longer;
  }
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const ImVec2 middle((free.from.x + free.to.x) / 2, free.to.y - em(hint_gap) - em(hint_line) / 2);
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.AddRectFilled({middle.x - size.x / 2 - em(hint_pad), middle.y - em(hint_line) / 2},
                     {middle.x + size.x / 2 + em(hint_pad), middle.y + em(hint_line) / 2}, colours::background,
                     em(hint_line) / 2);
  list.AddText({middle.x - size.x / 2, middle.y - size.y / 2}, colours::text, text.c_str());
}

}  // namespace heml::panel
