#include <fmt/format.h>
#include <imgui.h>

#include <app/panel/scripted_stroke.hpp>
#include <app/window/overlay.hpp>
#include <app/window/viewer.hpp>
#include <thread>

namespace heml::window {
namespace {
constexpr float passed_panel_opacity = 0.2f;
constexpr float max_shadow_age = 1.0f / 15;  // s

std::string window_title(const Scene& scene) {
  const std::string& title = !scene.title.empty() ? scene.title : scene.name;
  return title.empty() ? "heml" : title + " – heml";
}
}  // namespace

Viewer::Viewer(GlfwWindow& window, const Scene& scene, const WindowOptions& options)
    : window_(window),
      options_(options),
      interface_(interface_scale(), preferences_.look.theme) {
  adopt(start(scene, options.record, options.comparisons, options.warnings));
  window_.send_events_to(this);
  offer_left_work();
}

Viewer::~Viewer() { window_.send_events_to(nullptr); }

void Viewer::adopt(OpenScene opened) {
  std::vector<Command> last;
  mouse_tool_.cancel(last);
  for (PluggedHand* each : {&gamepad_, &spacemouse_}) each->hand.hide();
  if (opened.resumed)
    playback_.resumed_at(*opened.resumed, opened.session->latest());
  else
    playback_ = TimelinePlayback();
  const std::size_t bodies = live_ ? panel::body_count(*live_) : 0;
  open_ = std::move(opened);
  frame_ = live_ = &open_.session->latest();
  if (!open_.resumed) {
    as_opened_ = open_.scene;
    opened_conditions_ = frame_->conditions;
  }
  selection_drag_.cancel();
  arrow_drag_.cancel();
  const panel::Measure measure = open_.resumed && panel_ ? panel_->measure() : panel::Measure();
  const auto tool = open_.resumed && panel_ ? std::optional(panel_->tool()) : std::nullopt;
  auto selecting = open_.resumed && panel_ ? panel_->selecting() : panel::SelectionSection();
  selecting.keep_below(frame_->conditions->mesh_nodes);
  panel_.emplace(open_.scene, *frame_->surface_mesh, open_.session->region_names(),
                 open_.session->regions());
  panel_->measure() = measure;
  panel_->set_preferences(preferences_);
  panel_->selecting() = std::move(selecting);
  if (tool) panel_->set_tool(*tool);
  panel_->set_findings(open_.findings);
  show_mesh();
  next_event_ = 0;
  update_title();
  if (open_.resumed && panel::body_count(*frame_) > bodies) fit(ball_of_bodies());
  if (open_.resumed) return;
  controller_.set_saved_views(saved_views(open_.scene.file));
  controller_.set_orthographic(open_.scene.view.orthographic);
  fit(render::bounding_sphere(frame_->surface_mesh->rest));
}

/// A film has a sign here too, since the panel may be hidden.
void Viewer::update_title() {
  const bool films = video_recorder_ && !video_recorder_->is_finishing();
  window_.set_title((films ? "● filming – " : "") + window_title(open_.scene));
}

void Viewer::fit(const render::BoundingSphere& ball) {
  const render::Size size = window_.size();
  View view = open_.scene.view;
  view.orthographic = controller_.is_orthographic();
  controller_.fit(view, ball, size, panel_->insets({static_cast<float>(size.width), static_cast<float>(size.height)}),
                  panel::body_count(*frame_));
}

/// Round the bodies where they are now.
render::BoundingSphere Viewer::ball_of_bodies() const {
  std::vector<Vec3f> positions = frame_->positions;
  for (const Frame& other : frame_->comparisons)
    positions.insert(positions.end(), other.positions.begin(), other.positions.end());
  return render::bounding_sphere(positions);
}

bool Viewer::wants_drawing() const {
  return window_.visible() &&
         (frames_wanted_ > 0 || input_.needs_picture() || open_.session->frame_waiting() || panel_->animating() ||
          playback_.playing() || (session_loader_.is_ready() && !panel_->asks()) ||
          session_loader_.progress() != shown_progress_ || library_.is_ready() || unsaved_.is_due() ||
          (video_recorder_ && video_recorder_->is_done()));
}

bool Viewer::is_busy() const {
  return frames_wanted_ > 0 || !input_.empty() || session_loader_.is_busy() || library_.is_busy() ||
         (video_recorder_ && video_recorder_->is_finishing());
}

std::string Viewer::status() const {
  const bool paused = is_paused();
  return fmt::format("frame {}, tick {}, {}, {}, key {}", drawn_, frame_->tick, paused ? "paused" : "running",
                     is_busy()                    ? "busy"
                     : paused && !wants_drawing() && open_.session->has_answered(*live_) ? "still"
                                                  : "ready",
                     last_key_);
}

void Viewer::draw() {
  const auto now = std::chrono::steady_clock::now();
  const float seconds = drawn_ ? std::chrono::duration<float>(now - drawn_at_).count() : 1.0f / 60;
  drawn_at_ = now;
  if (frames_wanted_ > 0) --frames_wanted_;
  take_opened();
  if (auto choices = library_.take()) panel_->set_choices(std::move(*choices));
  const Frame& live = open_.session->latest();
  if (unsaved_.is_due()) unsaved_.save(open_.session->until(live));
  live_ = &live;
  if (open_.recording && !live.recording_problem.empty()) end_recording();
  frame_ = &playback_.select_frame(live, seconds, *open_.session);
  follow_script();
  panel::Timeline timeline = playback_.timeline(open_.scene, live);
  timeline.resume_progress = shown_progress_ = session_loader_.progress();
  timeline.is_opening = session_loader_.is_busy() && !timeline.resume_progress;
  panel_->set_timeline(timeline);
  for (std::size_t view = 0; view < panel::CameraController::views; ++view)
    panel_->view().set_saved(view, controller_.has_view(view));
  panel_->set_interaction(selection_drag_.is_on() ? panel::Interaction::selecting
                          : arrow_drag_.is_on()   ? panel::Interaction::aiming
                                                  : mouse_tool_.interaction(),
                          mouse_tool_.first_end().has_value());
  panel_->update(*frame_, seconds);
  open_.session->enable_stretches(panel_->wants_stretches());
  open_.session->hide_regions(panel_->hidden_regions());
  open_.session->enable_solid(panel_->view().section().is_on() || !panel_->measure().is_empty() ||
                              panel_->tool().tool == panel::Tool::select);
  mouse_tool_.set_section(panel_->drawing().section);
  open_.session->enable_errors(panel_->wants_errors());
  const render::Size size = window_.size();
  interface_.set_look(interface_scale(), preferences_.look.theme);
  controller_.resize(size, panel_->insets({static_cast<float>(size.width), static_cast<float>(size.height)}),
                     panel::body_count(*frame_));
  move_hands(seconds);
  panel_->set_camera(controller_.camera());
  render::DrawOptions drawing = panel_->drawing();
  drawing.hands = hands();
  drawing.stroke = mouse_tool_.stroke(seen(), *seen().surface_mesh);
  if (const auto hit = hovered(); hit && panel_->tool().tool == panel::Tool::scissors && !playback_.active())
    drawing.stroke.scissors = mouse_tool_.scissors_over(*hit, panel_->tool());
  if (!drawing.stroke.blade && !drawing.stroke.scissors && !drawing.stroke.electrode)
    drawing.stroke = panel::scripted_stroke(open_.scene.events, frame_->tick - 1, frame_->pace.rate);
  // Soft as they are, nobody sees old shadows, unless they are of a body that has gone far since.
  drawing.old_shadows = drawn_ % 2 == 1 && !is_paused() && seconds < max_shadow_age;
  bodies_.draw(*frame_, controller_, drawing);
  draw_interface(seconds);
  add_video_frame();
  std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(options_.draw_stall));
  window_.present();
  input_.drew();
  ++drawn_;
}

