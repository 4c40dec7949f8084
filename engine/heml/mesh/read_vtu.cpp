// VTK XML files of unstructured grids: docs.vtk.org, "VTK XML Formats". Parses only the XML they need: reads tags in
// sequence and looks up attributes in the text of a tag. Arrays are text, base64 in their place, or appended.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <heml/mesh/binary_values.hpp>
#include <heml/mesh/readers.hpp>
#include <heml/mesh/vtk_xml_data.hpp>
#include <limits>
#include <optional>

namespace heml {
namespace {

constexpr std::string_view blanks = " \t\r\n";

// The value of key="..." in a tag; empty if there is none.
std::string_view attribute(std::string_view tag, std::string_view key) {
  for (std::size_t at = tag.find(key); at != std::string_view::npos; at = tag.find(key, at + 1)) {
    if (at == 0 || blanks.find(tag[at - 1]) == std::string_view::npos) continue;
    std::size_t open = tag.find_first_not_of(blanks, at + key.size());
    if (open == std::string_view::npos || tag[open] != '=') continue;
    open = tag.find_first_not_of(blanks, open + 1);
    if (open == std::string_view::npos || (tag[open] != '"' && tag[open] != '\'')) continue;
    const std::size_t close = tag.find(tag[open], open + 1);
    if (close != std::string_view::npos) return tag.substr(open + 1, close - open - 1);
  }
  return {};
}

std::string unescaped(std::string_view value) {
  constexpr std::pair<std::string_view, char> entities[] = {
      {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}, {"&amp;", '&'}};
  std::string text;
  while (!value.empty()) {
    const auto entity = std::find_if(std::begin(entities), std::end(entities),
                                     [&](const auto& known) { return value.starts_with(known.first); });
    const bool found = entity != std::end(entities);
    text += found ? entity->second : value[0];
    value.remove_prefix(found ? entity->first.size() : 1);
  }
  return text;
}

struct ArrayType {
  NumberKind kind;
  std::size_t bytes;
};

/// The number type of an array: Int8 to Int64, UInt8 to UInt64, Float32 or Float64; none for others, as strings.
std::optional<ArrayType> array_type(std::string_view name) {
  const std::size_t digits = std::min(name.find_first_of("0123456789"), name.size());
  const std::string_view kind = name.substr(0, digits), bits = name.substr(digits);
  const std::size_t bytes = bits == "8" ? 1 : bits == "16" ? 2 : bits == "32" ? 4 : bits == "64" ? 8 : 0;
  if (bytes == 0) return std::nullopt;
  if (kind == "Float") return bytes >= 4 ? std::optional(ArrayType{NumberKind::real, bytes}) : std::nullopt;
  if (kind == "Int") return ArrayType{NumberKind::signed_integer, bytes};
  if (kind == "UInt") return ArrayType{NumberKind::unsigned_integer, bytes};
  return std::nullopt;
}

class VtuReader {
 public:
  VtuReader(std::string file, std::string_view text) : in_(std::move(file), text) {}

  ReadMesh read() {
    while (in_.skip_past("<")) {
      if (in_.rest().starts_with("!--")) {
        if (!in_.skip_past("-->")) in_.fail("a comment does not end");
        continue;
      }
      const std::string_view tag = in_.rest().substr(0, in_.rest().find('>'));
      if (!in_.skip_past(">")) in_.fail("a tag does not end: " + in_quotes(tag));
      if (tag.starts_with("AppendedData")) break;
      process_tag(tag.substr(0, tag.find_first_of(" \t\r\n/", 1)), tag);
    }
    if (!is_vtk_) in_.fail("a .vtu file should hold a VTKFile");
    if (in_piece_) in_.fail("a Piece does not end");
    return std::move(read_);
  }

 private:
  void process_tag(std::string_view name, std::string_view tag) {
    if (name == "VTKFile") {
      if (const auto type = attribute(tag, "type"); type != "UnstructuredGrid")
        in_.fail("the VTKFile is of type " + in_quotes(type), "UnstructuredGrid");
      is_vtk_ = true;
      if (attribute(tag, "byte_order") == "BigEndian") coding_.order = std::endian::big;
      if (attribute(tag, "header_type") == "UInt64") coding_.header_bytes = 8;
      compressor_ = attribute(tag, "compressor");
      coding_.compressed = !compressor_.empty();
    } else if (!is_vtk_) {
      if (!name.starts_with('?')) in_.fail("a VTKFile should begin here, found " + in_quotes(name));
    } else if (name == "Piece") {
      begin_piece(tag);
    } else if (name == "/Piece") {
      end_piece();
    } else if (name == "Points" || name == "Cells" || name == "CellData") {
      section_ = name;
    } else if (name == "/Points" || name == "/Cells" || name == "/CellData") {
      section_ = {};
    } else if (name == "DataArray" && in_piece_) {
      array(tag);
    }
  }

