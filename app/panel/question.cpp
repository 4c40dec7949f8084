#include <algorithm>
#include <app/panel/question.hpp>
#include <utility>

namespace heml::panel {

void Question::ask(std::string title, std::string text, std::vector<std::string> answers) {
  need_letters(title + text);
  title_ = std::move(title);
  text_ = std::move(text);
  answers_ = std::move(answers);
  selected_ = 0;
  chosen_.reset();
}

void Question::press(Action action) {
  const std::size_t count = answers_.size();
  if (action == Action::seek_previous || action == Action::select_previous) selected_ = (selected_ + count - 1) % count;
  if (action == Action::seek_next || action == Action::select_next || action == Action::hide)
    selected_ = (selected_ + 1) % count;
  if (action == Action::open_selected) chosen_ = selected_;
  if (action == Action::release) chosen_ = count - 1;
}

std::optional<std::size_t> Question::draw(Rows& rows, ImVec2 picture) {
  if (!is_open()) return std::nullopt;
  const float width = std::min(em(30), picture.x - em(2));
  ImGui::SetNextWindowPos({picture.x / 2, picture.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSizeConstraints({0, 0}, {width, picture.y - em(2)});
  ImGui::SetNextWindowFocus();
  ImGui::SetNextWindowBgAlpha(0.98f);
  ImGui::Begin("question", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoNav |
                   ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::PushTextWrapPos(width - 2 * ImGui::GetStyle().WindowPadding.x);
  {
    const UseFont large(Font::title);
    ImGui::TextUnformatted(title_.c_str());
  }
  ImGui::TextUnformatted(text_.c_str());
  ImGui::PopTextWrapPos();
  ImGui::Dummy({0, em(0.3f)});
  for (std::size_t k = 0; k < answers_.size(); ++k) {
    if (k > 0) ImGui::SameLine(0, em(0.5f));
    ImGui::PushStyleColor(ImGuiCol_Button, k == selected_ ? colours::fill : colours::track);
    if (rows.button({answers_[k], ""}, em(7))) chosen_ = k;
    ImGui::PopStyleColor();
  }
  ImGui::End();
  if (chosen_) answers_.clear();
  return std::exchange(chosen_, std::nullopt);
}

}  // namespace heml::panel
