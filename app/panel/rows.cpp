#include <fmt/format.h>
#include <imgui_internal.h>  // TempInputIsActive, ClosePopupToLevel

#include <algorithm>
#include <app/panel/decimal_comma.hpp>
#include <app/panel/rows.hpp>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

namespace heml::panel {
namespace {

constexpr float label_width = 6.4f;  // em

/// Position of a value on a slider, 0 to 1.
float place_of(double value, const SliderRange& range) {
  const auto scaled = [&](double v) { return range.logarithmic ? std::log(v) : v; };
  const double place = (scaled(value) - scaled(range.low)) / (scaled(range.high) - scaled(range.low));
  return static_cast<float>(std::clamp(place, 0.0, 1.0));
}

/// A track that is filled up to the value, under a slider drawn without background.
void draw_track(float place) {
  const ImVec2 from = ImGui::GetCursorScreenPos();
  const ImVec2 to(from.x + ImGui::CalcItemWidth(), from.y + ImGui::GetFrameHeight());
  const float grab = ImGui::GetStyle().GrabMinSize, rounding = ImGui::GetStyle().FrameRounding;
  const float filled = from.x + 2 + grab / 2 + place * (to.x - from.x - 4 - grab);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const bool hovered =
      ImGui::IsMouseHoveringRect(from, to) && ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem);
  list.AddRectFilled(from, to, hovered ? colours::track_hovered : colours::track, rounding);
  if (filled > from.x + rounding)
    list.AddRectFilled(from, {filled, to.y}, colours::fill, rounding, ImDrawFlags_RoundCornersLeft);
}

std::string formatted(const char* format, double value) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

/// A small arrow head that points down, or to the right.
void draw_chevron(ImVec2 at, bool down, ImU32 colour) {
  const float half = em(0.24f), depth = half * 0.55f;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (down) {
    list.PathLineTo({at.x - half, at.y - depth});
    list.PathLineTo({at.x, at.y + depth});
    list.PathLineTo({at.x + half, at.y - depth});
  } else {
    list.PathLineTo({at.x - depth, at.y - half});
    list.PathLineTo({at.x + depth, at.y});
    list.PathLineTo({at.x - depth, at.y + half});
  }
  list.PathStroke(colour, ImDrawFlags_None, em(0.11f));
}

}  // namespace

std::string capitalised(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

std::string elided(const std::string& text, float width) {
  if (ImGui::CalcTextSize(text.c_str()).x <= width) return text;
  std::string result = text;
  while (!result.empty() && ImGui::CalcTextSize((result + "…").c_str()).x > width) {
    while (!result.empty() && (static_cast<unsigned char>(result.back()) & 0xc0) == 0x80) result.pop_back();
    if (!result.empty()) result.pop_back();
  }
  return result + "…";
}

void text_at_right(const std::string& text, ImU32 colour) {
  const float width = ImGui::CalcTextSize(text.c_str()).x;
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(0.0f, ImGui::GetContentRegionAvail().x - width));
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopStyleColor();
}

/// A name and its control are one row, explained by the longer hint.
void Rows::list(const Label& label) {
  const bool is_same =
      !listed_.empty() && listed_.back().section == section_ && listed_.back().label.text == label.text;
  if (!is_same) return listed_.push_back({section_, label});
  if (label.hint.size() > listed_.back().label.hint.size()) listed_.back().label.hint = label.hint;
}