  long long counted(std::string_view tag, const char* key) {
    const std::string_view text = attribute(tag, key);
    long long value = 0;
    for (char c : text) {
      if (c < '0' || c > '9' || value > std::numeric_limits<int>::max()) value = -1;
      if (value < 0) break;
      value = 10 * value + (c - '0');
    }
    if (text.empty() || value < 0 || value > std::numeric_limits<int>::max())
      in_.fail(fmt::format("{} of the Piece is {}", key, in_quotes(text)), "a count");
    return value;
  }

  void begin_piece(std::string_view tag) {
    if (in_piece_) in_.fail("a Piece within a Piece");
    in_piece_ = true;
    points_ = counted(tag, "NumberOfPoints");
    count_ = counted(tag, "NumberOfCells");
    first_node_ = read_.mesh.nodes.size();
    cells_ = VtkCells{{0}, {}, {}, {}, {}};
    if (tag.ends_with('/')) end_piece();
  }

  void end_piece() {
    if (!in_piece_) in_.fail("a Piece ends that did not begin");
    in_piece_ = false;
    const std::size_t points = read_.mesh.nodes.size() - first_node_;
    if (points != static_cast<std::size_t>(points_))
      in_.fail(fmt::format("{} points announced, {} given", points_, points));
    if (cells_.types.size() != static_cast<std::size_t>(count_))
      in_.fail(fmt::format("{} cells announced, {} given", count_, cells_.types.size()));
    add_vtk_cells(cells_, static_cast<int>(first_node_), in_, read_);
  }

  void array(std::string_view tag) {
    const std::string_view name = attribute(tag, "Name");
    if (section_ == "Points") {
      if (attribute(tag, "NumberOfComponents") != "3") in_.fail("points should have 3 components");
      points(tag);
    } else if (section_ == "Cells" && name == "connectivity") {
      integers(tag, cells_.connectivity);
    } else if (section_ == "Cells" && name == "offsets") {
      integers(tag, cells_.offsets);
    } else if (section_ == "Cells" && name == "types") {
      integers(tag, cells_.types);
    } else if (section_ == "CellData" && !name.empty()) {
      cell_data(name, tag);
    }
  }

  void points(std::string_view tag) {
    std::vector<double> values;
    reals(tag, values);
    if (values.size() % 3 != 0) in_.fail(fmt::format("the points have {} coordinates", values.size()), "three a point");
    for (std::size_t i = 0; i < values.size(); i += 3) {
      read_.mesh.nodes.emplace_back(values[i], values[i + 1], values[i + 2]);
      if (!read_.mesh.nodes.back().allFinite()) in_.fail(fmt::format("point {} is not finite", i / 3));
    }
  }

  // Skips arrays that are not numbers, since they may be unneeded.
  void cell_data(std::string_view name, std::string_view tag) {
    const std::string_view components = attribute(tag, "NumberOfComponents");
    const bool scalar = components.empty() || components == "1";
    const std::optional<ArrayType> type = array_type(attribute(tag, "type"));
    const std::size_t count = scalar ? 1 : components == "3" ? 3 : components == "12" ? point_components : 0;
    if (!type || count == 0) return;
    if (name == "region" && scalar) {
      if (type->kind != NumberKind::real) return integers(tag, cells_.regions);
      read_.real_regions = true;
      return;
    }
    ElementField field{unescaped(name), count, {}};
    reals(tag, field.values);
    add_cell_field(std::move(field), in_, cells_);
  }

  void integers(std::string_view tag, std::vector<long long>& to) {
    if (attribute(tag, "format") == "ascii") {
      Scanner values = in_.until('<');
      while (values.has_word()) to.push_back(values.wide_integer("a value"));
      return;
    }
    const ArrayType type = known_type(tag);
    if (type.kind == NumberKind::real) in_.fail(array_name(tag) + " is of real numbers", "integers");
    each_value(tag, type,
               [&](std::string_view bytes) { to.push_back(integer_value(bytes, type.kind, coding_.order)); });
  }