float Viewer::interface_scale() const {
  return panel::Interface::suitable_scale(window_.size()) * window_.content_scale() *
         static_cast<float>(preferences_.look.size);
}

void Viewer::draw_interface(float seconds) {
  window_.prepare_imgui(!input_.empty());
  interface_.begin(controller_.size(), seconds);
  draw_marks();
  const panel::PanelActions actions = panel_->draw(*frame_);
  // A tool that is dragged under the panel stays visible.
  interface_.end(mouse_tool_.acts() && panel_->covers(mouse_.x(), mouse_.y()) ? passed_panel_opacity : 1);
  remember_preferences();
  carry_out(actions);
}

/// What the panel is to know of a bare mesh.
void Viewer::show_mesh() {
  if (!open_.scene.chosen) return openings_.clear();
  const BareMeshChoices& chosen = *open_.scene.chosen;
  const bool is_as_asked = chosen.given.tets && open_.scene.mesh.file.empty();  // a surface or scan was filled so
  openings_.adopt(open_.scene.file, chosen.given, is_as_asked ? std::nullopt : std::optional(chosen.read_tets));
  mesh_folded_ = is_mesh_folded(open_.scene.file);
  panel_->mesh().set_openings(openings_);
  panel_->mesh().set_open(!mesh_folded_);
}

