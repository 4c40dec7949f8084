// NRRD with its data in the file or in one beside it; names of segments as 3D Slicer writes them.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <heml/base/error.hpp>
#include <heml/mesh/labels/voxels.hpp>
#include <map>

namespace heml {
namespace {

std::string lowered(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

/// `key: value` as fields (keys in lower case, without blanks), `key:=value` as pairs.
struct NrrdText {
  std::string file;
  std::map<std::string, std::string> fields, pairs;
  std::size_t end = 0;  ///< offset of the data in the file

  const std::string* find(const std::string& key) const {
    const auto found = fields.find(key);
    return found == fields.end() ? nullptr : &found->second;
  }
  const std::string& get(const std::string& key) const {
    if (const std::string* value = find(key)) return *value;
    throw InputError(file, key, "its header lacks it", "a NRRD file with type, dimension, sizes and encoding");
  }
  std::vector<double> numbers(const std::string& key, std::string_view others = "") const {
    return numbers_in(get(key), file, key, others);
  }
};

NrrdText parse_nrrd(const std::filesystem::path& path) {
  const std::string head = head_of(path);
  NrrdText text{path.string(), {}, {}, 0};
  if (!head.starts_with("NRRD000")) throw InputError(text.file, "line 1", "does not begin with NRRD000", "a NRRD file");
  std::size_t at = 0;
  for (int number = 1;; ++number) {
    const std::size_t end = head.find('\n', at);
    const std::string_view line = trimmed(std::string_view(head).substr(at, end - at));
    at = end == std::string::npos ? head.size() : end + 1;
    if (line.empty() || end == std::string::npos) {
      text.end = at;
      return text;
    }
    if (number == 1 || line[0] == '#') continue;
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos)
      throw InputError(text.file, fmt::format("line {}", number), "is neither 'key: value' nor 'key:=value'");
    if (colon + 1 < line.size() && line[colon + 1] == '=') {
      text.pairs[std::string(line.substr(0, colon))] = std::string(trimmed(line.substr(colon + 2)));
      continue;
    }
    std::string key = lowered(line.substr(0, colon));
    key.erase(std::remove(key.begin(), key.end(), ' '), key.end());
    text.fields[key] = std::string(trimmed(line.substr(colon + 1)));
  }
}

void set_nrrd_type(const NrrdText& text, VolumeHeader& volume) {
  using Number = VolumeHeader::Number;
  const std::string type = lowered(text.get("type"));
  const auto is_one_of = [&](std::initializer_list<const char*> names) {
    return std::find(names.begin(), names.end(), type) != names.end();
  };
  const auto set = [&](Number number, std::size_t bytes) {
    volume.number = number;
    volume.bytes = bytes;
  };
  if (is_one_of({"uchar", "unsigned char", "uint8", "uint8_t"})) return set(Number::unsigned_integer, 1);
  if (is_one_of({"signed char", "int8", "int8_t"})) return set(Number::signed_integer, 1);
  if (is_one_of({"short", "short int", "signed short", "signed short int", "int16", "int16_t"}))
    return set(Number::signed_integer, 2);
  if (is_one_of({"ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"}))
    return set(Number::unsigned_integer, 2);
  if (is_one_of({"int", "signed int", "int32", "int32_t"})) return set(Number::signed_integer, 4);
  if (is_one_of({"uint", "unsigned int", "uint32", "uint32_t"})) return set(Number::unsigned_integer, 4);
  if (is_one_of(
          {"longlong", "long long", "long long int", "signed long long", "signed long long int", "int64", "int64_t"}))
    return set(Number::signed_integer, 8);
  if (is_one_of({"ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t"}))
    return set(Number::unsigned_integer, 8);
  if (type == "float") return set(Number::real, 4);
  if (type == "double") return set(Number::real, 8);
  throw InputError(text.file, "type", fmt::format("voxels of type '{}'", type), "integers, float or double");
}

void set_nrrd_size(const NrrdText& text, LabelMap& map) {
  const std::vector<double> sizes = text.numbers("sizes"), dimension = text.numbers("dimension");
  if (sizes.size() != 3 || dimension.size() != 1 || dimension[0] != 3)
    throw InputError(text.file, "dimension", fmt::format("{} dimensions", sizes.size()),
                     "3: in 3D Slicer, export the segmentation as one label map, since segments that overlap are saved "
                     "in several layers");
  std::array<long long, 3> size;
  for (std::size_t d = 0; d < 3; ++d) {
    if (std::abs(sizes[d]) > 1e15) throw InputError(text.file, "sizes", fmt::format("{:.3g} voxels", sizes[d]));
    size[d] = static_cast<long long>(sizes[d]);
  }
  set_size(map, size, "sizes");
}

double metres_of_nrrd(const NrrdText& text) {
  const std::string* units = text.find("spaceunits");
  if (!units || units->find("mm") != std::string::npos) return 1e-3;
  if (units->find("\"m\"") != std::string::npos) return 1;
  if (units->find("\"cm\"") != std::string::npos) return 1e-2;
  if (units->find("um") != std::string::npos || units->find("µm") != std::string::npos) return 1e-6;
  throw InputError(text.file, "space units", *units, "\"mm\", \"cm\", \"m\" or \"um\", three times");
}

/// −1 for axes that point left or to the posterior or inferior.
Vec3 signs_of_space(const NrrdText& text) {
  const std::string* given = text.find("space");
  const std::string space = given ? lowered(*given) : "";
  if (space == "left-posterior-superior" || space == "lps") return {-1, -1, 1};
  if (space == "left-anterior-superior" || space == "las") return {-1, 1, 1};
  if (space.empty() || space == "right-anterior-superior" || space == "ras" || space == "scanner-xyz" ||
      space == "3d-right-handed")
    return {1, 1, 1};
  throw InputError(text.file, "space", fmt::format("'{}'", *given),
                   "left-posterior-superior, right-anterior-superior or left-anterior-superior");
}

void set_nrrd_axes(const NrrdText& text, LabelMap& map) {
  if (text.find("spacedirections")) {
    const std::vector<double> directions = text.numbers("spacedirections", "(),");
    if (directions.size() != 9)
      throw InputError(text.file, "space directions", fmt::format("{} numbers", directions.size()), "three vectors");
    for (int d = 0; d < 3; ++d)
      for (int row = 0; row < 3; ++row) map.axes(row, d) = directions[static_cast<std::size_t>(3 * d + row)];
  } else if (text.find("spacings")) {
    const std::vector<double> spacings = text.numbers("spacings");
    if (spacings.size() != 3) throw InputError(text.file, "spacings", fmt::format("{} numbers", spacings.size()), "3");
    map.axes = Vec3(spacings[0], spacings[1], spacings[2]).cwiseAbs().asDiagonal();
  }
  if (text.find("spaceorigin")) {
    const std::vector<double> origin = text.numbers("spaceorigin", "(),");
    if (origin.size() != 3) throw InputError(text.file, "space origin", fmt::format("{} numbers", origin.size()), "3");
    map.origin = Vec3(origin[0], origin[1], origin[2]);
  }
  const Vec3 factor = metres_of_nrrd(text) * signs_of_space(text);
  map.axes = factor.asDiagonal() * map.axes;
  map.origin = factor.cwiseProduct(map.origin);
}

void set_nrrd_data(const std::filesystem::path& path, const NrrdText& text, VolumeHeader& volume) {
  const std::string encoding = lowered(text.get("encoding"));
  volume.is_text = encoding == "ascii" || encoding == "text" || encoding == "txt";
  volume.is_compressed = encoding == "gzip" || encoding == "gz";
  if (!volume.is_text && !volume.is_compressed && encoding != "raw")
    throw InputError(text.file, "encoding", fmt::format("'{}'", encoding), "raw, gzip or ascii");
  if (const std::string* endian = text.find("endian")) volume.is_big_endian = lowered(*endian) == "big";
  volume.data_file = path;
  volume.data_offset = text.end;
  for (const char* key : {"datafile", "data file"})
    if (const std::string* name = text.find(key)) {
      if (lowered(*name).starts_with("list") || name->find('%') != std::string::npos)
        throw InputError(text.file, "data file", "voxels in several files", "save them in one");
      volume.data_file = data_file_beside(path, *name);
      volume.data_offset = 0;
    }
  if (const std::string* lines = text.find("lineskip"); lines && *lines != "0")
    throw InputError(text.file, "line skip", *lines, "0");
  if (const std::string* given = text.find("byteskip"); given && *given != "0") {
    const std::vector<double> skip = numbers_in(*given, text.file, "byte skip");
    const auto bytes = static_cast<double>(volume.map.index(0, 0, volume.map.size[2]) * volume.bytes);
    std::error_code error;
    const auto all = static_cast<double>(std::filesystem::file_size(volume.data_file, error));
    const bool from_end = skip.size() == 1 && skip[0] == -1 && encoding == "raw" && !error && all >= bytes;
    if (skip.size() != 1 || (skip[0] < 0 && !from_end) || skip[0] > 1e12)
      throw InputError(text.file, "byte skip", *given, "0 or more bytes; -1 for raw data at the end of the file");
    volume.data_offset =
        from_end ? static_cast<std::uint64_t>(all - bytes) : volume.data_offset + static_cast<std::uint64_t>(skip[0]);
  }
}

/// Segment0_Name:=liver and Segment0_LabelValue:=1.
std::map<int, std::string> segment_names(const NrrdText& text) {
  std::map<int, std::string> names;
  for (const auto& [key, name] : text.pairs) {
    if (!key.starts_with("Segment") || !key.ends_with("_Name")) continue;
    const auto value = text.pairs.find(key.substr(0, key.size() - 4) + "LabelValue");
    int label = 0;
    if (value == text.pairs.end()) continue;
    const std::string& digits = value->second;
    if (std::from_chars(digits.data(), digits.data() + digits.size(), label).ec == std::errc()) names[label] = name;
  }
  return names;
}

}  // namespace

VolumeHeader read_nrrd_header(const std::filesystem::path& path) {
  const NrrdText text = parse_nrrd(path);
  VolumeHeader volume;
  volume.map.source = path.string();
  volume.map.names = segment_names(text);
  set_nrrd_type(text, volume);
  set_nrrd_size(text, volume.map);
  set_nrrd_axes(text, volume.map);
  set_nrrd_data(path, text, volume);
  return volume;
}

}  // namespace heml
