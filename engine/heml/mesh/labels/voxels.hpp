#pragma once
// From what a header says to the voxels of a label map: the part that all formats share.
#include <heml/mesh/labels/byte_reader.hpp>
#include <heml/mesh/labels/label_map.hpp>
#include <string_view>

namespace heml {

/// What a header says of the voxels and where they are.
struct VolumeHeader {
  enum class Number { signed_integer, unsigned_integer, real };

  LabelMap map;  ///< without voxels and values
  Number number = Number::unsigned_integer;
  std::size_t bytes = 1;  ///< of a voxel: 1, 2, 4 or 8
  bool is_big_endian = false, is_text = false;
  double slope = 1, intercept = 0;  ///< label = slope · number + intercept
  std::filesystem::path data_file;
  std::uint64_t data_offset = 0;  ///< in data_file; after inflating, if inflated_offset
  bool is_compressed = false, inflated_offset = false;
};

/// Checks the header, then reads the voxels. labels: as read_label_map() has them. Throws InputError.
LabelMap read_voxels(const VolumeHeader& header, const std::vector<int>& labels);

/// Sets size from a header's numbers of voxels. Throws InputError unless 1 or more each, and 4·10⁸ at most in all.
void set_size(LabelMap& map, const std::array<long long, 3>& size, const std::string& place);

VolumeHeader read_nifti_header(const std::filesystem::path& path);
VolumeHeader read_nrrd_header(const std::filesystem::path& path);
VolumeHeader read_metaimage_header(const std::filesystem::path& path);

/// The first bytes of a file, as headers of text need them, up to `most`.
std::string head_of(const std::filesystem::path& path, std::size_t most = 1 << 20);

/// The numbers of a line, separated by blanks or any of `others`. Throws InputError naming the place.
std::vector<double> numbers_in(std::string_view text, const std::string& file, const std::string& place,
                               std::string_view others = "");

/// Without blanks at both ends.
std::string_view trimmed(std::string_view text);

/// File of voxels that a header names, beside it.
std::filesystem::path data_file_beside(const std::filesystem::path& header, std::string_view name);

}  // namespace heml
