// Viewer: carries out the actions and requests of the panel.
#include <fmt/format.h>

#include <app/window/patch.hpp>
#include <app/window/screenshot.hpp>
#include <app/window/viewer.hpp>
#include <heml/base/error.hpp>
#include <heml/base/write_file.hpp>
#include <utility>

namespace heml::window {

void Viewer::let_go() {
  std::vector<Command> commands;
  mouse_tool_.let_go(commands);
  post(commands);
}

void Viewer::carry_out(const panel::PanelActions& actions) {
  std::vector<Command> commands = actions.commands;
  if (!commands.empty()) {  // they apply to the live body
    if (session_loader_.progress()) session_loader_.cancel();
    past_.end(*open_.session);
  }
  // Releases the mouse tool before a reset: it would pull on the reset body.
  for (const Command& command : actions.commands)
    if (std::holds_alternative<Reset>(command)) let_go();
  post(commands);
  if (actions.show) open_.session->show(*actions.show);
  for (const panel::Request request : actions.requests) carry_out(request);
  if (actions.seek_to) {
    let_go();
    past_.look(*actions.seek_to, *open_.session);
  }
  use_view(actions);
  if (actions.list_folder) list(*actions.list_folder);
  if (actions.open) open(*actions.open);
  if (actions.comparisons) compare(*actions.comparisons);
  if (!actions.commands.empty() || !actions.requests.empty() || actions.show || actions.seek_to ||
      actions.list_folder || actions.open || actions.comparisons || actions.view || actions.keep_view)
    changed();
}

void Viewer::carry_out(panel::Request request) {
  switch (request) {
    case panel::Request::play:
      return past_.active() ? past_.play(true) : open_.session->play();
    case panel::Request::pause:
      return past_.active() ? past_.play(false) : open_.session->pause();
    case panel::Request::step:
      return past_.active() ? past_.step(1, *open_.session) : open_.session->step_once();
    case panel::Request::earlier:
    case panel::Request::later:
    case panel::Request::first:
      return look(request);
    case panel::Request::now:
      return to_the_present();
    case panel::Request::resume:
      return resume();
    case panel::Request::film:
      return film();
    case panel::Request::list:
      return list({});
    case panel::Request::fit:
      return fit();
    case panel::Request::screenshot:
      return save_screenshot();
    case panel::Request::save:
      return save_scene();
    case panel::Request::release:
      return let_go();
    case panel::Request::remove:
      return remove_tissue();
    case panel::Request::quit:
      quits_ = true;
      return;
  }
}

void Viewer::open(const std::filesystem::path& path) {
  if (session_loader_.under_way()) return panel_->say("Another file is being opened.");
  panel_->say("Opening " + path.filename().string() + " …");
  session_loader_.begin(path, options_.record);
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
  if (!past_.active()) return panel_->say("Show a past time first: drag the timeline, or press Left.");
  if (session_loader_.under_way()) return panel_->say("Another session is being opened.");
  plays_on_ = past_.ran();
  resume_with(open_.comparisons);
}

void Viewer::resume_with(const std::vector<std::string>& comparisons) {
  Scene scene = open_.session->until(*frame_);
  scene.view = open_.scene.view;
  scene.view.field = frame_->field;
  scene.view.wireframe = panel_->drawing().wireframe;
  std::optional<std::filesystem::path> record = options_.record;
  if (!record && open_.was_recorded) record = open_.scene.file;
  past_.play(false);
  session_loader_.resume(std::move(scene), record, comparisons);
}

/// Restarts the session with these comparison runs, replayed to the shown time.
void Viewer::compare(const std::vector<std::string>& variants) {
  if (session_loader_.under_way()) return panel_->say("Another session is being opened.");
  plays_on_ = past_.active() ? past_.ran() : !frame_->paused;
  resume_with(variants);
}

void Viewer::look(panel::Request where) {
  let_go();
  switch (where) {
    case panel::Request::earlier:
      return past_.step(-1, *open_.session);
    case panel::Request::later:
      return past_.step(1, *open_.session);
    default:
      return past_.look(0, *open_.session);
  }
}

void Viewer::to_the_present() {
  if (session_loader_.progress()) return session_loader_.cancel();
  past_.end(*open_.session);
}

/// Removes the tissue under the mouse, else round the grasped node.
void Viewer::remove_tissue() {
  if (past_.active()) return panel_->say(past_is_fixed);
  const SurfaceMesh& surface_mesh = *seen().surface_mesh;
  const bool points = mouse_tool_.doing() == MouseTool::Doing::nothing && !panel_->covers(mouse_.x(), mouse_.y());
  const auto hit = points ? mouse_tool_.under(mouse_, seen(), surface_mesh) : std::nullopt;
  const int node = hit                   ? surface_mesh.nodes[static_cast<std::size_t>(hit->node)]
                   : frame_->tool.active ? frame_->tool.node
                                         : -1;
  ElementSelection which;
  which.tets = elements_around(node, surface_mesh, panel_->tool().radius);
  if (which.tets.empty()) return panel_->say("Point at the tissue to remove, or grasp it.");
  open_.session->post(RemoveElements{which});
}

void Viewer::save_screenshot() {
  try {
    const auto path = save_picture(render::read_pixels(controller_.size()), open_.scene.name);
    panel_->say("Saved " + path.string());
  } catch (const InputError& error) {
    panel_->say(error.what());
  }
}

/// Writes the scene as opened, with the current settings. Tool actions are left to recordings.
void Viewer::save_scene() {
  Scene scene = as_opened_;
  panel_->write_into(scene);
  scene.tables.clear();
  for (const TableState& state : tools_of<TableState>(frame_->tools)) scene.tables.push_back(state.table);
  try {
    const auto path = free_name(scene.name, ".json");
    write_file(path, scene_text(scene, std::filesystem::current_path()));
    panel_->say("Saved " + path.string());
  } catch (const InputError& error) {
    panel_->say(error.what());
  }
}

void Viewer::film() {
  if (video_recorder_ && video_recorder_->is_finishing()) return panel_->say("The last video is still being encoded.");
  if (video_recorder_) return video_recorder_->finish();
  try {
    video_recorder_ = std::make_unique<VideoRecorder>(open_.scene.name, controller_.size());
    panel_->say("Recording video; V stops.");
  } catch (const InputError& error) {
    panel_->say(error.what());
  }
}

/// Adds the drawn image, panel included, to the video.
void Viewer::take_picture() {
  if (!video_recorder_) return panel_->view().set_filmed(std::nullopt);
  if (const auto outcome = video_recorder_->take_outcome()) {
    video_recorder_.reset();
    return panel_->say(*outcome);
  }
  panel_->view().set_filmed(video_recorder_->pictures());
  const double time = static_cast<double>(frame_->tick) / frame_->pace.rate;
  if (past_.active() || !video_recorder_->due(time)) return;
  if (video_recorder_->size() == controller_.size())
    return video_recorder_->add_frame(render::read_pixels(controller_.size()), time);
  panel_->say("The window was resized: recording stopped.");
  video_recorder_->finish();
}

void Viewer::use_view(const panel::PanelActions& actions) {
  if (actions.keep_view) {
    controller_.keep(*actions.keep_view);
    panel_->say(fmt::format("View {} saved: F{} restores it.", *actions.keep_view + 1, *actions.keep_view + 5));
  }
  if (actions.view && !controller_.go_to(*actions.view))
    panel_->say(fmt::format("No view saved there: Ctrl+F{} saves one.", *actions.view + 5));
}

}  // namespace heml::window
