// PLY: G. Turk, The PLY polygon file format (1994): header lines, then the rows of each element in turn, as text or
// binary.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <heml/mesh/check_ply.hpp>
#include <heml/mesh/scanner.hpp>
#include <vector>

namespace heml {
namespace {

struct PlyType {
  std::string_view name;
  std::size_t bytes;
  bool is_integer, is_signed;
};

constexpr std::array ply_types{
    PlyType{"char", 1, true, true},     PlyType{"int8", 1, true, true},     PlyType{"uchar", 1, true, false},
    PlyType{"uint8", 1, true, false},   PlyType{"short", 2, true, true},    PlyType{"int16", 2, true, true},
    PlyType{"ushort", 2, true, false},  PlyType{"uint16", 2, true, false},  PlyType{"int", 4, true, true},
    PlyType{"int32", 4, true, true},    PlyType{"uint", 4, true, false},    PlyType{"uint32", 4, true, false},
    PlyType{"float", 4, false, true},   PlyType{"float32", 4, false, true}, PlyType{"double", 8, false, true},
    PlyType{"float64", 8, false, true},
};

struct PlyProperty {
  const PlyType* value;
  const PlyType* length = nullptr;  ///< type of a list's length; null: a single value
};

struct PlyElement {
  std::string name;
  std::size_t rows;
  std::vector<PlyProperty> properties;
};

class PlyCheck {
 public:
  PlyCheck(std::string file, std::string_view text) : in_(std::move(file), text, 0, true) {}

  void run() {
    header();
    for (const PlyElement& element : elements_) check(element);
  }

 private:
  enum Coding { words, little_endian, big_endian };

  void header() {
    in_.expect_line("ply");
    in_.word("ply");
    for (;;) {
      in_.expect_line("end_header");
      const std::string_view keyword = in_.word("a line of the header");
      if (keyword == "end_header") break;
      if (keyword == "format") {
        format();
      } else if (keyword == "element") {
        const std::string name = in_quotes(in_.word("the name of an element"));
        elements_.push_back({name, static_cast<std::size_t>(in_.integer("the number of rows", 0, 0xffffffff)), {}});
      } else if (keyword == "property") {
        property();
      } else if (keyword != "comment" && keyword != "obj_info") {
        in_.fail("is no line of a PLY header: " + in_quotes(keyword), "format, element, property, ..., end_header");
      }
    }
    in_.rest_of_line();
  }

  void format() {
    const std::string_view coding = in_.word("ascii or binary");
    if (coding != "ascii" && coding != "binary_little_endian" && coding != "binary_big_endian")
      in_.fail("the format is " + in_quotes(coding), "ascii, binary_little_endian or binary_big_endian");
    coding_ = coding == "ascii" ? words : coding == "binary_big_endian" ? big_endian : little_endian;
  }

  const PlyType* type() {
    const std::string_view name = in_.word("a data type");
    const auto found = std::find_if(ply_types.begin(), ply_types.end(), [&](auto& type) { return type.name == name; });
    if (found == ply_types.end()) in_.fail("data of type " + in_quotes(name), "char, uchar, int, float, double, ...");
    return &*found;
  }

  void property() {
    if (elements_.empty()) in_.fail("a property before the first element");
    PlyProperty property;
    if (in_.peek() == "list") {
      in_.word("list");
      property.length = type();
      if (!property.length->is_integer) in_.fail("the length of a list is no integer", "uchar, int, ...");
    }
    property.value = type();
    in_.word("the name of a property");
    in_.end_line("a property");
    elements_.back().properties.push_back(property);
  }

  // Minimal size of a value: its bytes, or in text a digit and a blank; the last blank may be missing.
  std::size_t bytes_of(const PlyType& type) const { return coding_ == words ? 2 : type.bytes; }
  bool can_hold(std::size_t count, std::size_t bytes) const {
    return count <= (in_.left() + (coding_ == words)) / bytes;
  }

  void check(const PlyElement& element) {
    if (element.rows == 0) return;
    std::size_t least = 0;
    bool has_lists = false;
    for (const auto& [value, length] : element.properties) {
      least += bytes_of(length ? *length : *value);
      has_lists |= length != nullptr;
    }
    if (least == 0) in_.fail(fmt::format("the {} rows of element {} have no properties", element.rows, element.name));
    if (!can_hold(element.rows, least))
      in_.fail(fmt::format("element {} has {} rows, more than the {} bytes left in the file can hold", element.name,
                           element.rows, in_.left()));
    if (!has_lists && coding_ != words) {
      in_.bytes(element.rows * least);
      return;
    }
    for (std::size_t r = 0; r < element.rows; ++r)
      for (const auto& [value, length] : element.properties)
        skip(length ? list_length(element, r, *length, *value) : 1, *value);
  }

  std::size_t list_length(const PlyElement& element, std::size_t row, const PlyType& length, const PlyType& value) {
    const long long count = coding_ == words ? length_in_words() : length_in_bytes(length);
    if (count < 0 || !can_hold(static_cast<std::size_t>(count), bytes_of(value)))
      in_.fail(fmt::format("row {} of element {} has a list of {} values, the {} bytes left in the file hold fewer",
                           row, element.name, count, in_.left()));
    return static_cast<std::size_t>(count);
  }

  long long length_in_words() {
    in_.expect_word("the length of a list");
    return in_.wide_integer("the length of a list");
  }

  long long length_in_bytes(const PlyType& type) {
    const std::string_view bytes = in_.bytes(type.bytes);
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i)
      value = value << 8 | static_cast<unsigned char>(bytes[coding_ == big_endian ? i : bytes.size() - 1 - i]);
    const std::uint64_t sign = std::uint64_t{1} << (8 * bytes.size() - 1);
    return static_cast<long long>(value) - (type.is_signed && (value & sign) ? static_cast<long long>(2 * sign) : 0);
  }

  void skip(std::size_t count, const PlyType& type) {
    if (coding_ != words) {
      in_.bytes(count * type.bytes);
      return;
    }
    for (; count > 0; --count) {
      in_.expect_word("a value");
      in_.word("a value");
    }
  }

  Scanner in_;
  Coding coding_ = words;
  std::vector<PlyElement> elements_;
};

}  // namespace

bool is_ply(std::string_view text) { return text.starts_with("ply") || text.starts_with("PLY"); }

void check_ply(std::string file, std::string_view text) { PlyCheck(std::move(file), text).run(); }

}  // namespace heml
