// Gmsh: https://gmsh.info/doc/texinfo/gmsh.html, "Gmsh file formats": MSH file format, and its versions 1 and 2
// (legacy).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <heml/mesh/gmsh_data.hpp>
#include <map>
#include <optional>

namespace heml {
namespace {

// Numbers of nodes of Gmsh's types from 1, "MSH file format"; 0: not used.
constexpr std::array<std::size_t, 32> gmsh_nodes{0, 2,  3,  4,  4, 8,  6,  5,  3,  6,  9, 10, 27, 18, 14, 1,
                                                 8, 20, 15, 13, 9, 10, 12, 15, 15, 21, 4, 5,  6,  20, 35, 56};

/// Of the types that are read, whose corners stand first.
std::optional<CellShape> gmsh_shape(long long type) {
  if (type == 4 || type == 11) return CellShape::tetrahedron;
  if (type == 5 || type == 12 || type == 17) return CellShape::brick;
  if (type == 6 || type == 13 || type == 18) return CellShape::wedge;
  if (type == 7 || type == 14 || type == 19) return CellShape::pyramid;
  return std::nullopt;
}

bool is_solid(long long type) { return gmsh_shape(type).has_value(); }

// Volume elements of higher order.
bool is_other_gmsh_volume(long long type) {
  constexpr std::array volumes{29, 30, 31, 71, 79, 90, 91, 92, 93, 106, 118};
  return std::find(volumes.begin(), volumes.end(), type) != volumes.end();
}

class GmshReader {
 public:
  GmshReader(std::string file, std::string_view text) : in_(std::move(file), text, 0, true) {}

  ReadMesh read() {
    bool any_section = false;
    while (in_.next_line()) {
      const std::string name(in_.word("a section"));
      if (name[0] != '$' || name.starts_with("$End"))
        in_.fail("a section should begin here, found " + in_quotes(name), "$MeshFormat, $Nodes, $Elements, ...");
      any_section = true;
      section(name);
    }
    if (!any_section) in_.fail("the file is empty");
    data_.put(tet_numbers_, in_, read_);
    return std::move(read_);
  }

 private:
  void section(const std::string& name) {
    if (name == "$MeshFormat") {
      format();
    } else if (name == "$NOD" || name == "$Nodes") {
      if (has_nodes_) in_.fail("a second section " + name);
      has_nodes_ = true;
      name == "$NOD" || version_ < 4 ? nodes() : nodes_4();
      numbers_.finish(in_);
    } else if (name == "$ELM" || name == "$Elements") {
      if (!has_nodes_) in_.fail(name + " before the nodes");
      name == "$ELM" ? elements(1) : version_ < 4 ? elements(2) : elements_4();
    } else if (name == "$Entities" && version_ >= 4) {
      entities_4();
    } else if (name == "$PhysicalNames") {
      physical_names();
    } else if (name == "$ElementData") {
      data_.read(in_, values_, read_);
    } else {
      return skip(name);
    }
    end(name);
  }

  static std::string closing(const std::string& name) {
    if (name == "$NOD" || name == "$ELM") return "$END" + name.substr(1);
    return "$End" + name.substr(1);
  }

  void end(const std::string& name) {
    in_.expect_line(closing(name));
    const std::string_view found = in_.word(closing(name));
    if (found != closing(name))
      in_.fail(fmt::format("{} should end here, found {}", name, in_quotes(found)), closing(name));
  }

  void skip(const std::string& name) {
    const std::string mark = closing(name);
    if (values_.binary()) {
      if (!in_.skip_past("\n" + mark)) in_.fail(name + " does not end", mark);
      return;
    }
    do in_.expect_line(mark);
    while (in_.peek() != mark);
  }

  void format() {
    in_.expect_line("the version");
    version_ = in_.number("the version");
    if (version_ != 2 && version_ != 2.1 && version_ != 2.2 && version_ != 4.1)
      in_.fail(fmt::format("version {} is not read", version_), "save as Gmsh 2.2 or 4.1");
    const bool binary = in_.integer("the file type", 0, 1) == 1;
    const long long size_bytes = in_.integer("the size of numbers");
    if (!binary) return;
    if (size_bytes != 4 && size_bytes != 8) in_.fail(fmt::format("numbers of {} bytes", size_bytes), "4 or 8");
    in_.rest_of_line();
    const std::string_view one = in_.bytes(sizeof(int));
    const bool little = unsigned_value(one, std::endian::little) == 1;
    if (!little && unsigned_value(one, std::endian::big) != 1)
      in_.fail("the four bytes behind the format line should be the number 1", "the file is damaged, save it again");
    values_.set_binary(little ? std::endian::little : std::endian::big, static_cast<std::size_t>(size_bytes));
  }

