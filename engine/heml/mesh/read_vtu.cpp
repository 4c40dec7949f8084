// VTK XML files of unstructured grids with text arrays: docs.vtk.org, "VTK XML Formats". Parses only the XML they need:
// reads tags in sequence and looks up attributes in the text of a tag.
#include <fmt/format.h>

#include <algorithm>
#include <heml/mesh/readers.hpp>
#include <limits>

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
      Scanner values = text_of(tag);
      while (values.has_word()) read_.mesh.nodes.push_back(values.point("a coordinate"));
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

  // Skips arrays that are not numbers as text, since they may be unneeded.
  void cell_data(std::string_view name, std::string_view tag) {
    const std::string_view components = attribute(tag, "NumberOfComponents"), type = attribute(tag, "type");
    const bool integer = type.find("Int") != std::string_view::npos, scalar = components.empty() || components == "1";
    if (name == "region" && scalar) {
      if (integer) return integers(tag, cells_.regions);
      read_.real_regions = true;
    } else if ((scalar || components == "3") && (integer || type.starts_with("Float")) &&
               attribute(tag, "format") == "ascii") {
      ElementField field{unescaped(name), scalar ? 1u : 3u, {}};
      Scanner values = text_of(tag);
      while (values.has_word()) field.values.push_back(values.any_number("a value"));
      add_cell_field(std::move(field), in_, cells_);
    }
  }

  Scanner text_of(std::string_view tag) {
    if (const auto format = attribute(tag, "format"); format != "ascii")
      in_.fail(fmt::format("the array {} has format {}", in_quotes(attribute(tag, "Name")), in_quotes(format)),
               "save with data mode ASCII");
    return in_.until('<');
  }

  void integers(std::string_view tag, std::vector<long long>& to) {
    Scanner values = text_of(tag);
    while (values.has_word()) to.push_back(values.wide_integer("a value"));
  }

  Scanner in_;
  ReadMesh read_;
  bool is_vtk_ = false, in_piece_ = false;
  std::string_view section_;
  long long points_ = 0, count_ = 0;  ///< numbers of points and cells that the piece declares
  std::size_t first_node_ = 0;        ///< of the piece
  VtkCells cells_;
};

}  // namespace

ReadMesh read_vtu(std::string file, std::string_view text) { return VtuReader(std::move(file), text).read(); }

}  // namespace heml
