#include <fmt/format.h>

#include <app/panel/film_sign.hpp>
#include <app/panel/keys.hpp>
#include <app/panel/theme.hpp>
#include <string>

namespace heml::panel {

float draw_film_sign(const Area& free, long frames) {
  const std::string text = fmt::format("Filming, {} frames  ·  {} stops", frames, key_name(Action::record_video));
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const ImVec2 to(free.to.x - em(0.7f), em(0.7f) + size.y + em(0.7f));
  const ImVec2 from(to.x - size.x - em(2.6f), em(0.7f));
  ImDrawList& list = *ImGui::GetForegroundDrawList();
  list.AddRectFilled(from, to, colours::background, em(0.5f));
  list.AddRect(from, to, (colours::danger & 0x00ffffff) | 0x90000000, em(0.5f));
  list.AddCircleFilled({from.x + em(0.95f), (from.y + to.y) / 2}, em(0.36f), colours::danger, 20);
  list.AddText({from.x + em(1.7f), from.y + em(0.35f)}, colours::text, text.c_str());
  return to.y;
}

}  // namespace heml::panel
