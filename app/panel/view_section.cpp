#include <algorithm>
#include <app/panel/view_section.hpp>
#include <array>

namespace heml::panel {
namespace {
constexpr std::array fields{Field::none,      Field::displacement, Field::stretch,
                            Field::von_mises, Field::volume_ratio, Field::error};
const std::array<std::string, 6> field_names{"Tissue",           "Displacement",   "Stretch",
                                             "von Mises stress", "Volume ratio J", "Error of the mesh"};
constexpr float half_resolution = 0.5f;
}  // namespace

ViewSection::ViewSection(const View& view) : field_(view.field) { drawing_.wireframe = view.wireframe; }

void ViewSection::show(Field field, PanelActions& out) {
  field_ = field;
  out.show = field;
}

void ViewSection::draw(Rows& rows, std::vector<Action>& pressed, PanelActions& out) {
  int chosen = static_cast<int>(std::find(fields.begin(), fields.end(), field_) - fields.begin());
  if (rows.choice({"Colours",
                   "What the surface shows (keys 1 to 6): the tissue itself, the distance from the rest shape (m), the "
                   "largest stretch, the von Mises stress (Pa), the volume relative to rest, or where the mesh is too "
                   "coarse (the estimated error of its energy norm, of the body's mean)."},
                  chosen, field_names))
    show(fields[static_cast<std::size_t>(chosen)], out);
  const float half = ImGui::GetContentRegionAvail().x / 2;
  const float left = ImGui::GetCursorPosX();
  rows.check({"Wireframe", "The mesh's edges over the surface (W)."}, drawing_.wireframe);
  ImGui::SameLine(left + half);
  rows.check({"Held nodes", "Beads where the scene holds or moves the body."}, drawing_.held);
  rows.check({"Ground", "The drape below, and the shadow on it."}, drawing_.ground);
  ImGui::SameLine(left + half);
  bool fine = drawing_.resolution == 1;
  if (rows.check(
          {"Sharp", "The picture at the screen's full resolution. Off: half, which is faster without a graphics card."},
          fine))
    drawing_.resolution = fine ? 1 : half_resolution;
  const float width = half - ImGui::GetStyle().ItemSpacing.x / 2;
  if (rows.button({"Fit view", "Turns the eye back to where the scene began (F)."}, width))
    pressed.push_back(Action::fit);
  ImGui::SameLine();
  if (rows.button({"Save picture", "Writes a PNG into the working folder (P)."}, width))
    pressed.push_back(Action::screenshot);
}

}  // namespace heml::panel
