#include <algorithm>
#include <filesystem>
#include <heml/scenario/installed_scene.hpp>
#include <heml/scenario/scene.hpp>

namespace heml {

std::string scene_path(const std::string& given) {
  const auto is_plain = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-' || c == '/'; };
  if (given.empty() || given.front() == '/' || !std::all_of(given.begin(), given.end(), is_plain)) return given;
  std::error_code ignored;
  if (std::filesystem::exists(given, ignored)) return given;
  const std::filesystem::path file = assets_folder() / "scenes" / (given + ".json");
  return std::filesystem::is_regular_file(file, ignored) ? file.string() : given;
}

}  // namespace heml
