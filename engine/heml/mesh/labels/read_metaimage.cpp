// MetaImage: .mha with the voxels in the file, .mhd with them in one beside it. Coordinates as ITK reads them: left,
// posterior, superior, in millimetres.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <heml/base/error.hpp>
#include <heml/mesh/labels/voxels.hpp>
#include <map>

namespace heml {
namespace {

struct MetaText {
  std::string file;
  std::map<std::string, std::string> fields;
  std::size_t end = 0;  ///< offset of the data in the file

  /// The first of some keys that is given; nullptr if none is.
  const std::string* find(std::initializer_list<const char*> keys) const {
    for (const char* key : keys)
      if (const auto found = fields.find(key); found != fields.end()) return &found->second;
    return nullptr;
  }
  const std::string& get(const char* key) const {
    if (const std::string* value = find({key})) return *value;
    throw InputError(file, key, "its header lacks it", "a MetaImage file");
  }
  bool is_true(std::initializer_list<const char*> keys) const {
    const std::string* value = find(keys);
    return value && (*value == "True" || *value == "true" || *value == "1");
  }
  /// The numbers of a key; empty if it is not given.
  std::vector<double> numbers(std::initializer_list<const char*> keys, std::size_t count) const {
    const std::string* value = find(keys);
    if (!value) return {};
    std::vector<double> numbers = numbers_in(*value, file, *keys.begin());
    if (numbers.size() != count)
      throw InputError(file, *keys.begin(), fmt::format("{} numbers", numbers.size()), fmt::format("{}", count));
    return numbers;
  }
};

MetaText parse_metaimage(const std::filesystem::path& path) {
  const std::string head = head_of(path);
  MetaText text{path.string(), {}, 0};
  std::size_t at = 0;
  for (int number = 1; at < head.size(); ++number) {
    const std::size_t end = std::min(head.find('\n', at), head.size());
    const std::string_view line = trimmed(std::string_view(head).substr(at, end - at));
    at = std::min(end + 1, head.size());
    if (line.empty()) continue;
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos || equals > 100)
      throw InputError(text.file, fmt::format("line {}", number), "is not 'Key = value'", "a MetaImage file");
    const std::string key(trimmed(line.substr(0, equals)));
    text.fields[key] = std::string(trimmed(line.substr(equals + 1)));
    if (key == "ElementDataFile") {
      text.end = at;
      return text;
    }
  }
  throw InputError(text.file, "ElementDataFile", "its header lacks it", "a MetaImage file");
}

void set_metaimage_type(const MetaText& text, VolumeHeader& volume) {
  using Number = VolumeHeader::Number;
  struct Type {
    const char* name;
    Number number;
    std::size_t bytes;
  };
  constexpr Type types[] = {{"MET_UCHAR", Number::unsigned_integer, 1},
                            {"MET_CHAR", Number::signed_integer, 1},
                            {"MET_USHORT", Number::unsigned_integer, 2},
                            {"MET_SHORT", Number::signed_integer, 2},
                            {"MET_UINT", Number::unsigned_integer, 4},
                            {"MET_INT", Number::signed_integer, 4},
                            {"MET_ULONG_LONG", Number::unsigned_integer, 8},
                            {"MET_LONG_LONG", Number::signed_integer, 8},
                            {"MET_FLOAT", Number::real, 4},
                            {"MET_DOUBLE", Number::real, 8}};
  const std::string& given = text.get("ElementType");
  for (const Type& type : types)
    if (given == type.name) {
      volume.number = type.number;
      volume.bytes = type.bytes;
      return;
    }
  throw InputError(text.file, "ElementType", fmt::format("'{}'", given), "MET_UCHAR, MET_SHORT ... MET_DOUBLE");
}

void set_metaimage_size(const MetaText& text, LabelMap& map) {
  if (text.get("NDims") != "3") throw InputError(text.file, "NDims", text.get("NDims"), "3");
  if (const std::string* channels = text.find({"ElementNumberOfChannels"}); channels && *channels != "1")
    throw InputError(text.file, "ElementNumberOfChannels", *channels, "1");
  text.get("DimSize");
  const std::vector<double> numbers = text.numbers({"DimSize"}, 3);
  std::array<long long, 3> size;
  for (std::size_t d = 0; d < 3; ++d) {
    if (std::abs(numbers[d]) > 1e15) throw InputError(text.file, "DimSize", fmt::format("{:.3g} voxels", numbers[d]));
    size[d] = static_cast<long long>(numbers[d]);
  }
  set_size(map, size, "DimSize");
}

void set_metaimage_axes(const MetaText& text, LabelMap& map) {
  std::vector<double> spacing = text.numbers({"ElementSpacing", "ElementSize"}, 3);
  std::vector<double> matrix = text.numbers({"TransformMatrix", "Rotation", "Orientation"}, 9);
  std::vector<double> offset = text.numbers({"Offset", "Position", "Origin"}, 3);
  if (spacing.empty()) spacing = {1, 1, 1};
  if (matrix.empty()) matrix = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  if (offset.empty()) offset = {0, 0, 0};
  const std::array<double, 3> metres{-1e-3, -1e-3, 1e-3};  // left to right, posterior to anterior
  for (int row = 0; row < 3; ++row) {
    const double unit = metres[static_cast<std::size_t>(row)];
    for (int d = 0; d < 3; ++d)
      map.axes(row, d) =
          unit * matrix[static_cast<std::size_t>(3 * d + row)] * std::abs(spacing[static_cast<std::size_t>(d)]);
    map.origin[row] = unit * offset[static_cast<std::size_t>(row)];
  }
}

}  // namespace

VolumeHeader read_metaimage_header(const std::filesystem::path& path) {
  const MetaText text = parse_metaimage(path);
  VolumeHeader volume;
  volume.map.source = path.string();
  set_metaimage_type(text, volume);
  set_metaimage_size(text, volume.map);
  set_metaimage_axes(text, volume.map);
  volume.is_big_endian = text.is_true({"BinaryDataByteOrderMSB", "ElementByteOrderMSB"});
  volume.is_compressed = text.is_true({"CompressedData"});
  volume.is_text = text.find({"BinaryData"}) && !text.is_true({"BinaryData"});
  const std::string& name = text.get("ElementDataFile");
  const bool is_local = name == "LOCAL" || name == "Local" || name == "local";
  if (name == "LIST" || name.find('%') != std::string::npos)
    throw InputError(text.file, "ElementDataFile", "voxels in several files", "save them in one");
  volume.data_file = is_local ? path : data_file_beside(path, name);
  volume.data_offset = is_local ? text.end : 0;
  if (const std::vector<double> skip = text.numbers({"HeaderSize"}, 1); !skip.empty() && skip[0] != 0) {
    if (skip[0] < 0 || skip[0] > 1e12) throw InputError(text.file, "HeaderSize", fmt::format("{:.6g}", skip[0]), "0");
    volume.data_offset = static_cast<std::uint64_t>(skip[0]);
  }
  return volume;
}

}  // namespace heml
