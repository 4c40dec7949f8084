#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <heml/base/warning_collector.hpp>
#include <heml/mesh/quality.hpp>
#include <heml/mesh/read.hpp>
#include <heml/mesh/readers.hpp>
#include <heml/mesh/split_cell.hpp>
#include <heml/mesh/surface.hpp>
#include <messages.hpp>
#include <numeric>
#include <random>

#include "engine/mesh/any_format.hpp"
#include "engine/mesh/files.hpp"

namespace heml::split_cell_test {

namespace {

struct Cell {
  CellShape shape;
  std::vector<int> corners;
};

double volume_of(const TetMesh& mesh, const Tet& t) {
  const auto X = [&](std::size_t i) { return mesh.nodes[static_cast<std::size_t>(t[i])]; };
  return signed_volume(X(0), X(1), X(2), X(3));
}

double volume_of(const TetMesh& mesh) {
  return std::accumulate(mesh.tets.begin(), mesh.tets.end(), 0.0,
                         [&](double sum, const Tet& t) { return sum + volume_of(mesh, t); });
}

/// The cells as tetrahedra, with their nodes numbered at random.
TetMesh divided(const std::vector<Vec3>& nodes, const std::vector<Cell>& cells, unsigned seed) {
  std::vector<int> number(nodes.size());
  std::iota(number.begin(), number.end(), 0);
  std::shuffle(number.begin(), number.end(), std::mt19937(seed));
  TetMesh mesh;
  mesh.nodes.resize(nodes.size());
  for (std::size_t n = 0; n < nodes.size(); ++n) mesh.nodes[static_cast<std::size_t>(number[n])] = nodes[n];
  for (const Cell& cell : cells) {
    std::vector<int> corners;
    for (const int n : cell.corners) corners.push_back(number[static_cast<std::size_t>(n)]);
    CHECK(split_cell(cell.shape, corners, mesh.nodes, mesh.tets));
  }
  mesh.regions.assign(mesh.tets.size(), 0);
  return mesh;
}

const std::vector<Vec3> cube{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
const std::vector<int> all_eight{0, 1, 2, 3, 4, 5, 6, 7};

}  // namespace

TEST_CASE("neighbouring bricks fit, however their nodes are numbered") {
  constexpr int cells = 3, side = cells + 1;
  std::vector<Vec3> nodes;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> shake(-0.15, 0.15);
  for (int n = 0; n < side * side * side; ++n) {
    const int at[] = {n % side, n / side % side, n / (side * side)};
    nodes.emplace_back(at[0], at[1], at[2]);
    if (std::all_of(std::begin(at), std::end(at), [](int i) { return i > 0 && i < cells; }))
      nodes.back() += Vec3(shake(random), shake(random), shake(random));  // no side is plane then
  }
  std::vector<Cell> bricks;
  for (int k = 0; k < cells; ++k)
    for (int j = 0; j < cells; ++j)
      for (int i = 0; i < cells; ++i) {
        const auto at = [&](int a, int b, int c) { return i + a + side * (j + b + side * (k + c)); };
        bricks.push_back(
            {CellShape::brick,
             {at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0), at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)}});
      }
  for (unsigned seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    TetMesh mesh = divided(nodes, bricks, seed);
    CHECK(mesh.tets.size() == 6 * bricks.size());
    CHECK(volume_of(mesh) == doctest::Approx(27).epsilon(1e-12));
    CHECK(extract_boundary(mesh).triangles.size() == 6 * 9 * 2);
    const QualityReport report = check_tets(mesh);
    CHECK(report.flipped == 0);
    CHECK(report.nonmanifold_edges == 0);
    CHECK(report.components == 1);
  }
}

TEST_CASE("a brick, a wedge and a pyramid that share sides fit") {
  std::vector<Vec3> nodes = cube;
  nodes.insert(nodes.end(), {{2, 0, 0}, {2, 0, 1}, {0.5, 0.5, 2}});
  const std::vector<Cell> cells{
      {CellShape::brick, all_eight}, {CellShape::wedge, {1, 8, 2, 5, 9, 6}}, {CellShape::pyramid, {4, 5, 6, 7, 10}}};
  for (unsigned seed = 0; seed < 50; ++seed) {
    CAPTURE(seed);
    TetMesh mesh = divided(nodes, cells, seed);
    CHECK(mesh.tets.size() == 6 + 3 + 2);
    CHECK(volume_of(mesh) == doctest::Approx(1 + 0.5 + 1.0 / 3).epsilon(1e-12));
    CHECK(extract_boundary(mesh).triangles.size() == 4 * 2 + (2 + 2 * 2) + 4);
    CHECK(check_tets(mesh).nonmanifold_edges == 0);
  }
}

