#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <heml/base/error.hpp>
#include <heml/mesh/labels/voxels.hpp>
#include <limits>
#include <unordered_map>

namespace heml {
namespace {

constexpr double max_voxels = 4e8;
constexpr std::size_t max_distinct = 256;  // of one byte, outside included

/// Gives the numbers of a file their labels, in order of appearance.
class LabelIndex {
 public:
  LabelIndex(const VolumeHeader& header, const std::vector<int>& labels) : header_(header), wanted_(labels) {
    indices_[0] = 0;
  }

  std::uint8_t operator()(double number) {
    if (number == last_number_) return last_index_;
    const double value = header_.slope * number + header_.intercept;
    const double whole = std::round(value);
    if (!(std::abs(value - whole) <= 1e-4 * std::max(1.0, std::abs(value))) ||
        std::abs(whole) > std::numeric_limits<int>::max())
      throw InputError(header_.map.source, place(), fmt::format("is {:.6g}, and labels are whole numbers", value),
                       "give the segmentation, not the scan itself");
    last_number_ = number;
    return last_index_ = index_of(static_cast<int>(whole));
  }

  void advance() { ++voxel_; }

  /// The labels that were found, ascending, and the voxels numbered accordingly.
  void finish(LabelMap& map) {
    std::vector<int> found(values_.begin() + 1, values_.end());
    std::sort(found.begin(), found.end());
    for (const int label : wanted_)
      if (!std::binary_search(found.begin(), found.end(), label))
        throw InputError(map.source, fmt::format("label {}", label), "no voxel has it",
                         found.empty() ? "all voxels are of others" : "see which labels the file has");
    if (found.empty()) throw InputError(map.source, "", "holds no label: all voxels are 0", "give a segmentation");
    std::array<std::uint8_t, max_distinct> renumbered{};
    for (std::size_t k = 1; k < values_.size(); ++k)
      renumbered[k] =
          static_cast<std::uint8_t>(1 + std::lower_bound(found.begin(), found.end(), values_[k]) - found.begin());
    for (std::uint8_t& voxel : map.voxels) voxel = renumbered[voxel];
    map.values = {0};
    map.values.insert(map.values.end(), found.begin(), found.end());
  }

 private:
  std::uint8_t index_of(int value) {
    if (const auto known = indices_.find(value); known != indices_.end()) return known->second;
    const bool is_wanted = wanted_.empty() || std::find(wanted_.begin(), wanted_.end(), value) != wanted_.end();
    if (!is_wanted) return 0;
    if (values_.size() == max_distinct)
      throw InputError(header_.map.source, place(), fmt::format("is the {}th different value", max_distinct),
                       fmt::format("a label map has {} labels at most; give the segmentation, not the scan itself, or "
                                   "choose labels (--labels 1,2)",
                                   max_distinct - 1));
    values_.push_back(value);
    return indices_[value] = static_cast<std::uint8_t>(values_.size() - 1);
  }

  std::string place() const {
    const auto [ni, nj, nk] = header_.map.size;
    const auto row = voxel_ / static_cast<std::size_t>(ni);
    return fmt::format("voxel ({}, {}, {})", voxel_ % static_cast<std::size_t>(ni), row % static_cast<std::size_t>(nj),
                       row / static_cast<std::size_t>(nj));
  }

