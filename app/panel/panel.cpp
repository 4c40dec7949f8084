#include <fmt/format.h>

#include <algorithm>
#include <app/panel/axes.hpp>
#include <app/panel/film_sign.hpp>
#include <app/panel/header.hpp>
#include <app/panel/keys.hpp>
#include <app/panel/legend.hpp>
#include <app/panel/look_section.hpp>
#include <app/panel/measure_section.hpp>
#include <app/panel/panel.hpp>
#include <app/panel/readings.hpp>
#include <app/panel/undo_section.hpp>
#include <app/render/bounds.hpp>

namespace heml::panel {
namespace {

constexpr float controls_width = 18.5f, readings_width = 16.0f, margin = 0.7f, two_columns_from = 66;  // em

constexpr float variant_labels_height = 3.4f;  // em

constexpr ImGuiWindowFlags column_flags =
    ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
    ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoBringToFrontOnFocus;

/// Of the labels of comparison runs at the top, pixels.
float labels_height(const Frame& frame) { return frame.comparisons.empty() ? 0 : em(variant_labels_height); }

bool two_columns(ImVec2 picture) { return picture.x >= em(two_columns_from); }

}  // namespace

Panel::Panel(const Scene& scene, const SurfaceMesh& surface_mesh, std::map<int, std::string> region_names,
             std::vector<int> regions)
    : title_(!scene.title.empty() ? scene.title : scene.name),
      description_(scene.description),
      tool_(static_cast<double>(render::bounding_sphere(surface_mesh.rest).radius), scene.gravity),
      mesh_(scene),
      material_(scene.materials, region_names, regions),
      stretch_monitor_(surface_mesh),
      surface_version_(surface_mesh.version),
      surface_hidden_(surface_mesh.hidden),
      regions_(std::move(regions), std::move(region_names), scene.view.hidden),
      motion_(scene.gravity, scene.solver),
      view_(scene.view, surface_mesh) {
  need_letters(title_ + description_);
  update_stretch_limits();
}

void Panel::set_findings(std::vector<std::string> findings) {
  findings_ = std::move(findings);
  for (const std::string& text : findings_) need_letters(text);
}

void Panel::set_interaction(Interaction interaction, bool suture_begun) {
  interaction_ = interaction;
  suture_begun_ = suture_begun;
}

void Panel::set_camera(const render::Camera& camera) {
  camera_ = camera;
  view_.set_orthographic(camera.is_orthographic());
}

void Panel::set_preferences(const Preferences& preferences) {
  view_.keep(preferences);
  tool_.keep(preferences.tools);
  look_ = preferences.look;
  rows_.set_sections(preferences.sections);
  tool_.set_device_moves_view(preferences.device_moves_view);
}

Preferences Panel::preferences() const {
  Preferences preferences;
  view_.write_into(preferences);
  preferences.tools = tool_.kept();
  preferences.look = look_;
  preferences.sections = rows_.sections();
  preferences.device_moves_view = tool_.device_moves_view();
  return preferences;
}

void Panel::update_stretch_limits() {
  if (limited_changes_ == material_.changes()) return;
  limited_changes_ = material_.changes();
  stretch_monitor_.set(material_.materials());
}

void Panel::update_surface(const Frame& frame) {
  if (!frame.surface_mesh) return;
  if (frame.surface_mesh->version == surface_version_ && frame.surface_mesh->hidden == surface_hidden_) return;
  surface_version_ = frame.surface_mesh->version;
  surface_hidden_ = frame.surface_mesh->hidden;
  stretch_monitor_ = StretchMonitor(*frame.surface_mesh);
  limited_changes_ = -1;
}

void Panel::update(const Frame& frame, float seconds) {
  measure_.update(frame);
  history_.add(frame, measure_.now());
  report_refusal(frame);
  if (!timeline_ || !timeline_->shown) {  // settings are of the live body, to which commands apply
    update_settings(frame);
    update_regions(frame);
  }
  state_banner_.update(frame, seconds);
  if (view_.fixed_range())
    colour_range_.fix(*view_.fixed_range());
  else
    colour_range_.follow();
  range_ = colour_range_.update(frame.field, frame.values, seconds);
  view_.set_range(range_);
  update_surface(frame);
  update_stretch_limits();
  stretch_monitor_.update(frame);
  view_.set_hatched(stretch_monitor_.beyond());
}

/// Shows the settings that an undo or redo has restored.
void Panel::update_settings(const Frame& frame) {
  const UndoList* list = frame.undo_list.get();
  const long steps = list ? list->steps : 0;
  if (steps == std::exchange(undo_steps_, steps) || !list) return;
  for (const Command& command : list->settings) sync(command);
}

/// Regions that were made, or taken back, since they were last looked at.
void Panel::update_regions(const Frame& frame) {
  if (!frame.regions || frame.regions->version == seen_regions_) return;
  seen_regions_ = frame.regions->version;
  material_.take(frame.regions->materials, frame.regions->names, frame.regions->numbers);
  regions_.take(frame.regions->numbers, frame.regions->names);
  for (const auto& [region, name] : frame.regions->names) need_letters(name);
}

void Panel::report_refusal(const Frame& frame) {
  if (frame.refusals == refusals_) return;
  refusals_ = frame.refusals;
  notify(capitalised(frame.refusal) + ".");
}

void Panel::perform(Action action) { pressed_.push_back(action); }

void Panel::sync(const Command& command) {
  if (const auto* material = std::get_if<SetMaterial>(&command)) material_.sync(*material);
  if (const auto* active = std::get_if<SetActiveStress>(&command)) material_.sync(*active);
  if (const auto* gravity = std::get_if<SetGravity>(&command)) {
    motion_.sync(*gravity);
    tool_.sync(*gravity);
  }
  if (const auto* damping = std::get_if<SetDamping>(&command)) motion_.sync(*damping);
  if (const auto* integrator = std::get_if<SetIntegrator>(&command)) motion_.sync(*integrator);
  if (const auto* rate = std::get_if<SetRate>(&command)) motion_.sync(*rate);
  if (const auto* budget = std::get_if<SetBudget>(&command)) motion_.sync(*budget);
}

void Panel::write_into(Scene& scene) const {
  scene.materials = material_.materials();
  motion_.write_into(scene);
  scene.view.field = view_.field();
  scene.view.wireframe = view_.drawing().wireframe;
  scene.view.orthographic = view_.is_orthographic();
  view_.section().write_into(scene.view);
  view_.write_range_into(scene.view);
  scene.view.hidden = regions_.hidden();
}

Insets Panel::insets(ImVec2 picture) const {
  if (hidden_) return {};
  return {em(controls_width + margin), two_columns(picture) ? em(readings_width + margin) : 0};
}

bool Panel::covers(float x, float y) const {
  constexpr ImGuiPopupFlags any = ImGuiPopupFlags_AnyPopup;
  return is_modal() || notices_.covers(x, y) || ImGui::IsPopupOpen("", any) ||
         std::any_of(rects_.begin(), rects_.end(), [&](const Area& place) { return place.contains(x, y); });
}

PanelActions Panel::draw(const Frame& frame) {
  PanelActions out;
  rows_.new_frame(help_.is_open());
  rects_.clear();
  errors_open_ = false;
  const ImVec2 picture = ImGui::GetIO().DisplaySize;
  const Insets taken = insets(picture);
  Area free{{taken.left, 0}, {picture.x - taken.right, picture.y}};
  const float palette = hidden_ ? 0 : draw_edges(frame, free, out);
  const Area beside_palette{{free.from.x + palette, free.from.y}, {free.to.x - palette, free.to.y}};
  draw_legend(frame.field, range_, beside_palette, !(frame.min_J > 0));
  if (!hidden_) {
    draw_controls(frame, !two_columns(picture), out);
    if (two_columns(picture)) draw_readings_column(frame);
  }
  const Area between{{beside_palette.from.x, free.from.y + labels_height(frame)}, beside_palette.to};
  const auto banner = state_banner_.choose(frame, motion_.integrator(), motion_.budget(), beside_body(free, picture));
  take_press(notices_.draw(rows_, between, banner, ImGui::GetIO().DeltaTime), frame, out);
  out.open_folder = notices_.take_folder();
  help_.draw(rows_, picture);
  dialog_.draw(rows_, picture, out);
  out.answer = question_.draw(rows_, picture);
  if (std::string notice = rows_.take_notice(); !notice.empty()) notify(std::move(notice));
  perform_queued(frame, out);
  return out;
}

void Panel::perform_queued(const Frame& frame, PanelActions& out) {
  for (const Action action : std::exchange(pressed_, {})) carry_out(action, frame, out);
}

PanelActions Panel::perform_now(const Frame& frame) {
  PanelActions out;
  perform_queued(frame, out);
  return out;
}

/// Draws what stands at the edges of the free area and takes its height off it. Returns the width of the palette.
float Panel::draw_edges(const Frame& frame, Area& free, PanelActions& out) {
  if (timeline_) {
    Area& bar = rects_.emplace_back();
    draw_timeline(rows_, *timeline_, free, pressed_, out, bar);
    free.to.y = bar.from.y;
  }
  const bool has_table = find_tool<TableState>(frame.tools) != nullptr;
  Area& palette = rects_.emplace_back();
  draw_palette(rows_, {tool_.tool().tool, has_table, filmed_frames_}, free, pressed_, palette);
  const float width = palette.to.x - free.from.x;
  const float sign = filmed_frames_ ? draw_film_sign(free, *filmed_frames_) : 0;
  const float top = std::max(sign, free.from.y + labels_height(frame));
  if (camera_) draw_axes(rows_, *camera_, free, top, pressed_, rects_.emplace_back());
  if (!view_.hints()) return width;
  Area line = free;
  if (palette.to.y > free.to.y - hint_height())
    line = {{free.from.x + width, free.from.y}, {free.to.x - width, free.to.y}};
  draw_hints(situation(frame), line);
  free.to.y -= hint_height();
  return width;
}

Situation Panel::situation(const Frame& frame) const {
  Situation now{tool_.tool().tool,
                interaction_,
                suture_begun_,
                frame.paused,
                !frame.halted.empty(),
                timeline_ && timeline_->shown.has_value(),
                !regions_.hidden().empty()};
  for (const DeviceInfo& device : tool_.devices())
    if (device.is_new) {
      now.device = device.controls;
      now.device.front() = device.kind + ": " + now.device.front();
    }
  return now;
}

void Panel::record_window_rect() {
  const ImVec2 from = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  rects_.push_back({from, {from.x + size.x, from.y + size.y}});
}

/// The lower corner of the right column, where a banner does not cover the body; none where there is no such column.
std::optional<Area> Panel::beside_body(const Area& free, ImVec2 picture) const {
  if (!two_columns(picture) || hidden_) return std::nullopt;
  return Area{{free.to.x + em(margin), 0}, {picture.x - em(margin), picture.y - em(margin)}};
}

void Panel::take_press(BannerPress press, const Frame& frame, PanelActions& out) {
  const StateBanner::Request request = state_banner_.take(press, frame);
  if (request.action) pressed_.push_back(*request.action);
  for (const Command& command : request.commands) {
    sync(command);
    out.commands.push_back(command);
  }
}

void Panel::draw_controls(const Frame& frame, bool with_readings, PanelActions& out) {
  const ImVec2 picture = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({em(margin), em(margin)});
  ImGui::SetNextWindowSize({em(controls_width), std::min(controls_height_, picture.y - em(2 * margin))});
  if (ImGui::Begin("controls", nullptr,
                   column_flags | ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse)) {
    record_window_rect();
    draw_header(rows_, title_, description_, frame, mesh_.openings(), pressed_);
    const float header_height = ImGui::GetCursorPosY();
    ImGui::BeginChild("sections", {0, 0}, false, ImGuiWindowFlags_NoNav);
    if (mesh_.is_shown() || !findings_.empty()) draw_findings(out);
    if ((tool_.tool().tool == Tool::measure || !measure_.is_empty()) && rows_.section("Measure"))
      draw_measure(rows_, measure_, history_, out);
    if ((tool_.tool().tool == Tool::select || !selecting_.selection().is_empty()) && rows_.section("Selection"))
      selecting_.draw(rows_, frame, out);
    if (const auto region = selecting_.take_region()) material_.show(*region);
    if (rows_.section("Material")) material_.draw(rows_, stretch_monitor_.share(), out);
    if (rows_.section("Motion")) motion_.draw(rows_, out);
    if (rows_.section("Tool")) tool_.draw(rows_, frame, out);
    if (with_readings) errors_open_ = draw_readings(rows_, frame, history_);
    if (regions_.has_choice() && rows_.section("Regions", false)) regions_.draw(rows_);
    if (rows_.section("View")) view_.draw(rows_, pressed_, out);
    if (rows_.section("Compare", false)) comparisons_.draw(rows_, frame, out);
    if (rows_.section("Actions", false)) draw_undo_list(rows_, frame, mesh_.openings(), out);
    if (rows_.section("Window", false)) draw_look(rows_, look_);
    controls_height_ = header_height + ImGui::GetCursorPosY() + ImGui::GetStyle().WindowPadding.y;
    ImGui::EndChild();
  }
  ImGui::End();
}

void Panel::draw_findings(PanelActions& out) {
  if (mesh_.is_shown()) return mesh_.draw(rows_, material_.materials(), findings_, out);
  if (!rows_.section("As opened")) return;
  const UseFont small(Font::small);
  ImGui::PushTextWrapPos(0);
  for (const std::string& text : findings_) ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  if (rows_.button({"Dismiss", "Hides this text."})) findings_.clear();
}

void Panel::draw_readings_column(const Frame& frame) {
  const ImVec2 picture = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({picture.x - em(margin), em(margin)}, ImGuiCond_Always, {1, 0});
  const float banner = notices_.height_beside() > 0 ? notices_.height_beside() + em(margin) : 0;
  ImGui::SetNextWindowSizeConstraints({em(readings_width), 0},
                                      {em(readings_width), picture.y - em(2 * margin) - banner});
  if (ImGui::Begin("readings", nullptr, column_flags | ImGuiWindowFlags_AlwaysAutoResize)) {
    record_window_rect();
    errors_open_ = draw_readings(rows_, frame, history_);
  }
  ImGui::End();
}

}  // namespace heml::panel
