#include <doctest/doctest.h>

#include <heml/base/warning_collector.hpp>
#include <heml/mesh/quality.hpp>
#include <heml/mesh/read.hpp>
#include <heml/mesh/readers.hpp>
#include <messages.hpp>
#include <regex>

#include "engine/mesh/files.hpp"
#include "engine/mesh/samples.hpp"

namespace heml::read_test {

namespace {

TetMesh from_text(const std::string& name, const std::string& text) {
  const TemporaryFolder folder;
  return read_tet_mesh(folder.file(name, text));
}

std::string refusal_of(const std::string& name, const std::string& text) {
  return refusal([&] { from_text(name, text); });
}

void check_sample(const TetMesh& mesh) {
  CHECK(mesh.nodes == std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1.5}});
  CHECK(mesh.tets == std::vector<Tet>{{0, 1, 2, 3}, {1, 2, 3, 4}});
  CHECK(mesh.regions == std::vector<int>{7, -3});
}

}  // namespace

TEST_CASE("reads Gmsh 1.0 with gaps in the numbering") { check_sample(from_text("a.msh", samples::gmsh_1)); }
TEST_CASE("reads Gmsh 2.2 with unsorted node numbers, names and other cells") {
  check_sample(from_text("a.msh", samples::gmsh_2));
}
TEST_CASE("reads Gmsh 4.1, regions through its entities") { check_sample(from_text("a.msh", samples::gmsh_4)); }
TEST_CASE("reads Gmsh 4.1 without entities as region 0") {
  const std::size_t begin = samples::gmsh_4.find("$Entities"), end = samples::gmsh_4.find("$Nodes");
  const TetMesh mesh = from_text("a.msh", std::string(samples::gmsh_4).erase(begin, end - begin));
  CHECK(mesh.tets.size() == 2);
  CHECK(mesh.regions == std::vector<int>{0, 0});
}
TEST_CASE("reads Medit with comments and blank lines") { check_sample(from_text("a.mesh", samples::medit)); }
TEST_CASE("reads legacy VTK, ASCII, both layouts of cells") {
  check_sample(from_text("a.vtk", samples::vtk));
  check_sample(from_text("a.vtk", samples::vtk_5));
}
TEST_CASE("reads legacy VTK, binary, both layouts of cells") {
  check_sample(from_text("a.vtk", samples::vtk_binary));
  check_sample(from_text("a.vtk", samples::vtk_5_binary));
}
TEST_CASE("reads VTK XML as text") { check_sample(from_text("a.vtu", samples::vtu)); }
TEST_CASE("reads VTK XML of two pieces") {
  const std::size_t begin = samples::vtu.find("<Piece"), end = samples::vtu.find("</Piece>") + 8;
  const std::string piece = samples::vtu.substr(begin, end - begin);
  const TetMesh mesh = from_text("a.vtu", replaced(samples::vtu, piece, piece + piece));
  CHECK(mesh.nodes.size() == 10);
  REQUIRE(mesh.tets.size() == 4);
  CHECK(mesh.tets[2] == Tet{5, 6, 7, 8});
  CHECK(mesh.regions == std::vector<int>{7, -3, 7, -3});
}
TEST_CASE("reads TetGen by either name, numbered from 1 or from 0") {
  const TemporaryFolder folder;
  folder.file("a.node", samples::node);
  folder.file("a.ele", samples::ele);
  check_sample(read_tet_mesh(folder / "a.node"));
  check_sample(read_tet_mesh(folder / "a.ele"));
  folder.file("b.node", "5 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4 1 1 1.5\n");
  folder.file("b.ele", "2 4 0\n0 0 1 2 3\n1 1 2 3 4\n");
  CHECK(read_tet_mesh(folder / "b.node").tets == std::vector<Tet>{{0, 1, 2, 3}, {1, 2, 3, 4}});
}

TEST_CASE("reads lines that end as on Windows, a byte order mark, and endings in capitals") {
  for (const auto& [name, text] : {std::pair{"A.MSH", samples::gmsh_2},
                                   {"a.mesh", samples::medit},
                                   {"a.vtk", samples::vtk_5},
                                   {"a.Vtu", samples::vtu}}) {
    std::string windows;
    for (char c : text) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
    check_sample(from_text(name, windows));
  }
  check_sample(from_text("a.mesh", "\xEF\xBB\xBF" + samples::medit));
}

