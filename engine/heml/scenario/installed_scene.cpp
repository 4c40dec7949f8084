#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <heml/base/error.hpp>
#include <heml/scenario/installed_scene.hpp>
#include <heml/scenario/json_cursor.hpp>
#include <heml/scenario/scene.hpp>

namespace heml {

namespace {

/// The name in a folder of scenes that is spelt most like one that is not; empty: the folder has none.
std::string nearest_scene(const std::filesystem::path& scenes, const std::string& wrong) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(scenes, ignored))
    if (entry.path().extension() == ".json")
      names.push_back(std::filesystem::relative(entry.path(), scenes, ignored).replace_extension().string());
  std::sort(names.begin(), names.end());
  const std::vector<std::string_view> views(names.begin(), names.end());
  return views.empty() ? std::string() : std::string(nearest_name(wrong, views));
}

}  // namespace

std::string scene_path(const std::string& given) {
  const auto is_plain = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-' || c == '/'; };
  if (given.empty() || given.front() == '/' || !std::all_of(given.begin(), given.end(), is_plain)) return given;
  std::error_code ignored;
  if (std::filesystem::exists(given, ignored)) return given;
  const std::filesystem::path scenes = assets_folder() / "scenes", file = scenes / (given + ".json");
  if (std::filesystem::is_regular_file(file, ignored)) return file.string();
  const std::string near = nearest_scene(scenes, given);
  if (edit_distance(near, given) <= given.size() / 4)
    throw InputError(given, "", "is no file, and no installed scene", fmt::format("did you mean '{}'?", near));
  return given;
}

}  // namespace heml