void Viewer::remember_preferences() {
  if (open_.scene.chosen && mesh_folded_ == panel_->mesh().is_open()) {
    mesh_folded_ = !mesh_folded_;
    remember_mesh_folded(open_.scene.file, mesh_folded_);
  }
  panel::Preferences now = panel_->preferences();
  now.window = options_.size ? preferences_.window : window_.window_size();
  if (now == preferences_) return;
  preferences_ = std::move(now);
  write_preferences(preferences_);
}

void Viewer::draw_marks() {
  const Section section = panel_->drawing().section;
  panel::each_pane(*frame_, controller_, [&](std::size_t pane, const Frame& body) {
    if (pane == 0 && (panel_->tool().tool == panel::Tool::select || !panel_->selecting().selection().is_empty())) {
      draw_nodes(panel_->selecting().selection().nodes(), body, *body.surface_mesh, section, controller_);
      if (selection_drag_.is_on())
        draw_nodes(selection_drag_.painted(), body, *body.surface_mesh, section, controller_);
      draw_loads(body.conditions->loads, panel_->selecting().selection().nodes(), body, *body.surface_mesh,
                 controller_);
    }
    if (pane == 0) draw_arrows();
    if (pane == 0) draw_measured(panel_->measure().now(), section, controller_);
    if (pane == 0) draw_reach();
    draw_forces(body, hands(), controller_);
    if (mouse_tool_.first_end())
      draw_suture_end(*mouse_tool_.first_end(), body, *body.surface_mesh, section, controller_);
    if (panel_->shows_recovery()) draw_bad_element(body, controller_);
  });
  draw_outline(selection_drag_.outline());
  panel::draw_variant_labels(*frame_, controller_);
  if (section)
    panel::each_pane(*frame_, controller_, [&](std::size_t, const Frame&) {
      const panel::SectionControl& control = panel_->view().section();
      draw_section(*section, control.handle(), control.radius(), drags_section_ || is_on_section_handle(), controller_);
    });
  if (mouse_tool_.pivot()) draw_pivot(*mouse_tool_.pivot(), controller_);
  if (drags_section_ || is_on_section_handle() || arrow_drag_.is_on() || arrow_at_mouse())
    return ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeAll);
  if (mouse_tool_.interaction() == MouseTool::Interaction::grasping)
    return ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeAll);
  if (panel_->tool().tool == panel::Tool::grasper && is_on_clamp()) return ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
  if (const auto hit = hovered()) {
    if (const auto& range = panel_->drawing().range)
      draw_reading(*hit, seen(), *seen().surface_mesh, controller_, *range);
    if (playback_.active()) return;
    const panel::ToolSettings& tool = panel_->tool();
    const bool takes_patch =
        tool.tool == panel::Tool::grasper || tool.tool == panel::Tool::pin || tool.tool == panel::Tool::remover;
    const bool paints =
        tool.tool == panel::Tool::select && panel_->selecting().drag() == panel::SelectionSection::Drag::paint;
    draw_ring(*hit, seen(), *seen().surface_mesh, controller_,
              takes_patch || paints                       ? tool.radius
              : tool.tool == panel::Tool::probe           ? tool.probe_radius
              : tool.tool == panel::Tool::cautery         ? tool.burn_radius
                                                          : 0);
    if (takes_patch) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
  }
}

/// The surface under a mouse that does nothing yet.
std::optional<render::Hit> Viewer::hovered() const {
  const bool free = mouse_tool_.interaction() == MouseTool::Interaction::none && !ImGui::IsAnyItemActive() &&
                    ImGui::IsMousePosValid();
  if (!free || panel_->covers(mouse_.x(), mouse_.y())) return std::nullopt;
  return mouse_tool_.pick(mouse_, seen(), *seen().surface_mesh);
}