TEST_CASE("reads numbers as people write them") {
  const auto with = [](const std::string& number) {
    return from_text("a.mesh", replaced(samples::medit, "1 1 1.5", "1 1 " + number)).nodes[4][2];
  };
  CHECK(with("+1.5e+00") == 1.5);
  CHECK(with("15E-1") == 1.5);
  CHECK(with("1e-400") == 0);
  CHECK(with(".5") == 0.5);
  CHECK(with("2.") == 2.0);
}

TEST_CASE("reads Gmsh node numbers from one end of 64 bits to the other") {
  for (std::string text : {samples::gmsh_1, samples::gmsh_2}) {
    text = std::regex_replace(text, std::regex(R"(\b10\b)"), "-9223372036854775808");
    text = std::regex_replace(text, std::regex(R"(\b40\b)"), "9223372036854775807");
    check_sample(from_text("a.msh", text));
  }
}

TEST_CASE("refuses a number with two signs") {
  CHECK(says(refusal_of("a.mesh", replaced(samples::medit, "1 1 1.5", "1 +-1 1.5")), {"line", "'+-1'"}));
  CHECK(says(refusal_of("a.mesh", replaced(samples::medit, "2 3 4 5 -3", "2 3 4 5 +-3")), {"line", "'+-3'"}));
}

TEST_CASE("counts other cells with a volume and keeps the tetrahedra") {
  std::string text = replaced(samples::gmsh_2, "3 2 0 40 20 21", "3 30 0 40 20 21 33 10 40 20 21");
  CHECK(read_gmsh("a", text).ignored == 1);
  text = replaced(samples::medit, "Triangles\n1\n1 2 3 5", "TetrahedraP2\n1\n1 2 3 4 5 1 0");
  CHECK(read_medit("a", text).ignored == 1);
  text = replaced(samples::vtk, "5 10 10", "42 10 10");
  CHECK(read_vtk("a", text).ignored == 1);
}

TEST_CASE("refuses a file without tetrahedra and counts what it holds") {
  const std::string text = replaced(samples::vtk, "5 10 10", "5 42 15");
  CHECK(says(refusal_of("a.vtk", text), {"a.vtk", "5 nodes but no tetrahedra", "2 other cells"}));
}

TEST_CASE("refuses broken Gmsh files by line") {
  const auto told = [](const std::string& from, const std::string& to) {
    return refusal_of("a.msh", replaced(samples::gmsh_2, from, to));
  };
  CHECK(says(told("2.2 0 8", "4.0 0 8"), {"a.msh: line 2", "version 4", "4.1"}));
  CHECK(says(told("2.2 0 8", "2.2 1 8"), {"line 3", "the number 1", "damaged"}));
  CHECK(says(told("3 7 \"left lobe\"", "3 7 left lobe"), {"line 6", "name in quotes"}));
  CHECK(says(told("21 0 1 0", "21 0 l 0"), {"line 12", "number", "'l'"}));
  CHECK(says(told("21 0 1 0", "21 0 1"), {"line 12", "ends"}));
  CHECK(says(told("21 0 1 0", "21 0 1 nan"), {"line 12", "not finite", "nan"}));
  CHECK(says(told("21 0 1 0", "21 0 1 1e999"), {"line 12", "not finite", "1e999"}));
  CHECK(says(told("21 0 1 0", "20 0 1 0"), {"node number 20", "twice"}));
  CHECK(says(told("40 20 21 33\n", "40 20 22 33\n"), {"line 19", "node 22"}));
  CHECK(says(told("40 20 21 33\n", "40 20 21\n"), {"line 19", "ends"}));
  CHECK(says(told("Nodes\n5", "Nodes\n2000000000"), {"line 9", "2000000000"}));
  CHECK(says(told("Nodes\n5", "Nodes\n4"), {"line 14", "$EndNodes"}));
  CHECK(says(told("Nodes\n5", "Nodes\n-5"), {"line 9", "-5"}));
  CHECK(says(told("$EndElements\n", ""), {"ends where $EndElements"}));
  CHECK(says(refusal_of("a.msh",
                        "\x7f"
                        "ELF\x01\x02\x03"),
             {"line 1", "section"}));
  CHECK(says(refusal_of("a.msh", ""), {"line 1", "empty"}));
}

TEST_CASE("refuses broken Gmsh 4.1 files by line") {
  const auto told = [](const std::string& from, const std::string& to) {
    return refusal_of("a.msh", replaced(samples::gmsh_4, from, to));
  };
  CHECK(says(told("2 5 1 6", "2 6 1 6"), {"6 nodes announced, 5"}));
  CHECK(says(told("3 3 1 3\n", "3 4 1 3\n"), {"4 elements announced, 3"}));
  CHECK(says(told("3 1 0 4\n", "3 1 0 400000\n"), {"line 16", "400000"}));
  CHECK(says(told("1 0 1 2\n", "1 0 1 999999999\n"), {"line 5", "999999999"}));
}

