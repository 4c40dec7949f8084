#include <algorithm>
#include <array>
#include <cctype>
#include <heml/base/error.hpp>
#include <heml/mesh/labels/voxels.hpp>

namespace heml {
namespace {

std::string ending_of_volume(const std::filesystem::path& path) {
  std::string name = path.filename().string();
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const char* ending : {".nii", ".nii.gz", ".nrrd", ".nhdr", ".mha", ".mhd"})
    if (name.ends_with(ending)) return ending;
  return "";
}

VolumeHeader read_header(const std::filesystem::path& path) {
  const std::string ending = ending_of_volume(path);
  if (ending.starts_with(".nii")) return read_nifti_header(path);
  if (ending == ".nrrd" || ending == ".nhdr") return read_nrrd_header(path);
  if (ending.starts_with(".mh")) return read_metaimage_header(path);
  throw InputError(path.string(), "", "is no label map this program knows",
                   ".nii, .nii.gz, .nrrd, .nhdr, .mha or .mhd");
}

}  // namespace

bool is_label_map_file(const std::filesystem::path& path) { return !ending_of_volume(path).empty(); }

LabelMap read_label_map(const std::filesystem::path& path, const std::vector<int>& labels) {
  return read_voxels(read_header(path), labels);
}

std::map<int, std::string> label_names_in_header(const std::filesystem::path& path) {
  return read_header(path).map.names;
}

}  // namespace heml