void Rows::explain(const Label& label) {
  if (lists_) list(label);
  if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  hovered_ = label.text;
  if (label.hint.empty() || ImGui::IsAnyMouseDown()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(em(19));
  ImGui::TextUnformatted(label.hint.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

void Rows::begin(const Label& label) {
  ImGui::AlignTextToFramePadding();
  ImGui::PushStyleColor(ImGuiCol_Text, colours::muted);
  const float left = ImGui::GetCursorPosX();
  const float room = em(label_width) - ImGui::GetStyle().ItemSpacing.x;
  {
    std::optional<UseFont> small;
    if (ImGui::CalcTextSize(label.text.c_str()).x > room) small.emplace(Font::small);
    ImGui::TextUnformatted(elided(label.text, room).c_str());
  }
  ImGui::PopStyleColor();
  explain(label);
  ImGui::SameLine(left + em(label_width));
  ImGui::SetNextItemWidth(-std::max(1.0f, std::exchange(room_, 0.0f)));
}

bool Rows::section(const char* title, bool open_at_first) {
  const auto known = sections_.find(title);
  const bool was_open = known == sections_.end() ? open_at_first : known->second;
  bool open = was_open;
  if (fold(title, open) != was_open) sections_[title] = open;
  return open;
}

bool Rows::fold(const char* title, bool& open) {
  section_ = title;
  ImGui::SetCursorPosY(ImGui::GetCursorPosY() + em(0.1f));
  const ImVec2 from = ImGui::GetCursorScreenPos(), size(ImGui::GetContentRegionAvail().x, em(1.45f));
  if (ImGui::InvisibleButton(title, size)) open = !open;
  const bool hovered = ImGui::IsItemHovered();
  if (hovered) hovered_ = title;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddText({from.x, from.y + (size.y - ImGui::GetFontSize()) / 2}, hovered ? colours::text : colours::accent,
               title);
  draw_chevron({from.x + size.x - em(0.8f), from.y + size.y / 2}, open, hovered ? colours::text : colours::faint);
  return open;
}

bool Rows::slider(const Label& label, double& value, const SliderRange& asked) {
  SliderRange range = asked;
  range.low = std::min(range.low, value);
  range.high = std::max(range.high, value);
  range.logarithmic = range.logarithmic && range.low > 0;
  begin(label);
  draw_track(place_of(value, range));
  for (const auto which : {ImGuiCol_FrameBg, ImGuiCol_FrameBgHovered, ImGuiCol_FrameBgActive})
    ImGui::PushStyleColor(which, 0);
  const ImGuiSliderFlags flags = range.logarithmic ? ImGuiSliderFlags_Logarithmic : 0;
  double edited = value;
  ImGui::PushID(label.text.c_str());
  const ImGuiID id = ImGui::GetID("##value");
  bool changed = false;
  {
    const CommaAsPoint commas(ImGui::GetActiveID() == id);
    changed =
        ImGui::SliderScalar("##value", ImGuiDataType_Double, &edited, &range.low, &range.high, range.format, flags);
  }
  if (is_typing(id, ImGui::TempInputIsActive(id), changed, edited)) changed = false;
  ImGui::PopID();
  ImGui::PopStyleColor(3);
  explain(
      {label.text, fmt::format("{}\n\n{} to {}. Ctrl+click to type a number: Enter sets it, Esc keeps the old one.",
                               label.hint, formatted(range.format, range.low), formatted(range.format, range.high))});
  // Unit conversion there and back changes the last bits: not an edit.
  const bool same = std::abs(edited - value) <= 1e-9 * std::max(std::abs(edited), std::abs(value));
  if (!changed || same || std::isnan(edited)) return false;
  const double before = std::exchange(value, limited(label, edited, range));
  return value != before;
}

/// A typed number, or the end of the range that it is beyond, which is said.
double Rows::limited(const Label& label, double typed, const SliderRange& range) {
  const double taken = std::clamp(typed, range.low, range.high);
  if (formatted(range.format, taken) != formatted(range.format, typed))
    notice_ = fmt::format("{}: {} is not between {} and {}; it is {} now.", label.text, formatted(range.format, typed),
                          formatted(range.format, range.low), formatted(range.format, range.high),
                          formatted(range.format, taken));
  return taken;
}

bool Rows::number(const Label& label, double& value, const SliderRange& range) {
  begin(label);
  const std::string name = "##" + label.text;
  double edited = value;
  const ImGuiID id = ImGui::GetID(name.c_str());
  const CommaAsPoint commas(ImGui::GetActiveID() == id);
  bool changed = ImGui::InputScalar(name.c_str(), ImGuiDataType_Double, &edited, nullptr, nullptr, range.format,
                                    ImGuiInputTextFlags_CharsScientific);
  const bool active = ImGui::IsItemActive();
  explain(label);
  if (is_typing(id, active, changed, edited) || !changed) return false;
  if (std::isnan(edited) || formatted(range.format, edited) == formatted(range.format, value)) return false;
  const double before = std::exchange(value, limited(label, edited, range));
  return value != before;
}

bool Rows::vector(const Label& label, Vec3& value, const SliderRange& range) {
  begin(label);
  const std::string name = "##" + label.text;
  Vec3 edited = value;
  const CommaAsPoint commas(active_vector_ == label.text);
  if (ImGui::InputScalarN(name.c_str(), ImGuiDataType_Double, edited.data(), 3, nullptr, nullptr, range.format,
                          ImGuiInputTextFlags_CharsScientific)) {
    typed_vector_ = edited.array().isNaN().select(0.0, edited);
    value = typed_vector_.cwiseMax(range.low).cwiseMin(range.high);
  }
  const bool done = ImGui::IsItemDeactivatedAfterEdit();
  if (ImGui::IsItemActive())
    active_vector_ = label.text;
  else if (active_vector_ == label.text)
    active_vector_.clear();
  explain({label.text, label.hint + "\n\nClick one to type it."});
  if (done)
    for (const double typed : typed_vector_) limited(label, typed, range);
  return done;
}

void Rows::text(const Label& label, std::string& value, std::size_t most) {
  begin(label);
  std::vector<char> typed(value.begin(), value.end());
  typed.resize(most + 1);
  if (ImGui::InputText(("##" + label.text).c_str(), typed.data(), typed.size())) value = typed.data();
  explain(label);
}

/// ImGui changes a typed number at each keystroke. Here the last one counts when the typing ends, and none after Esc.
/// active: whether the control takes letters now. Returns whether a number is being typed; sets `changed` and `edited`
/// where one has been.
bool Rows::is_typing(ImGuiID id, bool active, bool& changed, double& edited) {
  if (active) {
    if (changed || !typed_ || typed_->id != id) typed_ = Typed{id, changed, edited};
    return true;
  }
  if (!typed_ || typed_->id != id) return false;
  const Typed typed = *std::exchange(typed_, std::nullopt);
  changed = typed.changed && !ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
  edited = typed.value;
  return false;
}

bool Rows::choice(const Label& label, int& index, std::span<const std::string> names,
                  std::span<const std::string> hints) {
  begin(label);
  ImGui::PushID(label.text.c_str());
  bool changed = false;
  const float room = ImGui::CalcItemWidth() - em(1.3f) - 2 * ImGui::GetStyle().FramePadding.x;
  const std::string shown = index >= 0 && index < std::ssize(names) ? elided(names[index], room) : "–";
  const bool open =
      ImGui::BeginCombo("##choice", shown.c_str(), ImGuiComboFlags_NoArrowButton | ImGuiComboFlags_HeightLarge);
  explain(label);
  if (!open) {
    const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
    draw_chevron({to.x - em(0.8f), (from.y + to.y) / 2}, true, colours::muted);
  }
  if (open) {
    int chosen = index;
    for (int i = 0; i < std::ssize(names); ++i) {
      if (ImGui::Selectable(names[i].c_str(), i == index)) chosen = i;
      explain({names[i], i < std::ssize(hints) ? hints[i] : std::string()});
    }
    changed = chosen != index;
    index = chosen;
    ImGui::EndCombo();
  }
  ImGui::PopID();
  return changed;
}

bool Rows::close_choices() {
  if (!ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup)) return false;
  ImGui::ClosePopupToLevel(0, true);
  return true;
}

bool Rows::check(const Label& label, bool& value) {
  ImGui::PushStyleVar(ImGuiStyleVar_FrameBorderSize, 1);  // else an empty box hardly shows on a light background
  ImGui::PushStyleColor(ImGuiCol_Border, colours::muted);
  const bool changed = ImGui::Checkbox(label.text.c_str(), &value);
  ImGui::PopStyleColor();
  ImGui::PopStyleVar();
  explain(label);
  return changed;
}

void Rows::value(const Label& label, const std::string& shown, ImU32 dot, ImU32 colour) {
  const UseFont small(Font::small);
  ImGui::BeginGroup();
  if (dot) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float height = ImGui::GetTextLineHeight();
    ImGui::GetWindowDrawList()->AddCircleFilled({at.x + height * 0.3f, at.y + height * 0.52f}, height * 0.27f, dot, 12);
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + height * 0.95f);
  }
  ImGui::PushStyleColor(ImGuiCol_Text, colours::muted);
  ImGui::TextUnformatted(label.text.c_str());
  ImGui::PopStyleColor();
  ImGui::SameLine();
  text_at_right(shown, colour);
  ImGui::EndGroup();
  explain(label);
}

