#include <fmt/format.h>

#include <algorithm>
#include <app/panel/axes.hpp>
#include <app/panel/keys.hpp>
#include <app/panel/view_section.hpp>
#include <cmath>
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
  orthographic_ = view.orthographic;
  if (!view.range) return;
  fixed_ = {static_cast<float>((*view.range)[0]), static_cast<float>((*view.range)[1])};
  reach_ = 2 * std::max(std::abs(fixed_->low), std::abs(fixed_->high));
}

render::DrawOptions ViewSection::drawing() const {
  render::DrawOptions options = drawing_;
  options.section = section_.plane();
  return options;
}

void ViewSection::keep(const Preferences& preferences) {
  hints_ = preferences.hints;
  drawing_.ground = preferences.ground;
  drawing_.constrained = preferences.constraints;
  drawing_.resolution = preferences.full_resolution ? 1 : half_resolution;
}

void ViewSection::write_into(Preferences& preferences) const {
  preferences.hints = hints_;
  preferences.ground = drawing_.ground;
  preferences.constraints = drawing_.constrained;
  preferences.full_resolution = drawing_.resolution == 1;
}

/// A fixed range is of one field: another unit, other values.
void ViewSection::show(Field field, PanelActions& out) {
  if (field != field_) fixed_.reset();
  field_ = field;
  out.show = field;
}

void ViewSection::draw(Rows& rows, std::vector<Action>& pressed, PanelActions& out) {
  int chosen = static_cast<int>(field_);
  if (rows.choice({"Colours",
                   "Field shown on the surface (keys 1 to 6: the first six): displacement, stretch, stresses, strains, "
                   "or the mesh error (estimated discretisation error)."},
                  chosen, titles(), meanings()))
    show(static_cast<Field>(chosen), out);
  if (field_ != Field::none) draw_range(rows);
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
  rows.check({"Hints", "The line below the body that says what mouse and keys do."}, hints_);
  ImGui::SameLine(left + half);
  bool orthographic = orthographic_;
  if (rows.check({"Orthographic", fmt::format("Without perspective: lengths of one direction keep their ratios ({}).",
                                              key_name(Action::orthographic))},
                 orthographic))
    pressed.push_back(Action::orthographic);
  draw_views(rows, pressed);
  section_.draw(rows);
}

void ViewSection::write_range_into(View& view) const {
  view.range.reset();
  if (fixed_) view.range = {static_cast<double>(fixed_->low), static_cast<double>(fixed_->high)};
}

void ViewSection::draw_range(Rows& rows) {
  const render::Range shown = fixed_.value_or(drawing_.range.value_or(render::Range{}));
  bool fixed = fixed_.has_value();
  if (rows.check({"Fixed range", "The colours keep their range, as it is now or as set below; otherwise it follows the "
                                 "values. Another field ends it."},
                 fixed)) {
    fixed_ = fixed ? std::optional(shown) : std::nullopt;
    reach_ = 2 * std::max(std::abs(shown.low), std::abs(shown.high));
  }
  if (!fixed_) return;
  const render::FieldLabel label = render::field_label(field_, {-reach_, reach_});
  const std::string format = "%.4g" + (label.unit.empty() ? "" : label.unit == "%" ? " %%" : " " + label.unit);
  const double scale = static_cast<double>(label.scale), reach = scale * static_cast<double>(reach_);
  double low = scale * static_cast<double>(fixed_->low), high = scale * static_cast<double>(fixed_->high);
  if (rows.slider({"Lowest", "Value of the left end of the colours; values below have its colour."}, low,
                  {-reach, reach, format.c_str()}))
    fixed_->low = std::min(static_cast<float>(low / scale), fixed_->high - 1e-3f * reach_);
  if (rows.slider({"Highest", "Value of the right end of the colours; values above have its colour."}, high,
                  {-reach, reach, format.c_str()}))
    fixed_->high = std::max(static_cast<float>(high / scale), fixed_->low + 1e-3f * reach_);
}

/// Standard views, the opposite ones with Ctrl, and a button per saved view, which restores it, or saves the current
/// view if none is saved, or with Ctrl.
void ViewSection::draw_views(Rows& rows, std::vector<Action>& pressed) const {
  struct Side {
    const char *name, *along, *key;
    StandardView view;
  };
  static constexpr Side sides[] = {{"Front", "along −z", "1", StandardView::front},
                                   {"Right", "along −x", "3", StandardView::right},
                                   {"Top", "along −y, down", "7", StandardView::top}};
  const float gap = em(0.25f), saved_width = em(1.45f), room = ImGui::GetContentRegionAvail().x;
  const float side_width = (room - gap * (CameraController::views + 2) - saved_width * CameraController::views) / 3;
  for (const auto& [name, along, key, view] : sides) {
    const std::string hint = fmt::format(
        "The camera looks {0} (numpad {2}). Ctrl+click: from the {1} (Ctrl+numpad {2}). The ends of the axes in the "
        "corner of the image do the same.",
        along, standard_view_names[static_cast<std::size_t>(opposite(view))], key);
    if (rows.button({name, hint}, side_width))
      pressed.push_back(look_at(ImGui::GetIO().KeyCtrl ? opposite(view) : view));
    ImGui::SameLine(0, gap);
  }
  for (std::size_t view = 0; view < CameraController::views; ++view) {
    if (view > 0) ImGui::SameLine(0, gap);
    ImGui::PushStyleColor(ImGuiCol_Text, saved_[view] ? colours::text : colours::faint);
    const std::string name = fmt::format("{}", view + 1);
    const std::string hint = fmt::format(
        "Camera view {0}, {1} Ctrl+click (Ctrl+F{2}) saves the current view.", view + 1,
        saved_[view] ? fmt::format("saved: click to restore (F{}).", view + 5) : "empty: click to save.", view + 5);
    const bool chosen = rows.button({name, hint}, saved_width);
    ImGui::PopStyleColor();
    if (!chosen) continue;
    const bool saves = !saved_[view] || ImGui::GetIO().KeyCtrl;
    pressed.push_back(
        static_cast<Action>(static_cast<int>(saves ? Action::save_view_1 : Action::view_1) + static_cast<int>(view)));
  }
}

}  // namespace heml::panel
