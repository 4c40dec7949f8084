// Medit: P. Frey, MEDIT: an interactive mesh visualization software, INRIA RT-0253 (2001), section 7.2.
#include <fmt/format.h>

#include <cctype>
#include <heml/mesh/readers.hpp>
#include <optional>

namespace heml {
namespace {

bool is_keyword(std::string_view word) { return !word.empty() && std::isalpha(static_cast<unsigned char>(word[0])); }

std::optional<CellShape> medit_shape(std::string_view keyword) {
  if (keyword == "Tetrahedra") return CellShape::tetrahedron;
  if (keyword == "Hexahedra" || keyword == "Hexaedra") return CellShape::brick;
  if (keyword == "Prisms" || keyword == "Pentahedra") return CellShape::wedge;
  if (keyword == "Pyramids") return CellShape::pyramid;
  return std::nullopt;
}

bool is_other_medit_volume(std::string_view keyword) {
  return keyword.starts_with("TetrahedraP") || keyword.starts_with("HexahedraQ");
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

void read_solids(CellShape shape, std::string_view keyword, Scanner& in, ReadMesh& read) {
  const std::size_t corners = corners_of(shape), count = in.count("the number of elements", corners + 1);
  const long long nodes = static_cast<long long>(read.mesh.nodes.size());
  if (nodes == 0) in.fail(std::string(keyword) + " before Vertices");
  for (std::size_t c = 0; c < count; ++c) {
    std::array<int, 8> cell{};
    for (std::size_t i = 0; i < corners; ++i)
      cell[i] = static_cast<int>(in.integer("an element's vertex", 1, nodes)) - 1;
    if (shape != CellShape::tetrahedron)
      divide_cell(shape, std::span(cell).first(corners), read);
    else
      read.mesh.tets.push_back({cell[0], cell[1], cell[2], cell[3]});
    read.mesh.regions.resize(read.mesh.tets.size(), static_cast<int>(in.integer("an element's reference")));
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
    } else if (const auto shape = medit_shape(keyword)) {
      read_solids(*shape, keyword, in, read);
    } else {
      if (is_other_medit_volume(keyword)) read.ignored += static_cast<long>(in.count("a number of cells", 5));
      while (in.has_word() && !is_keyword(in.peek())) in.word("a value");
    }
  }
  return read;
}

}  // namespace heml
