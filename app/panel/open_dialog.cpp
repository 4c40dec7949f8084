#include <algorithm>
#include <app/panel/icons.hpp>
#include <app/panel/open_dialog.hpp>
#include <app/panel/search.hpp>
#include <string_view>
#include <utility>

namespace heml::panel {
namespace {

constexpr float widest = 78, wide_from = 58, side_column = 0.4f, cell_width = 10.5f;  // em; side_column: of the width

}  // namespace

void OpenDialog::open() {
  open_ = just_opened_ = true;
  search_[0] = '\0';
  selected_ = -1;
  shown_.clear();
}

void OpenDialog::set_choices(OpenChoices choices) {
  choices_ = std::move(choices);
  need_letters(choices_.folder.string());
  for (const auto* list : {&choices_.scenes, &choices_.extreme, &choices_.recent, &choices_.files})
    for (const OpenChoice& choice : *list) {
      need_letters(choice.title);
      need_letters(choice.description);
    }
}

bool OpenDialog::close() { return std::exchange(open_, false); }

void OpenDialog::draw(Rows& rows, ImVec2 picture, PanelActions& out) {
  if (!open_) return;
  shown_.clear();
  const ImVec2 size(std::min(picture.x - em(1.4f), em(widest)), picture.y - em(1.4f));
  ImGui::SetNextWindowPos({picture.x / 2, picture.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSize(size);
  ImGui::SetNextWindowBgAlpha(0.98f);
  if (just_opened_) ImGui::SetNextWindowFocus();
  ImGui::Begin("open", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoNav |
                   ImGuiWindowFlags_NoScrollWithMouse);
  draw_head(rows);
  const float width = ImGui::GetContentRegionAvail().x;
  const bool wide = size.x > em(wide_from);
  ImGui::BeginChild("scenes", {wide ? (1 - side_column) * width : width, 0}, false, ImGuiWindowFlags_NoNav);
  draw_scenes(rows, out);
  if (wide) {
    ImGui::EndChild();
    ImGui::SameLine(0, em(1));
    ImGui::BeginChild("files", {0, 0}, false, ImGuiWindowFlags_NoNav);
  }
  draw_files(rows, out);
  if (search_[0] && search_[0] != '/' && shown_.empty())
    ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(colours::muted), "Nothing here has these words.");
  ImGui::EndChild();
  if (ImGui::IsMouseClicked(ImGuiMouseButton_Left) && !just_opened_ &&
      !ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows | ImGuiHoveredFlags_AllowWhenBlockedByActiveItem))
    open_ = false;
  ImGui::End();
  just_opened_ = false;
}

void OpenDialog::draw_head(Rows& rows) {
  {
    const UseFont large(Font::title);
    ImGui::TextUnformatted("Open");
  }
  ImGui::SameLine(em(5));
  const float close_size = ImGui::GetFrameHeight();
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - close_size - em(0.7f));
  if (!ImGui::IsAnyItemActive()) ImGui::SetKeyboardFocusHere();  // typing filters at once
  if (ImGui::InputTextWithHint("##search", "Search", search_, sizeof search_)) {
    selected_ = search_[0] ? 0 : -1;
    need_letters(search_);
  }
  rows.explain(
      {"Search",
       "Shows entries with all these words in name, description or path. Up and Down select, Enter opens, Esc closes. "
       "A path that begins with / opens that file."});
  ImGui::SameLine(0, em(0.7f));
  if (rows.icon_button({"Close", "Closes this dialog (Esc)."}, close_size, false, draw_cross)) open_ = false;
  ImGui::Dummy({0, em(0.2f)});
}

void OpenDialog::draw_scenes(Rows& rows, PanelActions& out) {
  draw_group(rows, "Scenes", choices_.scenes, Shape::cell, out);
  draw_group(rows, "Stiff and extreme cases", choices_.extreme, Shape::line, out);
}

void OpenDialog::draw_files(Rows& rows, PanelActions& out) {
  draw_group(rows, "Recent", choices_.recent, Shape::line, out);
  if (choices_.folder.empty()) return;
  draw_group(rows, "Files in " + choices_.folder.string(), choices_.files, Shape::line, out);
  if (choices_.problem.empty()) return;
  ImGui::PushStyleColor(ImGuiCol_Text, colours::warning);
  ImGui::TextWrapped("%s", choices_.problem.c_str());
  ImGui::PopStyleColor();
}