  const VolumeHeader& header_;
  const std::vector<int>& wanted_;
  std::unordered_map<int, std::uint8_t> indices_;
  std::vector<int> values_{0};
  std::size_t voxel_ = 0;
  double last_number_ = std::numeric_limits<double>::quiet_NaN();
  std::uint8_t last_index_ = 0;
};

template <class Integer>
Integer integer_from(const char* bytes, bool is_big_endian) {
  Integer value = 0;
  for (std::size_t b = 0; b < sizeof(Integer); ++b)
    value = static_cast<Integer>(value | static_cast<Integer>(static_cast<Integer>(static_cast<unsigned char>(bytes[b]))
                                                              << (8 * (is_big_endian ? sizeof(Integer) - 1 - b : b))));
  return value;
}

double number_from(const char* bytes, const VolumeHeader& header) {
  using Number = VolumeHeader::Number;
  const bool big = header.is_big_endian, is_signed = header.number == Number::signed_integer;
  switch (header.bytes) {
    case 1:
      return is_signed ? static_cast<double>(static_cast<signed char>(*bytes))
                       : static_cast<double>(static_cast<unsigned char>(*bytes));
    case 2: {
      const auto bits = integer_from<std::uint16_t>(bytes, big);
      return is_signed ? static_cast<double>(static_cast<std::int16_t>(bits)) : static_cast<double>(bits);
    }
    case 4: {
      const auto bits = integer_from<std::uint32_t>(bytes, big);
      if (header.number == Number::real) return static_cast<double>(std::bit_cast<float>(bits));
      return is_signed ? static_cast<double>(static_cast<std::int32_t>(bits)) : static_cast<double>(bits);
    }
    default: {
      const auto bits = integer_from<std::uint64_t>(bytes, big);
      if (header.number == Number::real) return std::bit_cast<double>(bits);
      return is_signed ? static_cast<double>(static_cast<std::int64_t>(bits)) : static_cast<double>(bits);
    }
  }
}

void read_binary(const VolumeHeader& header, ByteReader& in, LabelIndex& index, LabelMap& map) {
  std::vector<char> row(static_cast<std::size_t>(map.size[0]) * header.bytes);
  for (std::size_t at = 0; at < map.voxels.size();) {
    in.read(row);
    for (std::size_t b = 0; b < row.size(); b += header.bytes, index.advance())
      map.voxels[at++] = index(number_from(&row[b], header));
  }
}

void read_text(ByteReader& in, LabelIndex& index, LabelMap& map) {
  std::vector<char> buffer(1 << 16);
  std::string word;
  std::size_t at = 0;
  const auto take_word = [&] {
    if (word.empty() || at == map.voxels.size()) return;
    double number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || end != word.data() + word.size())
      throw InputError(map.source, fmt::format("voxel {}", at), fmt::format("'{}' is no number", word.substr(0, 20)));
    map.voxels[at++] = index(number);
    index.advance();
    word.clear();
  };
  while (const std::size_t got = in.read_some(buffer)) {
    for (const char c : std::string_view(buffer.data(), got))
      if (c == ' ' || c == '\n' || c == '\r' || c == '\t')
        take_word();
      else if (word.size() < 64)
        word += c;
  }
  take_word();
  if (at < map.voxels.size())
    throw InputError(map.source, "", fmt::format("ends after {} of {} voxels", at, map.voxels.size()),
                     "it was cut off, copy it again");
}

void check_axes(const LabelMap& map) {
  bool is_sensible = map.axes.allFinite() && map.origin.allFinite();
  for (int d = 0; d < 3; ++d) is_sensible &= map.axes.col(d).norm() > 1e-8 && map.axes.col(d).norm() < 10;
  is_sensible &= map.voxel_volume() > 1e-3 * map.axes.col(0).norm() * map.axes.col(1).norm() * map.axes.col(2).norm();
  if (!is_sensible)
    throw InputError(map.source, "the header's directions",
                     fmt::format("voxels step by ({:.3g}), ({:.3g}), ({:.3g}) m", fmt::join(map.axes.col(0), ", "),
                                 fmt::join(map.axes.col(1), ", "), fmt::join(map.axes.col(2), ", ")),
                     "three independent directions of 10 nm to 10 m");
}

}  // namespace

void set_size(LabelMap& map, const std::array<long long, 3>& size, const std::string& place) {
  double count = 1;
  for (std::size_t d = 0; d < 3; ++d) {
    if (size[d] < 1 || size[d] > std::numeric_limits<int>::max())
      throw InputError(map.source, place, fmt::format("{} voxels along axis {}", size[d], d), "1 or more");
    map.size[d] = static_cast<int>(size[d]);
    count *= static_cast<double>(size[d]);
  }
  if (count > max_voxels)
    throw InputError(map.source, place, fmt::format("{} x {} x {} voxels", size[0], size[1], size[2]),
                     fmt::format("{:.0e} at most: crop the label map to the organs, or resample it", max_voxels));
}

LabelMap read_voxels(const VolumeHeader& header, const std::vector<int>& labels) {
  LabelMap map = header.map;
  check_axes(map);
  std::error_code error;
  if (!std::filesystem::exists(header.data_file, error))
    throw InputError(map.source, "",
                     fmt::format("its voxels are in '{}', which is not there", header.data_file.string()),
                     "put it beside the header");
  ByteReader in(header.data_file, header.inflated_offset ? 0 : header.data_offset, header.is_compressed);
  const std::size_t count = map.index(0, 0, map.size[2]);
  const std::uint64_t skipped = header.inflated_offset ? header.data_offset : 0;
  in.expect(skipped + (header.is_text ? 2 * count - 1 : count * header.bytes));
  in.skip(skipped);
  map.voxels.resize(count);
  LabelIndex index(header, labels);
  if (header.is_text)
    read_text(in, index, map);
  else
    read_binary(header, in, index, map);
  index.finish(map);
  return map;
}

std::string head_of(const std::filesystem::path& path, std::size_t most) {
  ByteReader in(path, 0, false);
  std::string head(most, '\0');
  head.resize(in.read_some(head));
  return head;
}

std::vector<double> numbers_in(std::string_view text, const std::string& file, const std::string& place,
                               std::string_view others) {
  std::vector<double> numbers;
  const auto is_blank = [&](char c) { return c == ' ' || c == '\t' || others.find(c) != std::string_view::npos; };
  for (std::size_t at = 0; at < text.size();) {
    if (is_blank(text[at])) {
      ++at;
      continue;
    }
    std::size_t end = at;
    while (end < text.size() && !is_blank(text[end])) ++end;
    double number = 0;
    const auto parsed = std::from_chars(text.data() + at, text.data() + end, number);
    if (parsed.ec != std::errc() || parsed.ptr != text.data() + end || !std::isfinite(number))
      throw InputError(file, place,
                       fmt::format("'{}' is no number", text.substr(at, std::min<std::size_t>(end - at, 40))));
    numbers.push_back(number);
    at = end;
  }
  return numbers;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::filesystem::path data_file_beside(const std::filesystem::path& header, std::string_view name) {
  return header.parent_path() / std::filesystem::path(name);
}

}  // namespace heml