TEST_CASE("tetrahedra of cells that are wound the other way have positive volumes too") {
  const std::vector<Cell> cells{{CellShape::brick, {4, 5, 6, 7, 0, 1, 2, 3}},
                                {CellShape::wedge, {0, 2, 1, 4, 6, 5}},  // as in VTK
                                {CellShape::wedge, {0, 1, 2, 4, 5, 6}},
                                {CellShape::pyramid, {3, 2, 1, 0, 6}},
                                {CellShape::tetrahedron, {0, 2, 1, 4}}};
  for (const Cell& cell : cells) {
    const TetMesh mesh = divided(cube, {cell}, 3);
    CHECK_FALSE(mesh.tets.empty());
    for (const Tet& t : mesh.tets) CHECK(volume_of(mesh, t) > 0.1);
  }
}

TEST_CASE("a brick that is drawn as a wedge is divided as that wedge") {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const TetMesh mesh = divided(cube, {{CellShape::brick, {0, 1, 2, 2, 4, 5, 6, 6}}}, seed);
    CHECK(mesh.tets.size() == 3);
    CHECK(volume_of(mesh) == doctest::Approx(0.5).epsilon(1e-12));
    CHECK(divided(cube, {{CellShape::brick, {0, 0, 0, 0, 4, 5, 6, 7}}}, seed).tets.size() == 2);  // a pyramid
  }
}

TEST_CASE("a brick whose tetrahedra overlap is told of") {
  std::vector<Vec3> nodes = cube;
  nodes[6] = Vec3(-0.5, -0.5, 0.2);
  std::vector<Tet> tets;
  CHECK_FALSE(split_cell(CellShape::brick, all_eight, nodes, tets));
  CHECK(tets.size() == 6);
}

TEST_CASE("nodes in the middle of the edges of bricks are left out, and it is told") {
  // A quadratic brick, whose last node is the corner of a tetrahedron beside it; then one of ten nodes beside both.
  std::string text = "*NODE\n";
  for (int n = 1; n <= 30; ++n) {
    const Vec3 x = n <= 8 ? cube[static_cast<std::size_t>(n - 1)] : Vec3(2, 2, n);
    text += fmt::format("{}, {}, {}, {}\n", n, x.x(), x.y(), x.z());
  }
  const std::string ten = "*ELEMENT, TYPE=C3D10\n3, 1, 2, 3, 30, 21, 22, 23, 24, 25, 9\n";
  text += "*ELEMENT, TYPE=C3D20R\n1";
  for (int n = 1; n <= 20; ++n) text += fmt::format(",{}{}", n == 13 ? "\n" : " ", n);
  text += "\n*ELEMENT, TYPE=C3D4\n2, 1, 2, 3, 20\n";
  for (const bool with_ten : {false, true}) {
    const TemporaryFolder folder;
    const auto file = folder.file("brick.inp", with_ten ? text + ten : text);
    const WarningCollector warnings;
    MidEdges midedges;
    const TetMesh mesh = read_tet_mesh(file, &midedges);
    CHECK(midedges.empty());
    CHECK(mesh.nodes.size() == (with_ten ? 9 + 5 : 9 + 10));  // nodes that no element names stay
    CHECK(mesh.nodes[8] == Vec3(2, 2, 20));
    CHECK(mesh.nodes.back() == Vec3(2, 2, 30));
    CHECK(mesh.tets[6] == Tet{0, 1, 2, 8});
    if (with_ten) CHECK(mesh.tets[7] == Tet{0, 1, 2, static_cast<int>(mesh.nodes.size()) - 1});
    REQUIRE(warnings.texts().size() == (with_ten ? 3 : 2));
    CHECK(says(warnings.texts().back(),
               {"nodes are numbered anew", "\"nodes\" of a scene and results count from 0",
                "node 19 of the file, counted from 0, is 8 there", "before node 8 keep their numbers"}));
    CHECK(says(warnings.texts()[with_ten ? 1 : 0],
               {"1 bricks, wedges and pyramids were divided", "11 nodes in the middle"}));
    if (with_ten) CHECK(says(warnings.texts()[0], {"1 tetrahedra have ten nodes", "6 mid-edge nodes"}));
  }
}

