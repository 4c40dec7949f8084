#include <algorithm>
#include <app/panel/notices.hpp>

namespace heml::panel {
namespace {
constexpr float min_width = 16;                                                   // em, of a place for messages
constexpr float notice_time = 3.5f, notice_time_with_button = 10, fading = 0.5f;  // s
constexpr ImGuiWindowFlags plain_window = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                                          ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoFocusOnAppearing |
                                          ImGuiWindowFlags_NoNav;

/// The free area, or the whole width of the image where the panel leaves too little for lines of text.
Area place_in(const Area& free) {
  if (free.width() >= em(min_width)) return free;
  return {{0, free.from.y}, {ImGui::GetIO().DisplaySize.x, free.to.y}};
}

}  // namespace

void Notices::notify(std::string text, std::filesystem::path folder) {
  need_letters(text);
  notice_ = std::move(text);
  folder_ = std::move(folder);
  notice_age_ = 0;
}

void Notices::show_error(std::string title, std::string text) {
  need_letters(title + text);
  failure_title_ = std::move(title);
  failure_ = std::move(text);
  notice_.clear();
}

bool Notices::close() {
  const bool open = !failure_.empty();
  failure_.clear();
  return open;
}

bool Notices::covers(float x, float y) const {
  return std::any_of(rects_.begin(), rects_.end(), [&](const Area& place) { return place.contains(x, y); });
}

BannerPress Notices::draw(Rows& rows, const Area& free, const std::optional<Banner>& banner, float seconds) {
  rects_.clear();
  height_beside_ = 0;
  const Area place = place_in(free);
  const Banner failure{failure_title_, failure_, "Close", colours::danger};
  if (!failure_.empty() && draw_banner(rows, "failure", place, failure) == BannerPress::button) failure_.clear();
  const BannerPress pressed = banner ? draw_banner(rows, "banner", place, *banner) : BannerPress::none;
  if (!notice_.empty()) draw_notice(rows, place, seconds);
  return pressed;
}

BannerPress Notices::draw_banner(Rows& rows, const char* id, const Area& free, const Banner& banner) {
  const float margin = em(0.8f);
  const float width = banner.beside ? banner.beside->width() : std::min(free.width() - 2 * margin, em(34));
  const float top = rects_.empty() ? free.from.y + margin : rects_.back().to.y + margin / 2;
  if (banner.beside)
    ImGui::SetNextWindowPos(banner.beside->to, ImGuiCond_Always, {1, 1});
  else
    ImGui::SetNextWindowPos({(free.from.x + free.to.x) / 2, top}, ImGuiCond_Always, {0.5f, 0});
  ImGui::SetNextWindowSizeConstraints({0, 0}, {width, free.height() * 0.7f});
  ImGui::PushStyleColor(ImGuiCol_Border, (banner.colour & 0x00ffffff) | 0x90000000);
  BannerPress pressed = BannerPress::none;
  if (ImGui::Begin(id, nullptr, plain_window)) {
    ImGui::PushTextWrapPos(width - 2 * ImGui::GetStyle().WindowPadding.x);
    ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(banner.colour), "%s", banner.title.c_str());
    if (!banner.text.empty()) {
      const UseFont small(Font::small);
      ImGui::TextUnformatted(banner.text.c_str());
    }
    ImGui::PopTextWrapPos();
    const float room = width - 2 * ImGui::GetStyle().WindowPadding.x;
    if (!banner.button.empty() && draw_wide_button(rows, banner.button, room)) pressed = BannerPress::button;
    if (!banner.close.empty() && rows.button({banner.close, ""})) pressed = BannerPress::close;
  }
  const ImVec2 from = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  rects_.push_back({from, {from.x + size.x, from.y + size.y}});
  if (banner.beside) height_beside_ = size.y;
  ImGui::End();
  ImGui::PopStyleColor();
  return pressed;
}

/// A button whose label may need smaller letters.
bool Notices::draw_wide_button(Rows& rows, const std::string& label, float room) {
  const ImVec2 pad = ImGui::GetStyle().FramePadding;
  if (ImGui::CalcTextSize(label.c_str()).x + 2 * pad.x <= room) return rows.button({label, ""});
  const UseFont small(Font::small);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {pad.x / 2, pad.y});
  const bool pressed = rows.button({label, label}, room);
  ImGui::PopStyleVar();
  return pressed;
}

void Notices::draw_notice(Rows& rows, const Area& free, float seconds) {
  notice_age_ += seconds;
  const float time = folder_.empty() ? notice_time : notice_time_with_button;
  if (notice_age_ > time) return notice_.clear();
  const float opacity = std::clamp((time - notice_age_) / fading, 0.0f, 1.0f);
  ImGui::SetNextWindowPos({(free.from.x + free.to.x) / 2, free.to.y - em(folder_.empty() ? 4.2f : 1)}, ImGuiCond_Always,
                          {0.5f, 1});
  ImGui::PushStyleVar(ImGuiStyleVar_Alpha, opacity);
  if (ImGui::Begin("notice", nullptr, plain_window | (folder_.empty() ? ImGuiWindowFlags_NoInputs : 0))) {
    ImGui::PushTextWrapPos(free.width() * 0.8f);
    ImGui::TextUnformatted(notice_.c_str());
    ImGui::PopTextWrapPos();
    if (!folder_.empty()) {
      if (rows.button({"Open folder", folder_.string()})) opened_ = folder_;
      const ImVec2 from = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
      rects_.push_back({from, {from.x + size.x, from.y + size.y}});
    }
  }
  ImGui::End();
  ImGui::PopStyleVar();
}

}  // namespace heml::panel
