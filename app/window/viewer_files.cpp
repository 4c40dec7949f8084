// Viewer: the files that it writes, pictures, films, scenes and what was measured.
#include <fmt/format.h>

#include <algorithm>
#include <app/window/lost_files.hpp>
#include <app/window/run_program.hpp>
#include <app/window/screenshot.hpp>
#include <app/window/viewer.hpp>
#include <heml/base/error.hpp>
#include <heml/base/write_file.hpp>
#include <heml/mesh/write.hpp>
#include <heml/scenario/adapt.hpp>
#include <utility>

namespace heml::window {

/// Says where something is, with a button that opens the folder where the system can.
void Viewer::notify_saved(const std::string& text, const std::filesystem::path& folder) {
  panel_->notify(text + why_saved_in(folder), find_program("xdg-open").empty() ? std::filesystem::path() : folder);
}

void Viewer::save_screenshot() {
  try {
    const auto path = save_image(render::read_pixels(controller_.size()), open_.scene.name);
    notify_saved("Saved " + path.string(), path.parent_path());
  } catch (const InputError& error) {
    panel_->notify(error.what());
  }
}

/// What was chosen by hand on a mesh that the scene refines has its numbers: that mesh is written as well, and the
/// scene is of it.
bool Viewer::numbers_refined_mesh() const {
  return as_opened_.mesh.refine &&
         (!live_->regions->tagged.empty() || live_->conditions->boundary != opened_conditions_->boundary ||
          live_->conditions->loads != opened_conditions_->loads);
}

/// Writes the scene as opened, with the settings and tables of now, also while a past frame is shown. Tool actions are
/// left to recordings.
void Viewer::save_scene() {
  try {
    const auto path = unused_path(as_opened_.name, ".json");
    Scene scene = as_opened_;
    if (numbers_refined_mesh()) {
      const auto mesh_file = unused_path(as_opened_.name, ".vtu", "-refined");
      AdaptedScene refined = refined_scene(as_opened_, mesh_file);
      write_tet_mesh(mesh_file, refined.mesh);
      scene = std::move(refined.scene);
    }
    const std::string lost = keep_lost_files(scene);
    panel_->write_into(scene);
    scene.tables.clear();
    for (const TableState& state : tools_of<TableState>(live_->tools)) scene.tables.push_back(state.table);
    write_conditions(scene);
    write_regions(scene);
    write_file(path, scene_text(scene, path.parent_path()));
    unsaved_.scene_saved();
    panel_->mesh().set_kept(path);
    notify_saved("Saved " + path.string() + lost, path.parent_path());
  } catch (const InputError& error) {
    panel_->show_error("Could not be saved", error.what());
  }
}

/// Boundary and loads where they are not as opened; nodes that cuts have added are of no use to the scene.
void Viewer::write_conditions(Scene& scene) const {
  const auto of_scene = [&](std::vector<int> nodes) {
    std::erase_if(nodes, [&](int node) { return static_cast<std::size_t>(node) >= opened_conditions_->mesh_nodes; });
    return Selection{std::move(nodes), {}, {}};
  };
  const auto is_empty = [](const auto& entry) { return entry.where.nodes.empty(); };
  const Conditions& now = *live_->conditions;
  if (now.boundary != opened_conditions_->boundary) {
    scene.boundary.clear();
    for (const Boundary& entry : now.boundary) scene.boundary.push_back({of_scene(entry.nodes), entry});
    std::erase_if(scene.boundary, is_empty);
  }
  if (now.loads == opened_conditions_->loads) return;
  scene.loads.clear();
  for (const Load& entry : now.loads) scene.loads.push_back({of_scene(entry.nodes), entry});
  std::erase_if(scene.loads, is_empty);
}

/// Regions made since, by the elements that the scene's mesh has.
void Viewer::write_regions(Scene& scene) const {
  const auto count = static_cast<int>(live_->surface_mesh->uncut_elements);
  for (const TaggedRegion& region : live_->regions->tagged) {
    RegionTag tag{{}, {region.tets, {}, {}, {}}, region.name, region.number};
    std::erase_if(tag.which.tets, [&](int t) { return t >= count; });
    if (!tag.which.tets.empty()) scene.regions.push_back(std::move(tag));
  }
}

void Viewer::save_measured() {
  try {
    const auto path = unused_path(open_.scene.name, ".csv", "-measured");
    write_file(path, panel_->measure().csv());
    notify_saved("Saved " + path.string(), path.parent_path());
  } catch (const InputError& error) {
    panel_->notify(error.what());
  }
}

void Viewer::toggle_recording() {
  if (video_recorder_ && video_recorder_->is_finishing())
    return panel_->notify("The last video is still being encoded.");
  if (video_recorder_) return video_recorder_->finish();
  try {
    video_recorder_ = std::make_unique<VideoRecorder>(open_.scene.name, controller_.size());
    panel_->notify("Filming; V stops.");
  } catch (const InputError& error) {
    panel_->notify(error.what());
  }
}

/// Adds the drawn image, panel included, to the video.
void Viewer::add_video_frame() {
  if (!video_recorder_) return panel_->set_filmed_frames(std::nullopt);
  if (const auto outcome = video_recorder_->take_outcome()) {
    const std::filesystem::path folder = video_recorder_->folder().parent_path();
    video_recorder_.reset();
    update_title();
    return notify_saved(*outcome, folder);
  }
  panel_->set_filmed_frames(video_recorder_->is_finishing() ? std::nullopt
                                                            : std::optional(video_recorder_->frame_count()));
  const double time = frame_->elapsed;
  if (playback_.active() || !video_recorder_->due(time)) return;
  if (video_recorder_->size() == controller_.size())
    return video_recorder_->add_frame(render::read_pixels(controller_.size()), time);
  panel_->notify("The window was resized: the film ends here.");
  video_recorder_->finish();
  update_title();
}

}  // namespace heml::window
