#include <fmt/format.h>

#include <algorithm>
#include <heml/base/error.hpp>
#include <heml/base/write_file.hpp>
#include <heml/scenario/input_files.hpp>
#include <heml/scenario/load_mesh.hpp>
#include <string>

namespace heml {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view frame_prefix = "frame_";

bool is_frame(const std::string& name, std::string_view ending) {
  if (!name.starts_with(frame_prefix) || !name.ends_with(ending)) return false;
  const std::string_view number = std::string_view(name).substr(frame_prefix.size());
  const std::size_t digits = std::min(number.find_first_not_of("0123456789"), number.size());
  return digits > 0 && number.substr(digits) == ending;
}

}  // namespace

std::vector<fs::path> input_files(const Scene& scene) {
  std::vector<fs::path> files{scene.file};
  for (const fs::path& file : {scene.mesh.file, scene.mesh.surface, scene.mesh.labels, scene.initial_positions}) {
    if (file.empty()) continue;
    files.push_back(file);
    files.push_back(fs::path(scene.file).parent_path() / file.filename());  // where find_file() looks next
    if (file.extension() == ".node" || file.extension() == ".ele")
      for (const char* half : {".node", ".ele"}) files.push_back(fs::path(file).replace_extension(half));
  }
  if (scene.skin)
    for (const fs::path& file : {scene.skin->file, scene.skin->texture})
      if (!file.empty()) files.push_back(file);
  if (!scene.mesh.asset.empty()) files.push_back(asset_mesh_file(scene.mesh.asset));
  return files;
}

std::vector<fs::path> frames_in(const fs::path& folder, std::string_view ending) {
  std::vector<fs::path> frames;
  std::error_code failed;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, failed))
    if (is_frame(entry.path().filename().string(), ending)) frames.push_back(entry.path());
  return frames;
}

void refuse_overwriting(const std::vector<fs::path>& inputs, const std::vector<fs::path>& outputs,
                        std::string_view option) {
  for (const fs::path& output : outputs)
    for (const fs::path& input : inputs) {
      std::error_code failed;
      if (!fs::equivalent(input, output, failed) || !fs::is_regular_file(output, failed)) continue;
      throw InputError(output.string(), "",
                       fmt::format("is read by this run{} and would be overwritten",
                                   input == output ? "" : fmt::format(" (as '{}')", input.string())),
                       fmt::format("give another {}", option));
    }
}

void check_output_file(const std::vector<fs::path>& inputs, const fs::path& output, std::string_view option) {
  refuse_overwriting(inputs, {output}, option);
  expect_writable_file(output, option);
}

void check_output_folder(const std::vector<fs::path>& inputs, const fs::path& folder,
                         const std::vector<fs::path>& outputs, std::string_view option) {
  refuse_overwriting(inputs, outputs, option);
  expect_writable_folder(folder, option);
}

}  // namespace heml
