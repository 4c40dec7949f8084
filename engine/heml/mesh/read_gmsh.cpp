// Gmsh: https://gmsh.info/doc/texinfo/gmsh.html, "Gmsh file formats": MSH file format, and its versions 1 and 2
// (legacy).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <heml/mesh/gmsh_data.hpp>
#include <map>

namespace heml {
namespace {

constexpr int gmsh_tetrahedron = 4, gmsh_quadratic_tetrahedron = 11;

bool is_tetrahedron(long long type) { return type == gmsh_tetrahedron || type == gmsh_quadratic_tetrahedron; }

// Hexahedra, prisms, pyramids, and volume elements of higher order but tetrahedra of ten nodes.
bool is_other_gmsh_volume(long long type) {
  constexpr std::array volumes{5, 6, 7, 12, 13, 14, 17, 18, 19, 29, 30, 31, 71, 79, 90, 91, 92, 93, 106, 118};
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
    } else if (name == "$ElementData") {
      data_.read(in_, read_);
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
    do in_.expect_line(mark);
    while (in_.peek() != mark);
  }

  void format() {
    in_.expect_line("the version");
    version_ = in_.number("the version");
    if (version_ != 2 && version_ != 2.1 && version_ != 2.2 && version_ != 4.1)
      in_.fail(fmt::format("version {} is not read", version_), "save as Gmsh 2.2 or 4.1, ASCII");
    if (in_.integer("the file type") != 0) in_.fail("the file is binary", "save as ASCII");
  }

  // Versions 1 and 2: "number x y z".
  void nodes() {
    in_.expect_line("the number of nodes");
    const std::size_t count = in_.count("the number of nodes", 4);
    reserve_nodes(count);
    for (std::size_t n = 0; n < count; ++n) {
      in_.expect_line("a node");
      numbers_.add(in_.wide_integer("a node number"));
      read_.mesh.nodes.push_back(in_.point("a coordinate"));
      in_.end_line("the node");
    }
  }

  // Version 1: "number type physical elementary #nodes node ...". Version 2: "number type #tags physical ... node ...".
  void elements(int version) {
    in_.expect_line("the number of elements");
    const std::size_t count = in_.count("the number of elements", 4);
    for (std::size_t e = 0; e < count; ++e) {
      in_.expect_line("an element");
      const long long number = in_.wide_integer("an element number");
      const long long type = in_.integer("an element type");
      read_.ignored += is_other_gmsh_volume(type);
      if (!is_tetrahedron(type)) continue;
      int region = 0;
      if (version == 1) {
        region = static_cast<int>(in_.integer("a physical tag"));
        in_.wide_integer("an elementary tag");
        const int nodes = type == gmsh_tetrahedron ? 4 : 10;
        in_.integer("the number of nodes of a tetrahedron", nodes, nodes);
      } else {
        const long long tags = in_.integer("a number of tags", 0);
        if (tags > 0) region = static_cast<int>(in_.integer("a physical tag"));
        for (long long t = 1; t < tags; ++t) in_.wide_integer("a tag");
      }
      tetrahedron(number, type, region);
    }
  }

  void entities_4() {
    in_.expect_line("the numbers of entities");
    std::array<std::size_t, 4> counts;
    for (std::size_t& count : counts) count = in_.count("a number of entities", 1);
    for (std::size_t e = 0; e < counts[0] + counts[1] + counts[2]; ++e) in_.expect_line("an entity");
    for (std::size_t e = 0; e < counts[3]; ++e) {
      in_.expect_line("a volume");
      const long long tag = in_.integer("a volume's tag");
      for (int i = 0; i < 6; ++i) in_.number("a volume's bound");
      if (in_.integer("a number of physical tags", 0) > 0)
        volume_region_[tag] = static_cast<int>(in_.integer("a physical tag"));
    }
  }

  // Blocks "dimension entity parametric #nodes", each followed by its node numbers, then its coordinates.
  void nodes_4() {
    in_.expect_line("the numbers of node blocks and nodes");
    const std::size_t blocks = in_.count("a number of blocks", 4), count = in_.count("the number of nodes", 4);
    reserve_nodes(count);
    for (std::size_t b = 0; b < blocks; ++b) {
      in_.expect_line("a block of nodes");
      for (const char* what : {"a dimension", "an entity", "the parametric flag"}) in_.integer(what);
      const std::size_t in_block = in_.count("the number of nodes in the block", 4);
      for (std::size_t n = 0; n < in_block; ++n) {
        in_.expect_line("a node number");
        numbers_.add(in_.wide_integer("a node number"));
        in_.end_line("the node number");
      }
      for (std::size_t n = 0; n < in_block; ++n) {
        in_.expect_line("a node's coordinates");
        read_.mesh.nodes.push_back(in_.point("a coordinate"));
      }
    }
    if (read_.mesh.nodes.size() != count)
      in_.fail(fmt::format("{} nodes announced, {} in the blocks", count, read_.mesh.nodes.size()));
  }

  // Blocks "dimension entity type #elements", each followed by lines "number node ...".
  void elements_4() {
    in_.expect_line("the numbers of element blocks and elements");
    const std::size_t blocks = in_.count("a number of blocks", 4), count = in_.count("the number of elements", 2);
    std::size_t found = 0;
    for (std::size_t b = 0; b < blocks; ++b) {
      in_.expect_line("a block of elements");
      in_.integer("a dimension");
      const long long entity = in_.integer("an entity"), type = in_.integer("an element type");
      const std::size_t in_block = in_.count("the number of elements in the block", 2);
      found += in_block;
      if (is_other_gmsh_volume(type)) read_.ignored += static_cast<long>(in_block);
      const auto region = volume_region_.find(entity);
      for (std::size_t e = 0; e < in_block; ++e) {
        in_.expect_line("an element");
        if (!is_tetrahedron(type)) continue;
        const long long number = in_.wide_integer("an element number");
        tetrahedron(number, type, region == volume_region_.end() ? 0 : region->second);
      }
    }
    if (found != count) in_.fail(fmt::format("{} elements announced, {} in the blocks", count, found));
  }

  void tetrahedron(long long number, long long type, int region) {
    const auto node = [&] {
      const long long node_number = in_.wide_integer("a node number");
      return numbers_.find(node_number, in_);
    };
    Tet tet;
    for (int& corner : tet) corner = node();
    tet_numbers_.push_back({number, static_cast<int>(read_.mesh.tets.size())});
    read_.mesh.tets.push_back(tet);
    if (type == gmsh_quadratic_tetrahedron) {
      std::array<int, 6> middles;
      for (int& middle : middles) middle = node();
      add_midedges(middles, gmsh_midedges, read_);
    }
    in_.end_line("a tetrahedron's nodes");
    read_.mesh.regions.push_back(region);
  }

  void reserve_nodes(std::size_t count) {
    read_.mesh.nodes.reserve(count);
    numbers_.reserve(count);
  }

  Scanner in_;
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