void OpenDialog::draw_group(Rows& rows, const std::string& heading, const std::vector<OpenChoice>& choices, Shape shape,
                            PanelActions& out) {
  if (std::none_of(choices.begin(), choices.end(), [&](const OpenChoice& choice) { return matches(choice); })) return;
  const float room = ImGui::GetContentRegionAvail().x;
  ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(colours::accent), "%s", elided(heading, room).c_str());
  rows.explain({heading, ""});
  const float gap = em(0.7f);
  const int columns = std::max(1, static_cast<int>((room - em(0.8f) + gap) / (em(cell_width) + gap)));
  const float width = (room - em(0.8f) + gap) / static_cast<float>(columns) - gap;
  int column = 0;
  for (const OpenChoice& choice : choices) {
    if (!matches(choice)) continue;
    const bool selected = std::ssize(shown_) == selected_;
    shown_.push_back(&choice);
    ImGui::PushID(&choice);
    if (shape == Shape::cell && column > 0) ImGui::SameLine(0, gap);
    column = (column + 1) % columns;
    if (shape == Shape::cell ? draw_cell(rows, choice, width, selected) : draw_line(rows, choice, selected))
      activate(choice, out);
    if (selected && std::exchange(selection_moved_, false)) ImGui::SetScrollHereY();
    ImGui::PopID();
  }
  ImGui::Dummy({0, em(0.3f)});
}

bool OpenDialog::draw_cell(Rows& rows, const OpenChoice& choice, float width, bool selected) {
  const float height = std::round(width * 9 / 16), line = ImGui::GetTextLineHeight();
  const ImVec2 from = ImGui::GetCursorScreenPos();
  const bool chosen = ImGui::InvisibleButton("cell", {width, height + line + em(0.35f)});
  const bool warm = selected || ImGui::IsItemHovered();
  rows.explain({choice.title, choice.title + "\n\n" + choice.description});
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 to(from.x + width, from.y + height);
  const float rounding = ImGui::GetStyle().FrameRounding;
  if (choice.thumbnail)
    list.AddImageRounded(choice.thumbnail, from, to, {0, 0}, {1, 1}, IM_COL32_WHITE, rounding);
  else
    list.AddRectFilled(from, to, colours::track, rounding);
  if (warm) list.AddRect(from, to, colours::accent, rounding, ImDrawFlags_None, em(0.13f));
  list.AddText({from.x, to.y + em(0.1f)}, warm ? colours::text : colours::muted, elided(choice.title, width).c_str());
  return chosen;
}

bool OpenDialog::draw_line(Rows& rows, const OpenChoice& choice, bool selected) {
  const UseFont small(Font::small);
  const float width = ImGui::GetContentRegionAvail().x - em(0.8f), line = ImGui::GetTextLineHeight();
  const ImVec2 from = ImGui::GetCursorScreenPos(), to(from.x + width, from.y + line + em(0.3f));
  const bool chosen = ImGui::InvisibleButton("line", {width, to.y - from.y});
  const bool warm = choice.exists && (selected || ImGui::IsItemHovered());
  const std::string gone = choice.exists ? "" : "\n\nThe file no longer exists.";
  rows.explain({choice.title, choice.title + "\n\n" + choice.description + gone});
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (warm)
    list.AddRectFilled({from.x - em(0.3f), from.y}, to, colours::track_hovered, ImGui::GetStyle().FrameRounding);
  const std::string title = elided(choice.title, 0.62f * width);
  const float used = ImGui::CalcTextSize(title.c_str()).x + em(0.8f), top = from.y + em(0.15f);
  const std::string description = elided(choice.exists ? choice.description : "missing", width - used - em(0.3f));
  list.AddText({from.x, top}, choice.exists ? colours::text : colours::faint, title.c_str());
  list.AddText({to.x - em(0.3f) - ImGui::CalcTextSize(description.c_str()).x, top},
               choice.exists ? colours::muted : colours::faint, description.c_str());
  return chosen;
}

/// Whether title, description and path contain all words of the search text.
bool OpenDialog::matches(const OpenChoice& choice) const {
  return has_words(choice.title + ' ' + choice.description + ' ' + choice.path.string(), search_);
}

void OpenDialog::activate(const OpenChoice& choice, PanelActions& out) {
  if (!choice.exists) return;
  if (choice.is_folder) {
    out.list_folder = choice.path;
    search_[0] = '\0';
    selected_ = -1;
    return;
  }
  out.open = choice.path;
  open_ = false;
}

void OpenDialog::select(int direction) {
  selected_ = std::clamp(selected_ + direction, 0, std::max(0, static_cast<int>(shown_.size()) - 1));
  selection_moved_ = true;
}

void OpenDialog::open_selected(PanelActions& out) {
  if (search_[0] == '/')
    activate({search_, search_, "", nullptr, std::string_view(search_).ends_with('/')}, out);
  else if (selected_ >= 0 && selected_ < std::ssize(shown_))
    activate(*shown_[static_cast<std::size_t>(selected_)], out);
}

}  // namespace heml::panel