bool Rows::folding_value(const Label& label, const std::string& shown, bool open_at_first) {
  bool* open = ImGui::GetStateStorage()->GetBoolRef(ImGui::GetID(label.text.c_str()), open_at_first);
  const ImVec2 from = ImGui::GetCursorScreenPos();
  value(label, shown);
  if (ImGui::IsItemClicked()) *open = !*open;
  const ImVec2 size = ImGui::GetItemRectSize();
  const UseFont small(Font::small);
  const float name = ImGui::CalcTextSize(label.text.c_str()).x;
  draw_chevron({from.x + name + em(0.7f), from.y + size.y / 2}, *open,
               ImGui::IsItemHovered() ? colours::text : colours::faint);
  return *open;
}

bool Rows::button(const Label& label, float width) {
  const bool pressed = ImGui::Button(label.text.c_str(), {width, 0});
  explain(label);
  return pressed;
}

bool Rows::icon_button(const Label& label, float size, bool strong, const Icon& icon) {
  const ImVec2 from = ImGui::GetCursorScreenPos();
  const bool pressed = ImGui::InvisibleButton(label.text.c_str(), {size, size});
  const bool hovered = ImGui::IsItemHovered(), held = ImGui::IsItemActive();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 calm = strong ? colours::fill : colours::track;
  const ImU32 warm = strong ? colours::strong_hovered : colours::control_hovered;
  list.AddRectFilled(from, {from.x + size, from.y + size}, hovered || held ? warm : calm,
                     ImGui::GetStyle().FrameRounding * 1.4f);
  icon(list, {from.x + size / 2, from.y + size / 2}, size * 0.24f, held ? colours::accent : colours::text);
  explain(label);
  return pressed;
}

}  // namespace heml::panel