bool Viewer::is_on_clamp() const {
  return mouse_tool_.interaction() == MouseTool::Interaction::none && !panel_->covers(mouse_.x(), mouse_.y()) &&
         clamp_at(mouse_, seen(), *seen().surface_mesh, controller_).has_value();
}

bool Viewer::is_on_section_handle() const {
  const panel::SectionControl& section = panel_->view().section();
  if (!section.is_on() || mouse_tool_.interaction() != MouseTool::Interaction::none) return false;
  return !panel_->covers(mouse_.x(), mouse_.y()) &&
         (controller_.pixel(section.handle()) - mouse_).norm() < panel::em(section_handle);
}

void Viewer::follow_script() {
  const std::vector<Event>& events = open_.scene.events;
  for (; next_event_ < events.size() && events[next_event_].tick < frame_->tick; ++next_event_)
    panel_->sync(events[next_event_].command);
}

/// A question is about the work on the body that is there: it is answered before another body comes.
void Viewer::take_opened() {
  if (panel_->asks()) return;
  auto result = session_loader_.take();
  if (!result) return;
  if (auto* problem = std::get_if<std::string>(&*result)) {
    restores_ = false;
    return panel_->show_error("Could not be opened", *problem);
  }
  OpenScene& opened = std::get<OpenScene>(*result);
  const bool runs = opened.resumed && run_after_resume_;
  const bool restored = std::exchange(restores_, false);
  if (restored) opened.resumed.reset();  // a scene as any other from here on
  if (!opened.resumed || opened.recording) unsaved_.saved();
  adopt(std::move(opened));
  if (restored) {
    unsaved_.adopt(*left_work_);
    panel_->notify("Restored as it was left; Space runs.");
  }
  if (!open_.resumed) return;
  if (open_.recording)
    panel_->notify("Resumed, recorded in " + open_.recording->string());
  else if (playback_.active() || open_.comparisons.empty())
    panel_->notify("Resumed");
  if (runs) open_.session->play();
}

/// Ends what is being replayed. Work of last time stays in its file, and is offered again.
void Viewer::cancel_replay() {
  session_loader_.cancel();
  if (std::exchange(restores_, false))
    panel_->notify("Not restored: what was done last time is offered at the next start.");
}

/// An edit ends what is being replayed, since the body that comes of it would be without the edit.
void Viewer::cancel_replay_for_edit() {
  if (!session_loader_.is_replaying() || restores_) return;
  cancel_replay();
  panel_->notify("The replay has ended, since the body was changed: compare, or resume, again.");
}

/// Where the recording cannot go on, what was done is in no complete one: unsaved work.
void Viewer::end_recording() {
  panel_->show_error("The recording ended early", live_->recording_problem +
                                                      "\nWhat was done since the start is unsaved work now: it is "
                                                      "asked about before the window closes.");
  open_.recording.reset();
  unsaved_.recording_ended();
  recording_problem_ = live_->recording_problem;
}

std::string Viewer::recording_problem() {
  const std::string& latest = newest().recording_problem;  // may have come after the last picture
  return latest.empty() ? recording_problem_ : latest;
}

/// What is done to a body that is about to be replaced would be lost.
bool Viewer::is_being_replaced() const {
  return session_loader_.is_busy() && (restores_ || !session_loader_.progress());
}

std::string Viewer::why_busy() const {
  if (session_loader_.is_replaying() && !restores_) return "The session is being replayed. Esc ends that.";
  return restores_ ? "What was done last time is being restored. Esc ends that." : "Another file is being opened.";
}

void Viewer::post(std::vector<Command>& commands) {
  const auto lets_go = [](const Command& command) { return std::holds_alternative<Release>(command); };
  const bool edits = !std::all_of(commands.begin(), commands.end(), lets_go);
  if (edits && is_being_replaced()) {
    panel_->notify(why_busy());
    return commands.clear();
  }
  if (edits) cancel_replay_for_edit();
  const auto does_nothing = [&](const Command& command) {
    const auto* step = std::get_if<StepHistory>(&command);
    if (!step) return false;
    return !live_->undo_list || (step->by < 0 ? live_->undo_list->past : live_->undo_list->future).empty();
  };
  for (Command& command : commands) {
    if (!open_.recording && !does_nothing(command)) unsaved_.done(command);
    open_.session->post(std::move(command));
  }
  commands.clear();
}

}  // namespace heml::window
