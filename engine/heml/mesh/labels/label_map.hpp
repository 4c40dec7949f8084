#pragma once
// Label maps: voxels of a segmented scan, each with the number of the organ it belongs to.
#include <cstdint>
#include <filesystem>
#include <heml/math/types.hpp>
#include <map>
#include <string>
#include <vector>

namespace heml {

struct LabelMap {
  std::array<int, 3> size{};         ///< voxels along i, j, k
  Mat3 axes = Mat3::Identity();      ///< column d: the step between voxels along axis d, m
  Vec3 origin = Vec3::Zero();        ///< centre of voxel (0, 0, 0), m; x right, y anterior, z superior
  std::vector<std::uint8_t> voxels;  ///< index into values, i fastest
  std::vector<int> values;           ///< the file's numbers, ascending but for the first: 0, outside
  std::map<int, std::string> names;  ///< by the file's numbers, where the file gives names
  std::string source;                ///< file, for messages

  std::size_t index(int i, int j, int k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(size[0]) *
               (static_cast<std::size_t>(j) + static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(k));
  }
  double voxel_volume() const { return std::abs(axes.determinant()); }  ///< m³
};

/// Whether read_label_map() reads this ending: .nii .nii.gz .nrrd .nhdr .mha .mhd.
bool is_label_map_file(const std::filesystem::path& path);

/// Reads NIfTI-1 and -2, NRRD (raw, gzip, ascii) and MetaImage (raw, compressed, ascii), with data in the file or in
/// one beside it; numbers of any type that are integers. Memory: one byte a voxel. labels: only these, the others are
/// outside; empty: all. Throws InputError naming file and place.
LabelMap read_label_map(const std::filesystem::path& path, const std::vector<int>& labels = {});

/// The names of labels that the file's header gives (NRRD of 3D Slicer), without reading voxels.
std::map<int, std::string> label_names_in_header(const std::filesystem::path& path);

}  // namespace heml
