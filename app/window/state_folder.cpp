#include <algorithm>
#include <app/window/state_folder.hpp>
#include <cstdlib>
#include <fstream>
#include <heml/base/error.hpp>
#include <heml/base/write_file.hpp>
#include <iterator>
#include <string>

namespace heml::window {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t max_recent_files = 20;

/// A file of the state folder; empty: there is none.
fs::path state_file(const char* name) {
  const fs::path folder = state_folder();
  return folder.empty() ? fs::path() : folder / name;
}

/// The list of recent files, one path per line.
fs::path list_file() { return state_file("recent"); }
fs::path preferences_file() { return state_file("panel"); }

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

}  // namespace

fs::path state_folder() {
  const char *state = std::getenv("XDG_STATE_HOME"), *home = std::getenv("HOME");
  if (state && *state) return fs::path(state) / "heml";
  return home && *home ? fs::path(home) / ".local" / "state" / "heml" : fs::path();
}

std::vector<fs::path> recent_files() {
  std::vector<fs::path> files;
  std::ifstream list(list_file());
  for (std::string line; files.size() < max_recent_files && std::getline(list, line);)
    if (!line.empty()) files.emplace_back(line);
  return files;
}

void remember_file(const fs::path& path) {
  std::error_code failed;
  const fs::path list = list_file(), whole = fs::weakly_canonical(path, failed);
  if (failed || list.empty() || whole.string().find('\n') != std::string::npos) return;
  std::vector<fs::path> files = recent_files();
  std::erase(files, whole);
  files.insert(files.begin(), whole);
  files.resize(std::min(files.size(), max_recent_files));
  std::string text;
  for (const fs::path& file : files) text += file.string() + '\n';
  write_optional(list, text);
}

panel::Preferences read_preferences() {
  std::ifstream file(preferences_file());
  return panel::preferences_from(std::string(std::istreambuf_iterator<char>(file), {}));
}

void write_preferences(const panel::Preferences& preferences) {
  write_optional(preferences_file(), to_text(preferences));
}

}  // namespace heml::window
