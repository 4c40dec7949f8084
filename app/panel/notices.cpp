#include <algorithm>
#include <app/panel/notices.hpp>

namespace heml::panel {
namespace {
constexpr float notice_time = 3.5f, fading = 0.5f;  // s
constexpr ImGuiWindowFlags plain_window = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                                          ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoFocusOnAppearing |
                                          ImGuiWindowFlags_NoNav;
}  // namespace

void Notices::notify(std::string text) {
  notice_ = std::move(text);
  notice_age_ = 0;
}

void Notices::show_error(std::string text) {
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
  const Banner failure{"Could not be opened", failure_, "Close", colours::danger};
  if (!failure_.empty() && draw_banner(rows, "failure", free, failure) == BannerPress::button) failure_.clear();
  const BannerPress pressed = banner ? draw_banner(rows, "banner", free, *banner) : BannerPress::none;
  if (!notice_.empty()) draw_notice(free, seconds);
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
    if (!banner.button.empty() && rows.button({banner.button, ""})) pressed = BannerPress::button;
    if (!banner.close.empty() && rows.button({banner.close, ""})) pressed = BannerPress::close;
  }
  const ImVec2 from = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  rects_.push_back({from, {from.x + size.x, from.y + size.y}});
  ImGui::End();
  ImGui::PopStyleColor();
  return pressed;
}

void Notices::draw_notice(const Area& free, float seconds) {
  notice_age_ += seconds;
  if (notice_age_ > notice_time) return notice_.clear();
  const float opacity = std::clamp((notice_time - notice_age_) / fading, 0.0f, 1.0f);
  ImGui::SetNextWindowPos({(free.from.x + free.to.x) / 2, free.to.y - em(4.2f)}, ImGuiCond_Always, {0.5f, 1});
  ImGui::PushStyleVar(ImGuiStyleVar_Alpha, opacity);
  if (ImGui::Begin("notice", nullptr, plain_window | ImGuiWindowFlags_NoInputs)) {
    ImGui::PushTextWrapPos(free.width() * 0.8f);
    ImGui::TextUnformatted(notice_.c_str());
    ImGui::PopTextWrapPos();
  }
  ImGui::End();
  ImGui::PopStyleVar();
}

}  // namespace heml::panel