TEST_CASE("refuses broken Medit files by line") {
  const auto told = [](const std::string& from, const std::string& to) {
    return refusal_of("a.mesh", replaced(samples::medit, from, to));
  };
  CHECK(says(told("Dimension\n3", "Dimension\n2"), {"a.mesh: line 4", "'2'"}));
  CHECK(says(told("2 3 4 5 -3", "2 3 4 6 -3"), {"line 21", "'6'", "1 to 5"}));
  CHECK(says(told("2 3 4 5 -3", "2 3 4 0 -3"), {"line 21", "'0'"}));
  CHECK(says(told("Vertices\n5", "Vertices\n6"), {"line 15", "Triangles"}));
  CHECK(says(told("Vertices\n5", "Vertices\n4"), {"line 14", "section"}));
  CHECK(says(told("Vertices\n5", "Vertices\n99999999999"), {"line 8", "99999999999"}));
  CHECK(says(refusal_of("a.mesh", "hello"), {"line 1", "MeshVersionFormatted"}));
  CHECK(says(refusal_of("a.mesh", "MeshVersionFormatted 1 Tetrahedra 1 1 2 3 4 0"), {"before Vertices"}));
}

TEST_CASE("refuses broken VTK files by line") {
  const auto told = [](const std::string& from, const std::string& to) {
    return refusal_of("a.vtk", replaced(samples::vtk, from, to));
  };
  CHECK(says(told("# vtk", "% vtk"), {"a.vtk: line 1"}));
  CHECK(says(told("UNSTRUCTURED_GRID", "POLYDATA"), {"line 4", "POLYDATA", "UNSTRUCTURED_GRID"}));
  CHECK(says(told("POINTS 5 float", "POINTS 5 colour"), {"line 5", "colour"}));
  CHECK(says(told("POINTS 5 float", "POINTS 500000000 float"), {"line 5", "500000000"}));
  CHECK(says(told("CELLS 3 14", "CELLS 3 13"), {"line 8"}));
  CHECK(says(told("4 1 2 3 4\n", "4 1 2 3 5\n"), {"cell 2", "node 5"}));
  CHECK(says(told("4 1 2 3 4\n", "-4 1 2 3 4\n"), {"line 8", "cell 2"}));
  CHECK(says(told("CELL_TYPES 3\n5 10 10", "CELL_TYPES 2\n10 10"), {"3 cells have 2 cell types"}));
  CHECK(says(refusal_of("a.vtk", replaced(samples::vtk_5, "0 4 8", "0 9 8")), {"offsets of cell 0"}));
  CHECK(says(refusal_of("a.vtk", samples::vtk_binary.substr(0, 140)), {"line 5", "too early"}));
}

TEST_CASE("refuses broken VTK XML by line") {
  const auto told = [](const std::string& from, const std::string& to) {
    return refusal_of("a.vtu", replaced(samples::vtu, from, to));
  };
  CHECK(says(told("type=\"UnstructuredGrid\"", "type=\"PolyData\""), {"a.vtu: line 3", "PolyData"}));
  CHECK(says(told("NumberOfComponents=\"3\" format=\"ascii\"", "NumberOfComponents=\"3\" format=\"binary\""),
             {"line 12", "'Points'", "cut off"}));
  CHECK(says(told("NumberOfPoints=\"5\"", "NumberOfPoints=\"6\""), {"6 points announced, 5 given"}));
  CHECK(says(told("NumberOfPoints=\"5\"", "NumberOfPoints=\"99999999999999999999\""), {"line 5", "99999"}));
  CHECK(says(told("3 7 11", "3 7 12"), {"offsets of cell 2"}));
  CHECK(says(told("1 2 3 4<", "1 2 3 x<"), {"line 15", "'x'"}));
  CHECK(says(told("</Piece>", ""), {"Piece does not end"}));
  CHECK(says(refusal_of("a.vtu", "{}"), {"VTKFile"}));
}