namespace {

/// A brick and a pyramid on it, of regions 4 and 9, in a format that lists nodes and elements in lines.
const std::string points = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n.5 .5 2\n";

std::string numbered(const std::string& separator) {
  std::string text;
  for (std::size_t at = 0, n = 1; at < points.size(); ++n) {
    const std::size_t end = points.find('\n', at);
    std::string line = points.substr(at, end - at);
    for (std::size_t k = 0; (k = line.find(' ', k)) < line.size(); k += separator.size()) line.replace(k, 1, separator);
    text += fmt::format("{}{}{}\n", n, separator, line);
    at = end + 1;
  }
  return text;
}

const std::string vtk = "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 9 double\n" + points;
const std::string vtk_data =
    "CELL_DATA 2\nSCALARS region int 1\nLOOKUP_TABLE default\n4 9\nSCALARS heat double 1\nLOOKUP_TABLE default\n.5 "
    ".25\n";

struct Sample {
  const char* name;
  std::string_view format;
  std::string text;
};

std::vector<Sample> brick_and_pyramid() {
  const std::string gmsh_2 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n9\n" + numbered(" ") +
                             "$EndNodes\n$Elements\n2\n1 5 2 4 1 1 2 3 4 5 6 7 8\n2 7 2 9 1 5 6 7 8 9\n$EndElements\n"
                             "$ElementData\n1\n\"heat\"\n1\n0\n3\n0\n1\n2\n1 .5\n2 .25\n$EndElementData\n";
  const std::string gmsh_1 =
      "$NOD\n9\n" + numbered(" ") + "$ENDNOD\n$ELM\n2\n1 5 4 1 8 1 2 3 4 5 6 7 8\n2 7 9 1 5 5 6 7 8 9\n$ENDELM\n";
  std::string medit = "MeshVersionFormatted 2\nDimension 3\nVertices\n9\n" + points +
                      "Hexahedra\n1\n1 2 3 4 5 6 7 8 4\nPyramids\n1\n5 6 7 8 9 9\nEnd\n";
  for (std::size_t at = medit.find("0 0 0"), k = 0; k < 9; ++k, at += 3)
    medit.replace(at = medit.find('\n', at), 1, " 0\n");
  const std::string abaqus = "*NODE\n" + numbered(", ") +
                             "*ELEMENT, TYPE=C3D8R, ELSET=a\n7, 1, 2, 3, 4,\n5, 6, 7, 8\n*ELEMENT, TYPE=C3D5, "
                             "ELSET=b\n8, 5, 6, 7, 8, 9\n";
  return {{"Gmsh 2.2", "msh", gmsh_2},
          {"Gmsh 1.0", "msh", gmsh_1},
          {"Medit", "mesh", medit},
          {"VTK", "vtk", vtk + "CELLS 2 15\n8 0 1 2 3 4 5 6 7\n5 4 5 6 7 8\nCELL_TYPES 2\n12 14\n" + vtk_data},
          {"voxel", "vtk", vtk + "CELLS 2 15\n8 0 1 3 2 4 5 7 6\n5 4 5 6 7 8\nCELL_TYPES 2\n11 14\n" + vtk_data},
          {"Abaqus", "inp", abaqus}};
}

ReadMesh read_by(const Sample& sample) {
  if (sample.format == "msh") return read_gmsh("a", sample.text);
  if (sample.format == "mesh") return read_medit("a", sample.text);
  if (sample.format == "vtk") return read_vtk("a", sample.text);
  return read_abaqus("a", sample.text);
}

}  // namespace

TEST_CASE("bricks and pyramids of every format become tetrahedra with their regions") {
  int with_field = 0;
  for (const Sample& sample : brick_and_pyramid()) {
    CAPTURE(sample.name);
    const ReadMesh read = read_by(sample);
    TetMesh mesh = read.mesh;
    REQUIRE(mesh.tets.size() == 8);
    CHECK(read.divided == 2);
    CHECK(read.ignored == 0);
    CHECK(read.bent == 0);
    CHECK(volume_of(mesh) == doctest::Approx(1 + 1.0 / 3).epsilon(1e-12));
    REQUIRE(mesh.regions.size() == 8);
    const bool by_sets = sample.format == "inp";
    for (std::size_t t = 0; t < 8; ++t) CHECK(mesh.regions[t] == (by_sets ? (t < 6 ? 1 : 2) : (t < 6 ? 4 : 9)));
    const ElementField* heat = find_field(mesh, "heat");
    with_field += heat != nullptr;
    if (heat) CHECK(heat->values == std::vector<double>{.5, .5, .5, .5, .5, .5, .25, .25});
    CHECK(extract_boundary(mesh).triangles.size() == 5 * 2 + 4);
    CHECK(check_tets(mesh).flipped == 0);
  }
  CHECK(with_field == 3);
}

TEST_CASE("damaged bricks are read or refused") {
  std::mt19937 random(11);
  const auto below = [&](std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
  };
  const std::string bytes = "0123456789-. \n,";
  for (const Sample& sample : brick_and_pyramid()) {
    const auto format =
        static_cast<std::size_t>(std::find(formats.begin(), formats.end(), sample.format) - formats.begin());
    CHECK(read_and_check(format, sample.text));
    int valid = 0;
    for (int k = 0; k < 2000; ++k) {
      std::string text = sample.text;
      for (std::size_t changes = 1 + below(3); changes > 0; --changes)
        text[below(text.size())] = bytes[below(bytes.size())];
      valid += read_and_check(format, text);
    }
    CHECK(valid > 100);
  }
}

}  // namespace heml::split_cell_test
