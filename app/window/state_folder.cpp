#include <algorithm>
#include <app/window/state_folder.hpp>
#include <cstdlib>
#include <fstream>
#include <heml/base/error.hpp>
#include <heml/base/write_file.hpp>
#include <string>

namespace heml::window {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t max_recent_files = 20;

/// The list of recent files, one path per line.
fs::path list_file() {
  const fs::path folder = state_folder();
  return folder.empty() ? fs::path() : folder / "recent";
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
  fs::create_directories(list.parent_path(), failed);
  std::string text;
  for (const fs::path& file : files) text += file.string() + '\n';
  try {
    write_file(list, text);
  } catch (const InputError&) {  // the list is optional
  }
}

}  // namespace heml::window