TEST_CASE("refuses broken TetGen files by file and line") {
  const TemporaryFolder folder;
  const auto told = [&](const std::string& nodes, const std::string& tets) {
    folder.file("a.node", nodes);
    folder.file("a.ele", tets);
    return refusal([&] { read_tet_mesh(folder / "a.node"); });
  };
  CHECK(says(told(replaced(samples::node, "5 3 1 1", "5 2 1 1"), samples::ele), {"a.node: line 2", "'2'"}));
  CHECK(says(told(replaced(samples::node, "5 3 1 1", "6 3 1 1"), samples::ele), {"a.node", "ends where a node"}));
  CHECK(says(told(replaced(samples::node, "5 3 1 1", "4 3 1 1"), samples::ele), {"a.node: line 7", "go on after 4"}));
  CHECK(says(told(samples::node, replaced(samples::ele, "2 4 1", "2 10 1")), {"a.ele: line 1", "'10'"}));
  CHECK(says(told(samples::node, replaced(samples::ele, "2 3 4 5", "2 3 4 6")), {"a.ele: line 3", "node 6"}));
  CHECK(says(told(samples::node, replaced(samples::ele, "-3.0", "-3.5")), {"a.ele: line 3", "-3.5"}));
  folder.file("b.node", samples::node);
  CHECK(says(refusal([&] { read_tet_mesh(folder / "b.node"); }), {"b.ele", "no such file"}));
}

TEST_CASE("refuses files that are not there, folders, devices and unknown endings") {
  const TemporaryFolder folder;
  CHECK(says(refusal([&] { read_tet_mesh(folder / "none.msh"); }), {"none.msh", "no such file"}));
  std::filesystem::create_directory(folder / "folder.msh");
  CHECK(says(refusal([&] { read_tet_mesh(folder / "folder.msh"); }), {"folder.msh", "plain file"}));
  std::filesystem::create_symlink("/dev/zero", folder / "device.msh");
  CHECK(says(refusal([&] { read_tet_mesh(folder / "device.msh"); }), {"device.msh", "plain file"}));
  CHECK(says(refusal([&] { read_tet_mesh(folder / "a.step"); }), {"a.step", ".msh"}));
  CHECK_FALSE(is_tet_mesh_file("a.obj"));
  CHECK(is_tet_mesh_file("a.NODE"));
}

TEST_CASE("messages show binary garbage as printable text") {
  const std::string said = refusal_of("a.msh", std::string("\x01\x02\xff\0garbage", 12));
  CHECK_FALSE(said.empty());
  for (char c : said) CHECK((c >= ' ' && c <= '~'));
}

TEST_CASE("reads meshes made by others") {
  for (const auto& [name, nodes, tets] : {std::tuple{"liver2.msh", 507, 1493}, {"liver_small.mesh", 1227, 4283}}) {
    const auto path = shared_data(name);
    if (path.empty()) {
      MESSAGE("skipped: ", name, " is not here");
      continue;
    }
    TetMesh mesh = read_tet_mesh(path);
    const QualityReport report = check_tets(mesh);
    CHECK(report.nodes == nodes);
    CHECK(report.tets == tets);
    CHECK(report.components == 1);
  }
}

