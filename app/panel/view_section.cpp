#include <fmt/format.h>

#include <app/panel/view_section.hpp>
#include <heml/world/field_list.hpp>

namespace heml::panel {
namespace {
constexpr float half_resolution = 0.5f;

/// Of the list of fields, for a choice: titles, and what each means.
const std::vector<std::string>& titles() {
  static const auto all = [] {
    std::vector<std::string> texts;
    for (const FieldInfo& row : field_list) texts.emplace_back(row.title);
    return texts;
  }();
  return all;
}
const std::vector<std::string>& meanings() {
  static const auto all = [] {
    std::vector<std::string> texts;
    for (const FieldInfo& row : field_list)
      texts.push_back(row.unit.empty() ? std::string(row.meaning) : fmt::format("{} ({})", row.meaning, row.unit));
    return texts;
  }();
  return all;
}
}  // namespace

ViewSection::ViewSection(const View& view, const SurfaceMesh& surface_mesh)
    : field_(view.field), section_(view, surface_mesh) {
  drawing_.wireframe = view.wireframe;
}

render::DrawOptions ViewSection::drawing() const {
  render::DrawOptions options = drawing_;
  options.section = section_.plane();
  return options;
}

void ViewSection::show(Field field, PanelActions& out) {
  field_ = field;
  out.show = field;
}

void ViewSection::draw(Rows& rows, std::vector<Action>& pressed, PanelActions& out) {
  int chosen = static_cast<int>(field_);
  if (rows.choice({"Colours",
                   "Field shown on the surface (keys 1 to 6: the first six): displacement, stretch, stresses, strains, "
                   "or the estimated discretisation error."},
                  chosen, titles(), meanings()))
    show(static_cast<Field>(chosen), out);
  const float half = ImGui::GetContentRegionAvail().x / 2;
  const float left = ImGui::GetCursorPosX();
  rows.check({"Wireframe", "The mesh's edges over the surface (W)."}, drawing_.wireframe);
  ImGui::SameLine(left + half);
  rows.check({"Constraints", "Beads at fixed and prescribed nodes."}, drawing_.constrained);
  rows.check({"Ground", "The ground below the body, with its shadow."}, drawing_.ground);
  ImGui::SameLine(left + half);
  bool fine = drawing_.resolution == 1;
  if (rows.check({"Full resolution",
                  "The image at the screen's full resolution. Off: half, which is faster without a graphics card."},
                 fine))
    drawing_.resolution = fine ? 1 : half_resolution;
  draw_views(rows, pressed);
  rows.check({"Hints", "The line below the body that says what mouse and keys do."}, hints_);
  section_.draw(rows);
}

/// One button per view: restores it; saves the current view if none is saved, or with Ctrl.
void ViewSection::draw_views(Rows& rows, std::vector<Action>& pressed) const {
  rows.name({"Views", "Four camera views: the first click saves the current view, later ones restore it."});
  const float gap = em(0.25f),
              each = (ImGui::GetContentRegionAvail().x - gap * (CameraController::views - 1)) / CameraController::views;
  for (std::size_t view = 0; view < CameraController::views; ++view) {
    if (view > 0) ImGui::SameLine(0, gap);
    ImGui::PushStyleColor(ImGuiCol_Text, saved_[view] ? colours::text : colours::faint);
    const std::string name = fmt::format("{}", view + 1);
    const std::string hint = fmt::format(
        "Camera view {0}, {1} Ctrl+click (Ctrl+F{2}) saves the current view.", view + 1,
        saved_[view] ? fmt::format("saved: click to restore (F{}).", view + 5) : "empty: click to save.", view + 5);
    const bool chosen = rows.button({name, hint}, each);
    ImGui::PopStyleColor();
    if (!chosen) continue;
    const bool saves = !saved_[view] || ImGui::GetIO().KeyCtrl;
    pressed.push_back(
        static_cast<Action>(static_cast<int>(saves ? Action::save_view_1 : Action::view_1) + static_cast<int>(view)));
  }
}

}  // namespace heml::panel
