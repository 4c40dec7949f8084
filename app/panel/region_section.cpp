#include <fmt/format.h>

#include <algorithm>
#include <app/panel/icons.hpp>
#include <app/panel/region_section.hpp>
#include <app/render/palette.hpp>
#include <iterator>
#include <utility>

namespace heml::panel {
namespace {

constexpr std::size_t rows_shown = 6;  // more scroll

ImU32 region_colour(int region) {
  const Vec3f tint = render::tissue_tint(region).cwiseSqrt();
  return ImGui::ColorConvertFloat4ToU32({tint.x(), tint.y(), tint.z(), 1});
}

}  // namespace

RegionSection::RegionSection(std::vector<int> regions, std::map<int, std::string> names, const std::vector<int>& hidden)
    : hidden_(hidden) {
  take(std::move(regions), std::move(names));
}

void RegionSection::take(std::vector<int> regions, std::map<int, std::string> names) {
  regions_ = std::move(regions);
  names_ = std::move(names);
  const std::vector<int> hidden = std::exchange(hidden_, {});
  std::set_intersection(regions_.begin(), regions_.end(), hidden.begin(), hidden.end(), std::back_inserter(hidden_));
  if (hidden_.size() == regions_.size()) hidden_.clear();
}

bool RegionSection::is_shown(int region) const { return !std::binary_search(hidden_.begin(), hidden_.end(), region); }

void RegionSection::toggle(int region) {
  const auto at = std::lower_bound(hidden_.begin(), hidden_.end(), region);
  if (!is_shown(region))
    hidden_.erase(at);
  else if (hidden_.size() + 1 < regions_.size())
    hidden_.insert(at, region);
}

void RegionSection::show_only(int region) {
  const bool is_alone = is_shown(region) && hidden_.size() + 1 == regions_.size();
  hidden_.clear();
  if (is_alone) return;
  std::copy_if(regions_.begin(), regions_.end(), std::back_inserter(hidden_),
               [&](int other) { return other != region; });
}

std::string region_name(int region, const std::map<int, std::string>& names) {
  const auto name = names.find(region);
  return name == names.end() ? fmt::format("Region {}", region) : name->second;
}

void RegionSection::draw(Rows& rows) {
  const float row = ImGui::GetFrameHeight() + ImGui::GetStyle().ItemSpacing.y;
  const bool scrolls = regions_.size() > rows_shown;
  if (scrolls) ImGui::BeginChild("regions", {0, row * (static_cast<float>(rows_shown) + 0.5f)});
  for (const int region : regions_) draw_region(rows, region);
  if (scrolls) ImGui::EndChild();
  if (!hidden_.empty() && rows.button({"Show all", "Draws every region again."}, -1)) show_all();
}

void RegionSection::draw_region(Rows& rows, int region) {
  const std::string name = region_name(region, names_);
  const bool shown = is_shown(region);
  const float size = ImGui::GetFrameHeight();
  const float only = ImGui::CalcTextSize("only").x + 2 * ImGui::GetStyle().FramePadding.x;
  ImGui::PushID(region);
  const Rows::Icon eye = [&](ImDrawList& list, ImVec2 centre, float half, ImU32 colour) {
    draw_eye(list, centre, half, shown ? colour : colours::faint, shown);
  };
  if (rows.icon_button({"Eye of " + name, fmt::format("{} {} (region {}): a hidden region is not drawn, and the mouse "
                                                      "reaches what lies behind it. It goes on being simulated; "
                                                      "grasps and pins leave it out, a blade cuts it too. Frames "
                                                      "of the timeline from before stay as they were.",
                                                      shown ? "Hides" : "Shows", name, region)},
                       size, false, eye))
    toggle(region);
  ImGui::SameLine(0, em(0.5f));
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddCircleFilled({at.x + em(0.3f), at.y + size / 2}, em(0.3f), region_colour(region), 16);
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + em(0.95f));
  ImGui::AlignTextToFramePadding();
  ImGui::PushStyleColor(ImGuiCol_Text, shown ? colours::text : colours::faint);
  ImGui::TextUnformatted(elided(name, ImGui::GetContentRegionAvail().x - only - em(0.5f)).c_str());
  ImGui::PopStyleColor();
  rows.explain({name, fmt::format("Region {} of the mesh.", region)});
  ImGui::SameLine();
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - only);
  if (ImGui::Button("only", {only, 0})) show_only(region);
  rows.explain({"Only " + name, fmt::format("Hides all regions but {}; again: shows all.", name)});
  ImGui::PopID();
}

}  // namespace heml::panel