namespace {

/// Corners of a tetrahedron, then nodes beside the middles of its edges in the order of a format, all after a node of
/// no element.
std::vector<Vec3> ten_nodes(const std::array<std::array<std::size_t, 2>, 6>& edges) {
  std::vector<Vec3> nodes{{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const auto& [a, b] : edges) nodes.push_back((nodes[a + 1] + nodes[b + 1]) / 2 + Vec3(0.01, 0.02, -0.01));
  return nodes;
}
constexpr std::array<std::array<std::size_t, 2>, 6> gmsh_edges{{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {2, 3}, {1, 3}}};
constexpr std::array<std::array<std::size_t, 2>, 6> vtk_edges{{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};

std::string text_of(const std::vector<Vec3>& nodes, int first_number) {
  std::string text;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (first_number > 0) text += std::to_string(first_number + static_cast<int>(n)) + ' ';
    for (const double value : nodes[n]) text += std::to_string(value) + ' ';
    text += '\n';
  }
  return text;
}

/// The same element in each format that has ten-node tetrahedra.
std::vector<std::pair<std::string, std::string>> ten_node_files() {
  const std::vector<Vec3> gmsh = ten_nodes(gmsh_edges), vtk = ten_nodes(vtk_edges);
  std::string numbers, places;
  for (int n = 1; n <= 11; ++n) numbers += std::to_string(n) + "\n";
  for (const Vec3& X : gmsh) places += text_of({X}, 0);
  const std::string list = "1 2 3 4 5 6 7 8 9 10";
  return {
      {"a.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n11\n" + text_of(gmsh, 1) +
                    "$EndNodes\n$Elements\n1\n1 11 2 7 1 2 3 4 5 6 7 8 9 10 11\n$EndElements\n"},
      {"b.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 11 1 11\n3 1 0 11\n" + numbers + places +
                    "$EndNodes\n$Elements\n1 1 1 1\n3 1 11 1\n1 2 3 4 5 6 7 8 9 10 11\n$EndElements\n"},
      {"a.vtk", "# vtk DataFile Version 3.0\nten\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 11 double\n" +
                    text_of(vtk, 0) + "CELLS 1 11\n10 " + list + "\nCELL_TYPES 1\n24\n"},
      {"a.vtu",
       "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"11\" NumberOfCells=\"1\">"
       "<Points><DataArray NumberOfComponents=\"3\" format=\"ascii\">" +
           text_of(vtk, 0) + "</DataArray></Points><Cells><DataArray Name=\"connectivity\" format=\"ascii\">" + list +
           "</DataArray><DataArray Name=\"offsets\" format=\"ascii\">10</DataArray>"
           "<DataArray Name=\"types\" format=\"ascii\">24</DataArray></Cells></Piece></UnstructuredGrid>"
           "</VTKFile>"}};
}

}  // namespace

TEST_CASE("ten-node tetrahedra keep their mid-edge nodes, each on its edge in every format") {
  const TemporaryFolder folder;
  for (const auto& file : ten_node_files()) {
    const std::string &name = file.first, &text = file.second;
    CAPTURE(name);
    MidEdges midedges;
    TetMesh mesh = read_tet_mesh(folder.file(name, text), &midedges);
    REQUIRE(midedges.size() == 1);
    CHECK(mesh.nodes.size() == 11);
    for (const bool repaired : {false, true}) {  // of an element given inside out, too
      if (repaired) {
        std::swap(mesh.tets[0][0], mesh.tets[0][1]);
        std::swap(midedges[0][1], midedges[0][3]);
        std::swap(midedges[0][2], midedges[0][4]);
        CHECK(check_tets(mesh, &midedges).flipped == 1);
      }
      for (std::size_t e = 0; e < 6; ++e) {
        const auto X = [&](int n) { return mesh.nodes[static_cast<std::size_t>(n)]; };
        const Vec3 middle = (X(mesh.tets[0][tet_edges[e][0]]) + X(mesh.tets[0][tet_edges[e][1]])) / 2;
        CHECK((X(midedges[0][e]) - middle - Vec3(0.01, 0.02, -0.01)).norm() <= 1e-6);
      }
      CHECK(check_tets(mesh, &midedges).orphans == 1);
    }
  }
}

TEST_CASE("ten-node tetrahedra are linear ones for who takes no mid-edge nodes, with a word") {
  const TemporaryFolder folder;
  for (const auto& file : ten_node_files()) {
    const std::string &name = file.first, &text = file.second;
    CAPTURE(name);
    const WarningCollector warnings;
    const TetMesh mesh = read_tet_mesh(folder.file(name, text));
    CHECK(mesh.nodes.size() == 5);
    CHECK(mesh.tets == std::vector<Tet>{{1, 2, 3, 4}});
    REQUIRE(warnings.texts().size() == 1);
    CHECK(says(warnings.texts()[0], {"1 tetrahedra have ten nodes", "6 mid-edge nodes were left out"}));
  }
}

TEST_CASE("a mesh of tetrahedra of four and of ten nodes is linear") {
  const TemporaryFolder folder;
  std::string text = replaced(ten_node_files()[0].second, "$Elements\n1\n", "$Elements\n2\n2 4 2 7 1 6 3 4 5\n");
  MidEdges midedges(3);
  const WarningCollector warnings;
  const TetMesh mesh = read_tet_mesh(folder.file("a.msh", text), &midedges);
  CHECK(midedges.empty());
  CHECK(mesh.nodes.size() == 6);
  CHECK(mesh.tets == std::vector<Tet>{{5, 2, 3, 4}, {1, 2, 3, 4}});
  CHECK(says(warnings.texts().at(0), {"since 1 have four"}));
}

TEST_CASE("refuses ten-node tetrahedra with too few nodes") {
  CHECK(says(refusal_of("a.msh", replaced(ten_node_files()[0].second, " 9 10 11", " 9 10")), {"a.msh", "node number"}));
  CHECK(says(refusal_of("a.vtk", replaced(ten_node_files()[2].second, "\n24\n", "\n10\n")),
             {"a.vtk", "tetrahedron of 10 nodes"}));
}

}  // namespace heml::read_test