  // Lines of a dimension, a tag, and a name in quotes.
  void physical_names() {
    in_.expect_line("the number of names");
    const std::size_t count = in_.count("the number of names", 3);
    for (std::size_t n = 0; n < count; ++n) {
      in_.expect_line("a name");
      const bool of_volume = in_.integer("a dimension") == 3;
      const int tag = static_cast<int>(in_.integer("a physical tag"));
      const std::string_view line = in_.rest().substr(0, in_.rest().find('\n'));
      const std::size_t open = line.find('"'), close = line.rfind('"');
      if (open == close) in_.fail("a name in quotes should follow the physical tag " + std::to_string(tag));
      if (of_volume) read_.mesh.region_names[tag] = plain_name(line.substr(open + 1, close - open - 1));
    }
  }

  // Versions 1 and 2: "number x y z".
  void nodes() {
    in_.expect_line("the number of nodes");
    const std::size_t count = in_.count("the number of nodes", 4);
    reserve_nodes(count);
    values_.begin_binary();
    for (std::size_t n = 0; n < count; ++n) {
      values_.line("a node");
      numbers_.add(values_.wide_integer("a node number", false));
      read_.mesh.nodes.push_back(values_.point("a coordinate"));
      values_.end_line("the node");
    }
  }

  // Version 1: "number type physical elementary #nodes node ...". Version 2: "number type #tags physical ... node ...".
  void elements(int version) {
    in_.expect_line("the number of elements");
    const std::size_t count = in_.count("the number of elements", 4);
    if (values_.binary()) return binary_elements_2(count);
    for (std::size_t e = 0; e < count; ++e) {
      in_.expect_line("an element");
      const long long number = in_.wide_integer("an element number");
      const long long type = in_.integer("an element type");
      read_.ignored += is_other_gmsh_volume(type);
      if (!is_solid(type)) continue;
      int region = 0;
      if (version == 1) {
        region = static_cast<int>(in_.integer("a physical tag"));
        in_.wide_integer("an elementary tag");
        const auto nodes = static_cast<long long>(gmsh_nodes[static_cast<std::size_t>(type)]);
        in_.integer("the number of nodes of an element", nodes, nodes);
      } else {
        const long long tags = in_.integer("a number of tags", 0);
        if (tags > 0) region = static_cast<int>(in_.integer("a physical tag"));
        for (long long t = 1; t < tags; ++t) in_.wide_integer("a tag");
      }
      solid(number, type, region, false);
    }
  }

  // Groups of elements of one type: their type, number and number of tags, then of each its number, tags and nodes.
  void binary_elements_2(std::size_t count) {
    values_.begin_binary();
    for (std::size_t found = 0; found < count;) {
      const long long type = values_.integer("an element type");
      const auto in_group = static_cast<std::size_t>(values_.integer("a number of elements", 1));
      const auto tags = static_cast<std::size_t>(values_.integer("a number of tags", 0));
      if (in_group > count - found) in_.fail(fmt::format("{} elements announced, more in their groups", count));
      found += in_group;
      if (!is_solid(type)) {
        skip_elements(type, in_group, tags, sizeof(int));
        continue;
      }
      for (std::size_t e = 0; e < in_group; ++e) {
        const long long number = values_.integer("an element number");
        const int region = tags > 0 ? static_cast<int>(values_.integer("a physical tag")) : 0;
        if (tags > 1) values_.skip(tags - 1, sizeof(int));
        solid(number, type, region, false);
      }
    }
  }

  // Passes over binary elements: a number, tags, and as many nodes as the type has.
  void skip_elements(long long type, std::size_t count, std::size_t tags, std::size_t number_bytes) {
    const bool known = type > 0 && type < static_cast<long long>(gmsh_nodes.size());
    if (!known) in_.fail(fmt::format("elements of type {} are not known", type), "save without them, or as ASCII");
    if (is_other_gmsh_volume(type)) read_.ignored += static_cast<long>(count);
    values_.skip(count, (1 + tags + gmsh_nodes[static_cast<std::size_t>(type)]) * number_bytes);
  }

  void entities_4() {
    values_.begin_binary();
    values_.line("the numbers of entities");
    std::array<std::size_t, 4> counts;
    for (std::size_t& count : counts) count = values_.count("a number of entities", 1, sizeof(int));
    for (std::size_t dimension = 0; dimension < 3; ++dimension)
      for (std::size_t e = 0; e < counts[dimension]; ++e) {
        values_.line("an entity");
        if (!values_.binary()) continue;
        values_.integer("an entity's tag");
        values_.skip(dimension == 0 ? 3 : 6, sizeof(double));
        skip_tags();
        if (dimension > 0) skip_tags();
      }
    for (std::size_t e = 0; e < counts[3]; ++e) {
      values_.line("a volume");
      const long long tag = values_.integer("a volume's tag");
      for (int i = 0; i < 6; ++i) values_.any_number("a volume's bound");
      const long long physical = values_.wide_integer("a number of physical tags");
      if (physical < 0) in_.fail(fmt::format("{} physical tags", physical));
      if (physical > 0) volume_region_[tag] = static_cast<int>(values_.integer("a physical tag"));
      if (!values_.binary()) continue;
      values_.skip(static_cast<std::size_t>(std::max(physical, 1ll) - 1), sizeof(int));
      skip_tags();
    }
  }

