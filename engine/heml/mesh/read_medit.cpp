// Medit: P. Frey, MEDIT: an interactive mesh visualization software, INRIA RT-0253 (2001), section 7.2.
#include <fmt/format.h>

#include <cctype>
#include <heml/mesh/readers.hpp>

namespace heml {
namespace {

bool is_keyword(std::string_view word) { return !word.empty() && std::isalpha(static_cast<unsigned char>(word[0])); }

bool is_other_medit_volume(std::string_view keyword) {
  return keyword == "Hexahedra" || keyword == "Hexaedra" || keyword == "Prisms" || keyword == "Pentahedra" ||
         keyword == "Pyramids" || keyword.starts_with("TetrahedraP") || keyword.starts_with("HexahedraQ");
}

void read_vertices(Scanner& in, ReadMesh& read) {
  const std::size_t count = in.count("the number of vertices", 4);
  if (!read.mesh.nodes.empty()) in.fail("a second section Vertices");
  read.mesh.nodes.reserve(count);
  for (std::size_t n = 0; n < count; ++n) {
    read.mesh.nodes.push_back(in.point("a coordinate"));
    in.integer("a vertex's reference");
  }
}

void read_tetrahedra(Scanner& in, ReadMesh& read) {
  const std::size_t count = in.count("the number of tetrahedra", 5);
  const long long nodes = static_cast<long long>(read.mesh.nodes.size());
  if (nodes == 0) in.fail("Tetrahedra before Vertices");
  read.mesh.tets.reserve(count);
  read.mesh.regions.reserve(count);
  for (std::size_t t = 0; t < count; ++t) {
    Tet tet;
    for (int& node : tet) node = static_cast<int>(in.integer("a tetrahedron's vertex", 1, nodes)) - 1;
    read.mesh.tets.push_back(tet);
    read.mesh.regions.push_back(static_cast<int>(in.integer("a tetrahedron's reference")));
  }
}

}  // namespace

ReadMesh read_medit(std::string file, std::string_view text) {
  Scanner in(std::move(file), text, '#');
  ReadMesh read;
  if (const auto first = in.word("MeshVersionFormatted"); first != "MeshVersionFormatted")
    in.fail("a Medit file should begin with MeshVersionFormatted, found " + in_quotes(first));
  in.integer("the version", 0, 9);
  while (in.has_word()) {
    const std::string_view keyword = in.word("a section");
    if (!is_keyword(keyword)) in.fail("a section should begin here, found " + in_quotes(keyword));
    if (keyword == "End") break;
    if (keyword == "Dimension") {
      in.integer("the dimension", 3, 3);
    } else if (keyword == "Vertices") {
      read_vertices(in, read);
    } else if (keyword == "Tetrahedra") {
      read_tetrahedra(in, read);
    } else {
      if (is_other_medit_volume(keyword)) read.ignored += static_cast<long>(in.count("a number of cells", 5));
      while (in.has_word() && !is_keyword(in.peek())) in.word("a value");
    }
  }
  return read;
}

}  // namespace heml