  void reals(std::string_view tag, std::vector<double>& to) {
    if (attribute(tag, "format") == "ascii") {
      Scanner values = in_.until('<');
      while (values.has_word()) to.push_back(values.any_number("a value"));
      return;
    }
    const ArrayType type = known_type(tag);
    each_value(tag, type, [&](std::string_view bytes) {
      to.push_back(type.kind == NumberKind::real ? real_value(bytes, coding_.order)
                                                 : static_cast<double>(integer_value(bytes, type.kind, coding_.order)));
    });
  }

  static std::string array_name(std::string_view tag) { return "the array " + in_quotes(attribute(tag, "Name")); }

  ArrayType known_type(std::string_view tag) {
    const std::string_view name = attribute(tag, "type");
    if (const auto type = array_type(name)) return *type;
    in_.fail(array_name(tag) + " is of type " + in_quotes(name), "Float64, Int64, ...");
  }

  template <class Each>
  void each_value(std::string_view tag, const ArrayType& type, Each each) {
    const std::string bytes = binary_array(tag, type);
    if (bytes.size() % type.bytes != 0)
      in_.fail(fmt::format("{} has {} bytes, its values {} each", array_name(tag), bytes.size(), type.bytes));
    for (std::size_t i = 0; i < bytes.size(); i += type.bytes) each(std::string_view(bytes).substr(i, type.bytes));
  }

  /// Arrays may not take more memory than any mesh's would: neither compressed ones, nor several that name one place.
  std::string binary_array(std::string_view tag, const ArrayType& type) {
    constexpr std::size_t max_memory_per_byte = 256, free_memory = std::size_t{16} << 20, value_bytes = 8;
    const std::string_view format = attribute(tag, "format");
    if (!compressor_.empty() && compressor_ != "vtkZLibDataCompressor")
      in_.fail("arrays compressed by " + in_quotes(compressor_) + " are not read", "save compressed by zlib, or not");
    if (format != "binary" && format != "appended")
      in_.fail(fmt::format("{} has format {}", array_name(tag), in_quotes(format)), "ascii, binary or appended");
    const bool appended = format == "appended";
    const std::string_view text = appended ? appended_text(tag) : in_.until('<').rest();
    const std::size_t left = max_memory_per_byte * in_.size() + free_memory - memory_;
    std::size_t used = 0;
    std::string bytes = vtk_array_bytes(text, !appended || appended_->base64, coding_, left / value_bytes * type.bytes,
                                        in_, in_quotes(attribute(tag, "Name")), used);
    memory_ += bytes.size() / type.bytes * value_bytes;
    if (memory_ > max_memory_per_byte * in_.size() + free_memory)
      in_.fail("the arrays take more memory than a mesh of this size");
    return bytes;
  }

  std::string_view appended_text(std::string_view tag) {
    if (!appended_) appended_ = find_appended();
    const std::string_view text = attribute(tag, "offset");
    std::size_t offset = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), offset);
    if (text.empty() || error != std::errc() || end != text.data() + text.size() || offset > appended_->text.size())
      in_.fail(fmt::format("{} is at offset {} of the appended data, which are {} bytes", array_name(tag),
                           in_quotes(text), appended_->text.size()),
               "the file is cut off or damaged, save it again");
    return appended_->text.substr(offset);
  }

  struct Appended {
    bool base64;
    std::string_view text;  ///< behind the underscore
  };

  Appended find_appended() {
    const std::string_view rest = in_.rest();
    const std::size_t begin = rest.find("<AppendedData"), end = rest.find('>', std::min(begin, rest.size()));
    const std::size_t mark = rest.find('_', std::min(end, rest.size()));
    if (mark == std::string_view::npos)
      in_.fail("the file has no AppendedData with an underscore before it", "the file is cut off, save it again");
    const std::string_view encoding = attribute(rest.substr(begin, end - begin), "encoding");
    if (encoding != "raw" && encoding != "base64")
      in_.fail("the appended data have encoding " + in_quotes(encoding), "raw or base64");
    return {encoding == "base64", rest.substr(mark + 1)};
  }

  Scanner in_;
  ReadMesh read_;
  bool is_vtk_ = false, in_piece_ = false;
  std::string_view section_;
  long long points_ = 0, count_ = 0;  ///< numbers of points and cells that the piece declares
  std::size_t first_node_ = 0;        ///< of the piece
  VtkCells cells_;
  VtkXmlCoding coding_;
  std::string_view compressor_;
  std::optional<Appended> appended_;  ///< once it is needed
  std::size_t memory_ = 0;            ///< bytes that the values of binary arrays took so far
};

}  // namespace

ReadMesh read_vtu(std::string file, std::string_view text) { return VtuReader(std::move(file), text).read(); }

}  // namespace heml