  void skip_tags() { values_.skip(values_.count("a number of tags", 1, sizeof(int)), sizeof(int)); }

  // Blocks "dimension entity parametric #nodes", each followed by its node numbers, then its coordinates.
  void nodes_4() {
    values_.begin_binary();
    values_.line("the numbers of node blocks and nodes");
    const std::size_t blocks = values_.count("a number of blocks", 4, 20);
    const std::size_t count = values_.count("the number of nodes", 4, 24 + values_.size_bytes());
    reserve_nodes(count);
    if (values_.binary()) values_.skip(2, values_.size_bytes());  // the lowest and highest number
    for (std::size_t b = 0; b < blocks; ++b) {
      values_.line("a block of nodes");
      const long long dimension = values_.integer("a dimension");
      values_.integer("an entity");
      const bool parametric = values_.integer("the parametric flag") != 0;
      const std::size_t in_block = values_.count("the number of nodes in the block", 4, 24 + values_.size_bytes());
      for (std::size_t n = 0; n < in_block; ++n) {
        values_.line("a node number");
        numbers_.add(values_.wide_integer("a node number"));
        values_.end_line("the node number");
      }
      for (std::size_t n = 0; n < in_block; ++n) {
        values_.line("a node's coordinates");
        read_.mesh.nodes.push_back(values_.point("a coordinate"));
        if (values_.binary() && parametric)
          values_.skip(static_cast<std::size_t>(std::clamp(dimension, 0ll, 3ll)), sizeof(double));
      }
    }
    if (read_.mesh.nodes.size() != count)
      in_.fail(fmt::format("{} nodes announced, {} in the blocks", count, read_.mesh.nodes.size()));
  }

  // Blocks "dimension entity type #elements", each followed by lines "number node ...".
  void elements_4() {
    values_.begin_binary();
    values_.line("the numbers of element blocks and elements");
    const std::size_t blocks = values_.count("a number of blocks", 4, 20);
    const std::size_t count = values_.count("the number of elements", 2, 2 * values_.size_bytes());
    if (values_.binary()) values_.skip(2, values_.size_bytes());
    std::size_t found = 0;
    for (std::size_t b = 0; b < blocks; ++b) {
      values_.line("a block of elements");
      values_.integer("a dimension");
      const long long entity = values_.integer("an entity"), type = values_.integer("an element type");
      const std::size_t in_block = values_.count("the number of elements in the block", 2, 2 * values_.size_bytes());
      found += in_block;
      if (values_.binary() && !is_solid(type)) {
        skip_elements(type, in_block, 0, values_.size_bytes());
        continue;
      }
      if (is_other_gmsh_volume(type)) read_.ignored += static_cast<long>(in_block);
      const auto region = volume_region_.find(entity);
      for (std::size_t e = 0; e < in_block; ++e) {
        values_.line("an element");
        if (!is_solid(type)) continue;
        const long long number = values_.wide_integer("an element number");
        solid(number, type, region == volume_region_.end() ? 0 : region->second, true);
      }
    }
    if (found != count) in_.fail(fmt::format("{} elements announced, {} in the blocks", count, found));
  }

  // wide: binary node numbers are of version 4.1.
  void solid(long long number, long long type, int region, bool wide) {
    const CellShape shape = *gmsh_shape(type);
    std::array<int, 27> all{};
    const std::span<int> nodes = std::span(all).first(gmsh_nodes[static_cast<std::size_t>(type)]);
    for (int& node : nodes) node = numbers_.find(values_.wide_integer("a node number", wide), in_);
    values_.end_line("an element's nodes");
    const std::size_t first = read_.mesh.tets.size();
    if (shape != CellShape::tetrahedron)
      divide_cell(shape, nodes, read_);
    else
      read_.mesh.tets.push_back({all[0], all[1], all[2], all[3]});
    if (shape == CellShape::tetrahedron && nodes.size() == 10)
      add_midedges({all[4], all[5], all[6], all[7], all[8], all[9]}, gmsh_midedges, read_);
    for (std::size_t t = first; t < read_.mesh.tets.size(); ++t) tet_numbers_.push_back({number, static_cast<int>(t)});
    read_.mesh.regions.resize(read_.mesh.tets.size(), region);
  }

  void reserve_nodes(std::size_t count) {
    read_.mesh.nodes.reserve(count);
    numbers_.reserve(count);
  }

  Scanner in_;
  GmshNumbers values_{in_};
  ReadMesh read_;
  NodeNumbers numbers_;
  std::vector<GmshElement> tet_numbers_;
  GmshData data_;
  double version_ = 1;
  bool has_nodes_ = false;
  std::map<long long, int> volume_region_;  ///< version 4: first physical tag of each volume entity
};

}  // namespace

ReadMesh read_gmsh(std::string file, std::string_view text) { return GmshReader(std::move(file), text).read(); }

}  // namespace heml
