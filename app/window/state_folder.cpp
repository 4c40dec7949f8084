#include <fmt/format.h>

#include <algorithm>
#include <app/window/state_folder.hpp>
#include <cstdlib>
#include <fstream>
#include <heml/base/error.hpp>
#include <heml/base/write_file.hpp>
#include <iterator>
#include <sstream>
#include <string>

namespace heml::window {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t max_recent_files = 20, max_scenes_with_views = 100, max_folded_meshes = 100;

/// A file of the state folder; empty: there is none.
fs::path state_file(const char* name) {
  const fs::path folder = state_folder();
  return folder.empty() ? fs::path() : folder / name;
}

/// The list of recent files, one path per line.
fs::path list_file() { return state_file("recent"); }
fs::path folded_file() { return state_file("folded-meshes"); }
fs::path preferences_file() { return state_file("panel"); }
fs::path views_file() { return state_file("views"); }

struct ScenesViews {
  std::string scene;  ///< its path
  panel::CameraController::SavedViews views;
};

/// A line: number of the view, target, radius, distance, azimuth, elevation, whether it is orthographic, and the path.
std::string line_of(std::size_t view, const render::CameraPose& pose, const std::string& scene) {
  return fmt::format("{} {} {} {} {} {} {} {} {} {}\n", view + 1, pose.target.x(), pose.target.y(), pose.target.z(),
                     pose.radius, pose.distance, pose.azimuth, pose.elevation, pose.orthographic ? 1 : 0, scene);
}

/// Adds what a line says; one that says nothing of use is skipped.
void read_line(const std::string& line, std::vector<ScenesViews>& all) {
  std::istringstream words(line);
  std::size_t view = 0;
  render::CameraPose pose;
  std::string scene;
  words >> view >> pose.target.x() >> pose.target.y() >> pose.target.z() >> pose.radius >> pose.distance >>
      pose.azimuth >> pose.elevation >> pose.orthographic >> std::ws;
  if (!std::getline(words, scene) || scene.empty() || view < 1 || view > panel::CameraController::views) return;
  if (!(pose.radius > 0) || !(pose.distance > 0)) return;
  if (all.empty() || all.back().scene != scene) all.push_back({scene, {}});
  all.back().views[view - 1] = pose;
}

/// The scene written last comes first.
std::vector<ScenesViews> read_all_views() {
  std::vector<ScenesViews> all;
  std::ifstream file(views_file());
  for (std::string line; std::getline(file, line);) read_line(line, all);
  return all;
}

/// Empty: it has none, or one that no line can hold.
std::string whole_path(const fs::path& file) {
  std::error_code failed;
  const fs::path absolute = fs::absolute(file, failed);
  if (file.empty() || failed) return {};
  const std::string whole = fs::weakly_canonical(absolute, failed).string();
  return failed || whole.find('\n') != std::string::npos ? std::string() : whole;
}

/// Writes a file that the program can do without.
void write_optional(const fs::path& file, const std::string& text) {
  std::error_code failed;
  if (file.empty()) return;
  fs::create_directories(file.parent_path(), failed);
  try {
    write_file(file, text);
  } catch (const InputError&) {
  }
}

/// One path per line.
std::vector<fs::path> read_paths(const fs::path& list, std::size_t most) {
  std::vector<fs::path> files;
  std::ifstream lines(list);
  for (std::string line; files.size() < most && std::getline(lines, line);)
    if (!line.empty()) files.emplace_back(line);
  return files;
}

/// Puts a file first in a list, or takes it out.
void update_paths(const fs::path& list, const fs::path& path, bool is_in, std::size_t most) {
  const fs::path whole = whole_path(path);
  if (list.empty() || whole.empty()) return;
  std::vector<fs::path> files = read_paths(list, most);
  std::erase(files, whole);
  if (is_in) files.insert(files.begin(), whole);
  files.resize(std::min(files.size(), most));
  std::string text;
  for (const fs::path& file : files) text += file.string() + '\n';
  write_optional(list, text);
}

}  // namespace

fs::path state_folder() {
  const char *state = std::getenv("XDG_STATE_HOME"), *home = std::getenv("HOME");
  if (state && *state) return fs::path(state) / "heml";
  return home && *home ? fs::path(home) / ".local" / "state" / "heml" : fs::path();
}

std::vector<fs::path> recent_files() { return read_paths(list_file(), max_recent_files); }

void remember_file(const fs::path& path) { update_paths(list_file(), path, true, max_recent_files); }

bool is_mesh_folded(const fs::path& mesh) {
  const std::vector<fs::path> folded = read_paths(folded_file(), max_folded_meshes);
  return std::find(folded.begin(), folded.end(), fs::path(whole_path(mesh))) != folded.end();
}

void remember_mesh_folded(const fs::path& mesh, bool folded) {
  update_paths(folded_file(), mesh, folded, max_folded_meshes);
}

panel::CameraController::SavedViews saved_views(const fs::path& scene) {
  const std::string path = whole_path(scene);
  for (const auto& [of, views] : read_all_views())
    if (of == path) return views;
  return {};
}

void remember_views(const fs::path& scene, const panel::CameraController::SavedViews& views) {
  const std::string path = whole_path(scene);
  if (path.empty()) return;
  std::vector<ScenesViews> all = read_all_views();
  std::erase_if(all, [&](const ScenesViews& other) { return other.scene == path; });
  all.insert(all.begin(), {path, views});
  all.resize(std::min(all.size(), max_scenes_with_views));
  std::string text;
  for (const auto& [of, saved] : all)
    for (std::size_t view = 0; view < saved.size(); ++view)
      if (saved[view]) text += line_of(view, *saved[view], of);
  write_optional(views_file(), text);
}

panel::Preferences read_preferences() {
  std::ifstream file(preferences_file());
  return panel::preferences_from(std::string(std::istreambuf_iterator<char>(file), {}));
}

void write_preferences(const panel::Preferences& preferences) {
  write_optional(preferences_file(), to_text(preferences));
}

}  // namespace heml::window
