// Viewer: carries out the actions and requests of the panel.
#include <fmt/format.h>

#include <algorithm>
#include <app/window/elements_around.hpp>
#include <app/window/run_program.hpp>
#include <app/window/viewer.hpp>
#include <heml/base/error.hpp>
#include <utility>

namespace heml::window {

void Viewer::release_tool() {
  std::vector<Command> commands;
  mouse_tool_.cancel(commands);
  post(commands);
}

void Viewer::carry_out(const panel::PanelActions& actions) {
  std::vector<Command> commands = actions.commands;
  if (!commands.empty()) {  // they apply to the live body
    cancel_replay_for_edit();
    playback_.end(*open_.session);
  }
  // Releases hands before a reset or an undo, which they would pull on, and grasps that an undo restores: no button
  // holds them.
  const auto restores = [](const Command& command) { return std::holds_alternative<StepHistory>(command); };
  const bool has_undo = std::any_of(commands.begin(), commands.end(), restores);
  for (const Command& command : actions.commands)
    if (std::holds_alternative<Reset>(command) || restores(command)) release_hands();
  if (has_undo) commands.emplace_back(Release{});
  for (const PluggedHand* each : {&gamepad_, &spacemouse_})
    if (has_undo && each->hand.has_grasped()) commands.emplace_back(Release{each->hand.number()});
  post(commands);
  if (actions.show) open_.session->show(*actions.show);
  for (const panel::Request request : actions.requests) carry_out(request);
  if (actions.seek_to) {
    release_hands();
    playback_.seek(*actions.seek_to, *open_.session);
  }
  use_view(actions);
  if (actions.list_folder) list(*actions.list_folder);
  if (actions.open) open(*actions.open);
  if (actions.mesh_options) open_again(*actions.mesh_options);
  if (actions.answer) answer(*actions.answer);
  if (actions.open_folder) start_program({find_program("xdg-open").string(), actions.open_folder->string()});
  if (actions.comparisons) compare(*actions.comparisons);
  if (!actions.commands.empty() || !actions.requests.empty() || actions.answer || actions.show || actions.seek_to ||
      actions.list_folder || actions.open || actions.mesh_options || actions.comparisons || actions.view ||
      actions.save_view || actions.look || actions.orthographic)
    changed();
}

void Viewer::carry_out(panel::Request request) {
  switch (request) {
    case panel::Request::play:
      return playback_.active() ? playback_.play(true) : open_.session->play();
    case panel::Request::pause:
      return playback_.active() ? playback_.play(false) : open_.session->pause();
    case panel::Request::step:
      return playback_.active() ? playback_.step(1, *open_.session) : open_.session->step_once();
    case panel::Request::previous_frame:
    case panel::Request::next_frame:
    case panel::Request::first_frame:
      return seek(request);
    case panel::Request::live:
      return go_live();
    case panel::Request::resume:
      return resume();
    case panel::Request::record_video:
      toggle_recording();
      return update_title();
    case panel::Request::list:
      return list({});
    case panel::Request::fit:
      return fit(ball_of_bodies());
    case panel::Request::screenshot:
      return save_screenshot();
    case panel::Request::save:
      return save_scene();
    case panel::Request::release:
      forget_selection();
      return release_tool();
    case panel::Request::leave_clamp:
      return leave_clamp();
    case panel::Request::remove:
      return remove_tissue();
    case panel::Request::save_measured:
      return save_measured();
    case panel::Request::quit:
      return ask_to_quit();
  }
}

void Viewer::open(const std::filesystem::path& path) {
  ask_about_work("Save what was done before another scene is opened?", [this, path] { open_now(path); });
}

/// Reads the bare mesh of the scene again.
void Viewer::open_again(const BareMeshOptions& options) {
  ask_about_work("Save what was done before the mesh is read again?",
                 [this, options] { open_now(open_.scene.file, options, open_.comparisons); });
}

void Viewer::open_now(const std::filesystem::path& path, const BareMeshOptions& options,
                      const std::vector<std::string>& comparisons) {
  if (session_loader_.is_busy()) return panel_->notify(why_busy());
  panel_->notify("Opening " + path.filename().string() + " …");
  session_loader_.begin(path, options_.record, options, comparisons);
}

/// folder: empty for the last one; at first for that of the scene's file, or the working directory for an installed
/// scene.
void Viewer::list(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  if (!folder.empty()) return library_.list_folder(folder);
  if (std::exchange(listed_, true)) return library_.list_folder({});
  std::error_code failed;
  const bool is_ours = open_.scene.file.starts_with(assets_folder().string());
  const fs::path parent = fs::absolute(open_.scene.file, failed).parent_path();
  library_.list_folder(is_ours || failed ? fs::current_path(failed) : parent);
}

/// Resumes from the shown time in a new session; a recording goes on in a new file.
void Viewer::resume() {
  if (!playback_.active()) return panel_->notify("Show a past time first: drag the timeline, or press Left.");
  if (session_loader_.is_busy()) return panel_->notify("Another session is being opened.");
  run_after_resume_ = playback_.was_running();
  resume_with(open_.comparisons);
}

void Viewer::resume_with(const std::vector<std::string>& comparisons) {
  Scene scene = open_.session->until(*frame_);
  scene.view = open_.scene.view;
  scene.view.field = frame_->field;
  scene.view.wireframe = panel_->drawing().wireframe;
  scene.view.orthographic = controller_.is_orthographic();
  panel_->view().section().write_into(scene.view);
  panel_->view().write_range_into(scene.view);
  scene.view.hidden = panel_->hidden_regions();
  std::optional<std::filesystem::path> record = options_.record;
  if (!record && open_.was_recorded) record = open_.scene.file;
  playback_.play(false);
  session_loader_.resume(std::move(scene), record, comparisons);
}

/// Restarts the session with these comparison runs, replayed to the shown time.
void Viewer::compare(const std::vector<std::string>& variants) {
  if (session_loader_.is_busy()) return panel_->notify("Another session is being opened.");
  run_after_resume_ = playback_.active() ? playback_.was_running() : !frame_->paused;
  resume_with(variants);
}

void Viewer::seek(panel::Request where) {
  release_hands();
  switch (where) {
    case panel::Request::previous_frame:
      return playback_.step(-1, *open_.session);
    case panel::Request::next_frame:
      return playback_.step(1, *open_.session);
    default:
      return playback_.seek(0, *open_.session);
  }
}

void Viewer::go_live() {
  if (session_loader_.is_replaying()) return cancel_replay();
  if (live_->fast_forward_target > 0) return open_.session->fast_forward_to(0);
  playback_.end(*open_.session);
}

void Viewer::leave_clamp() {
  std::vector<Command> commands;
  if (const Status left = mouse_tool_.leave_clamp(seen(), commands); !left.ok()) return panel_->notify(left.message());
  post(commands);
}

/// Removes the clamp under the mouse, else the tissue there, else the tissue round the grasped node.
void Viewer::remove_tissue() {
  if (playback_.active()) return panel_->notify(past_is_read_only);
  const SurfaceMesh& surface_mesh = *seen().surface_mesh;
  std::vector<Command> release;
  if (mouse_tool_.remove_clamp(mouse_, seen(), surface_mesh, release)) return post(release);
  const bool points =
      mouse_tool_.interaction() == MouseTool::Interaction::none && !panel_->covers(mouse_.x(), mouse_.y());
  const auto hit = points ? mouse_tool_.pick(mouse_, seen(), surface_mesh) : std::nullopt;
  const GraspState* grasp = find_grasp(frame_->tools, 0);
  const int node = hit ? surface_mesh.nodes[static_cast<std::size_t>(hit->node)] : grasp ? grasp->node : -1;
  ElementSelection which;
  which.tets = elements_around(node, surface_mesh, panel_->tool().radius);
  if (which.tets.empty()) return panel_->notify("Point at the tissue to remove, or grasp it.");
  std::vector<Command> commands{RemoveElements{which}};
  post(commands);
}

void Viewer::use_view(const panel::PanelActions& actions) {
  if (actions.save_view) {
    controller_.save_view(*actions.save_view);
    remember_views(as_opened_.file, controller_.saved_views());
    panel_->notify(fmt::format("View {} saved: F{} restores it.", *actions.save_view + 1, *actions.save_view + 5));
  }
  if (actions.look) controller_.look(*actions.look);
  if (actions.orthographic) controller_.set_orthographic(*actions.orthographic);
  if (actions.view && !controller_.restore_view(*actions.view))
    panel_->notify(fmt::format("No view saved there: Ctrl+F{} saves one.", *actions.view + 5));
}

}  // namespace heml::window
