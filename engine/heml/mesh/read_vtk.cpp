// VTK legacy files: https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html ("Simple Legacy Formats"),
// versions up to 4 (cells as "#nodes node ...") and 5 (offsets and connectivity). Binary data are big-endian.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <heml/mesh/binary_values.hpp>
#include <heml/mesh/readers.hpp>

namespace heml {
namespace {

struct Type {
  std::string_view name;
  std::size_t bytes;
  NumberKind kind;
};

constexpr std::array types{
    Type{"float", 4, NumberKind::real},
    Type{"double", 8, NumberKind::real},
    Type{"char", 1, NumberKind::signed_integer},
    Type{"signed_char", 1, NumberKind::signed_integer},
    Type{"unsigned_char", 1, NumberKind::unsigned_integer},
    Type{"short", 2, NumberKind::signed_integer},
    Type{"unsigned_short", 2, NumberKind::unsigned_integer},
    Type{"int", 4, NumberKind::signed_integer},
    Type{"unsigned_int", 4, NumberKind::unsigned_integer},
    Type{"long", 8, NumberKind::signed_integer},
    Type{"unsigned_long", 8, NumberKind::unsigned_integer},
    Type{"vtkidtype", 4, NumberKind::signed_integer},
    Type{"vtktypeint64", 8, NumberKind::signed_integer},
    Type{"vtktypeuint64", 8, NumberKind::unsigned_integer},
};
constexpr const Type& int_type = types[7];
constexpr const Type& byte_type = types[4];

std::string lower(std::string_view word) {
  std::string text(word);
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

// Decodes %XX, by which names encode blanks and other characters that would end a word.
std::string decoded(std::string_view name) {
  std::string text;
  for (std::size_t i = 0; i < name.size(); ++i) {
    unsigned char code = 0;
    const char* digits = name.data() + i + 1;
    if (name[i] == '%' && i + 2 < name.size() && std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2) {
      text += static_cast<char>(code);
      i += 2;
    } else {
      text += name[i];
    }
  }
  return text;
}

class VtkReader {
 public:
  VtkReader(std::string file, std::string_view text) : in_(std::move(file), text) {}

  ReadMesh read() {
    header();
    while (in_.has_word()) section();
    if (read_.mesh.nodes.empty()) in_.fail("the file has no POINTS");
    if (cells_.offsets.empty()) in_.fail("the file has no CELLS");
    add_vtk_cells(cells_, 0, in_, read_);
    return std::move(read_);
  }

 private:
  void header() {
    constexpr std::string_view magic = "# vtk DataFile Version ";
    if (!in_.rest().starts_with(magic)) in_.fail("a VTK file should begin with '" + std::string(magic) + "'");
    in_.skip_past(magic);
    version_ = in_.number("the version");
    in_.rest_of_line();
    in_.rest_of_line();  // title
    const std::string coding = lower(in_.word("ASCII or BINARY"));
    if (coding != "ascii" && coding != "binary") in_.fail("should be ASCII or BINARY, is " + in_quotes(coding));
    binary_ = coding == "binary";
    Scanner line = header_line();
    if (lower(line.word("DATASET")) != "dataset") line.fail("should be DATASET UNSTRUCTURED_GRID");
    if (const auto kind = line.word("UNSTRUCTURED_GRID"); lower(kind) != "unstructured_grid")
      line.fail("the dataset is " + in_quotes(kind), "UNSTRUCTURED_GRID");
  }

  // A scanner for the next line with words; in_ moves after it, where raw data may begin. Skips METADATA, which ends
  // with an empty line.
  Scanner header_line() {
    while (lower(in_.peek()) == "metadata")
      while (in_.left() > 0 && in_.rest_of_line().find_first_not_of(" \t\r") != std::string_view::npos) continue;
    Scanner line = in_.until('\n');
    in_.rest_of_line();
    return line;
  }

  void section() {
    Scanner line = header_line();
    if (!line.has_word()) return;
    const std::string keyword = lower(line.word("a section"));
    if (keyword == "points") {
      points(line);
    } else if (keyword == "cells") {
      if (!cells_.offsets.empty()) line.fail("a second section CELLS");
      version_ >= 5 ? cells_by_offsets(line) : cells_by_length(line);
    } else if (keyword == "cell_types") {
      cells_.types = integers(counted(line, "the number of cells"), int_type);
    } else if (keyword == "cell_data" || keyword == "point_data") {
      of_cells_ = keyword == "cell_data";
      tuples_ = counted(line, "the number of values");
    } else if (keyword == "field") {
      field(line);
    } else {
      attribute(line, keyword);
    }
  }

  static std::size_t counted(Scanner& line, const char* what) {
    return static_cast<std::size_t>(line.integer(what, 0));
  }

  static const Type& type_of(Scanner& line) {
    const std::string name = lower(line.word("a data type"));
    const auto type = std::find_if(types.begin(), types.end(), [&](const Type& t) { return t.name == name; });
    if (type == types.end())
      line.fail("data of type " + in_quotes(name) + " is not read", "float, double, int, long, ...");
    return *type;
  }

  void points(Scanner& line) {
    if (!read_.mesh.nodes.empty()) line.fail("a second section POINTS");
    const std::size_t count = counted(line, "the number of points");
    const Type& type = type_of(line);
    need(3 * count, type);
    read_.mesh.nodes.reserve(count);
    for (std::size_t n = 0; n < count; ++n) {
      const double x = real(type), y = real(type), z = real(type);
      read_.mesh.nodes.emplace_back(x, y, z);
      if (!read_.mesh.nodes.back().allFinite()) line.fail(fmt::format("point {} is not finite", n));
    }
  }

  void cells_by_length(Scanner& line) {
    const std::size_t count = counted(line, "the number of cells"), size = counted(line, "the size of the cells");
    const std::vector<long long> values = integers(size, int_type);
    cells_.offsets.push_back(0);
    std::size_t at = 0;
    for (std::size_t c = 0; c < count; ++c) {
      const long long nodes = at < size ? values[at] : -1;
      if (nodes < 0 || nodes > static_cast<long long>(size - at) - 1)
        line.fail(fmt::format("cell {} does not fit the {} values of the cells", c, size));
      cells_.connectivity.insert(cells_.connectivity.end(), &values[at] + 1, &values[at] + 1 + nodes);
      cells_.offsets.push_back(static_cast<long long>(cells_.connectivity.size()));
      at += 1 + static_cast<std::size_t>(nodes);
    }
    if (at != size) line.fail(fmt::format("{} cells take {} values, {} are announced", count, at, size));
  }

  void cells_by_offsets(Scanner& line) {
    const std::size_t offsets = counted(line, "the number of offsets"), size = counted(line, "the size of the cells");
    if (offsets == 0) line.fail("the number of offsets is 0", "one more than cells");
    for (auto [name, count, values] :
         {std::tuple("offsets", offsets, &cells_.offsets), std::tuple("connectivity", size, &cells_.connectivity)}) {
      Scanner array = header_line();
      if (const auto found = array.word(name); lower(found) != name)
        array.fail(fmt::format("{} should begin here, found {}", name, in_quotes(found)));
      *values = integers(count, type_of(array));
    }
  }

  void field(Scanner& line) {
    line.word("the name of a field");
    const std::size_t arrays = counted(line, "the number of arrays");
    for (std::size_t a = 0; a < arrays; ++a) {
      Scanner array = header_line();
      const std::string_view name = array.word("the name of an array");
      const std::size_t components = counted(array, "the number of components");
      const std::size_t tuples = counted(array, "the number of values");
      const Type& type = type_of(array);
      values_of(name, components, tuples, type);
    }
  }

  // SCALARS, VECTORS, ...: the rest of the line and the data depend on the keyword.
  void attribute(Scanner& line, const std::string& keyword) {
    if (keyword != "lookup_table" && tuples_ == 0) line.fail("unknown section " + in_quotes(keyword));
    const std::string_view name = line.word("a name");
    if (keyword == "scalars") {
      const Type& type = type_of(line);
      const std::size_t components = line.has_word() ? counted(line, "the number of components") : 1;
      if (lower(in_.rest().substr(0, 12)) == "lookup_table") in_.rest_of_line();
      values_of(name, components, tuples_, type);
    } else if (keyword == "vectors" || keyword == "normals") {
      values_of(name, 3, tuples_, type_of(line));
    } else if (keyword == "tensors" || keyword == "tensors6") {
      skip((keyword == "tensors" ? 9 : 6) * tuples_, type_of(line));
    } else if (keyword == "texture_coordinates") {
      const std::size_t components = counted(line, "the number of components");
      skip(components * tuples_, type_of(line));
    } else if (keyword == "global_ids" || keyword == "pedigree_ids") {
      values_of(name, 1, tuples_, type_of(line));
    } else if (keyword == "color_scalars") {
      skip(counted(line, "the number of components") * tuples_, byte_type);
    } else if (keyword == "lookup_table") {
      skip(4 * counted(line, "the size of the table"), byte_type);
    } else {
      line.fail("unknown section " + in_quotes(keyword));
    }
  }

  // Reads an array: `region` or a field if it belongs to cells and has as many components as fields may; else skips it.
  void values_of(std::string_view name, std::size_t components, std::size_t tuples, const Type& type) {
    if (!of_cells_ || !is_field_size(components)) return skip(components * tuples, type);
    if (lower(name) != "region" || components != 1) {
      need(components * tuples, type);
      ElementField field{decoded(name), components, std::vector<double>(components * tuples)};
      for (double& value : field.values) value = any_real(type);
      return add_cell_field(std::move(field), in_, cells_);
    }
    if (type.kind != NumberKind::real) {
      cells_.regions = integers(tuples, type);
      return;
    }
    read_.real_regions = true;
    skip(tuples, type);
  }

  // Fails if the rest of the file cannot hold so many values, before memory is allocated for them.
  void need(std::size_t count, const Type& type) {
    const std::size_t max_count = binary_ ? in_.left() / type.bytes : (in_.left() + 1) / 2;
    if (count > max_count) in_.fail(fmt::format("{} values should follow, the file ends too early for them", count));
  }

  double real(const Type& type) { return binary_ ? any_real(type) : in_.number("a value"); }

  double any_real(const Type& type) {
    if (!binary_) return in_.any_number("a value");
    const std::string_view bytes = in_.bytes(type.bytes);
    return type.kind == NumberKind::real ? real_value(bytes, std::endian::big)
                                         : static_cast<double>(integer_value(bytes, type.kind, std::endian::big));
  }

  std::vector<long long> integers(std::size_t count, const Type& type) {
    if (type.kind == NumberKind::real) in_.fail("values of type " + std::string(type.name), "integers");
    need(count, type);
    std::vector<long long> values(count);
    for (long long& value : values)
      value = binary_ ? integer_value(in_.bytes(type.bytes), type.kind, std::endian::big) : in_.wide_integer("a value");
    return values;
  }

  void skip(std::size_t count, const Type& type) {
    need(count, type);
    if (binary_) {
      in_.bytes(count * type.bytes);
    } else {
      for (std::size_t i = 0; i < count; ++i) in_.word("a value");
    }
  }

  Scanner in_;
  ReadMesh read_;
  VtkCells cells_;
  double version_ = 0;
  bool binary_ = false;
  bool of_cells_ = false;   ///< whether the current attributes belong to cells
  std::size_t tuples_ = 0;  ///< tuples per attribute
};

}  // namespace

ReadMesh read_vtk(std::string file, std::string_view text) { return VtkReader(std::move(file), text).read(); }

}  // namespace heml
