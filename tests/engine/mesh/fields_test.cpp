// Fields of elements in every format that supports them.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <heml/mesh/generate.hpp>
#include <heml/mesh/quality.hpp>
#include <heml/mesh/readers.hpp>
#include <limits>
#include <messages.hpp>

#include "engine/mesh/files.hpp"
#include "engine/mesh/samples.hpp"

namespace heml::fields_test {

namespace {

using Values = std::vector<double>;

std::vector<std::string> names_of(const TetMesh& mesh) {
  std::vector<std::string> names;
  for (const ElementField& field : mesh.fields) names.push_back(field.name);
  return names;
}

const Values& values(const TetMesh& mesh, const std::string& name, std::size_t components) {
  const ElementField* field = find_field(mesh, name);
  REQUIRE(field);
  CHECK(field->components == components);
  CHECK(field->values.size() == components * mesh.tets.size());
  return field->values;
}

}  // namespace

TEST_CASE("reads Gmsh element data of both versions: of tetrahedra, by their numbers, the first time step") {
  for (const std::string& text : {samples::gmsh_2_data, samples::gmsh_4_data}) {
    const ReadMesh read = read_gmsh("a.msh", text);
    CHECK(names_of(read.mesh) == std::vector<std::string>{"stiffness", "fibre direction"});
    CHECK(values(read.mesh, "stiffness", 1) == Values{2.5, 4});
    CHECK(values(read.mesh, "fibre direction", 3) == Values{1, 0, 0, 0, -0.6, 0.8});
    CHECK(read.more_steps);
  }
  CHECK_FALSE(read_gmsh("a.msh", samples::gmsh_2).more_steps);
}

TEST_CASE("reads Gmsh element data before the elements, in parts, and of some elements only") {
  const std::size_t elements = samples::gmsh_2.find("$Elements");
  const auto of = [&](int partition, const std::string& line) {
    return "$ElementData\n1\n\"E\"\n0\n4\n0\n1\n1\n" + std::to_string(partition) + "\n" + line + "\n$EndElementData\n";
  };
  const TetMesh whole =
      read_gmsh("a.msh", std::string(samples::gmsh_2).insert(elements, of(0, "4 -inf") + of(1, "2 3"))).mesh;
  CHECK(values(whole, "E", 1) == Values{3, -std::numeric_limits<double>::infinity()});
  const TetMesh some = read_gmsh("a.msh", samples::gmsh_2 + of(0, "4 5")).mesh;
  CHECK(std::isnan(values(some, "E", 1)[0]));
  CHECK(values(some, "E", 1)[1] == 5);
}

TEST_CASE("gives Gmsh tetrahedra of one number the same data, the last, however many there are of both") {
  constexpr int count = 300'000;  // copying per value would take 9e10 copies
  std::string tets = fmt::format("$Elements\n{}\n", count);
  std::string data = fmt::format("$ElementData\n1\nE\n0\n3\n0 1 {}\n", count);
  for (int i = 0; i < count; ++i) {
    tets += "1 4 0 40 20 21 33\n";
    data += fmt::format("1 {}\n", i);
  }
  const std::string nodes = samples::gmsh_2.substr(0, samples::gmsh_2.find("$Elements"));
  const TetMesh mesh = read_gmsh("a.msh", nodes + tets + "$EndElements\n" + data + "$EndElementData\n").mesh;
  CHECK(values(mesh, "E", 1) == Values(count, count - 1));
}

TEST_CASE("reads legacy VTK cell arrays: scalars, vectors and field arrays, in text and binary") {
  const TetMesh text = read_vtk("a.vtk", samples::vtk).mesh;
  CHECK(names_of(text) == std::vector<std::string>{"quality", "fibre direction", "stiffness"});
  CHECK(values(text, "quality", 1) == Values{1, 0.5});
  CHECK(values(text, "fibre direction", 3) == Values{1, 0, 0, 0, -0.6, 0.8});
  CHECK(values(text, "stiffness", 1) == Values{2.5, 4});
  const TetMesh binary = read_vtk("a.vtk", samples::vtk_5_binary).mesh;
  CHECK(names_of(binary) == std::vector<std::string>{"heat", "fibre direction", "count"});
  CHECK(values(binary, "heat", 1) == Values{1, 2});
  CHECK(values(binary, "fibre direction", 3) == Values{1, 0, 0, 0, -0.5, 0.75});
  CHECK(values(binary, "count", 1) == Values{200, 3});
}

TEST_CASE("of two legacy VTK arrays of one name the last counts") {
  const std::string again = samples::vtk + "SCALARS quality double\nLOOKUP_TABLE default\n7 8 9\n";
  CHECK(values(read_vtk("a.vtk", again).mesh, "quality", 1) == Values{8, 9});
}

TEST_CASE("reads VTK XML cell arrays in text and passes others over") {
  const TetMesh mesh = read_vtu("a.vtu", samples::vtu).mesh;
  CHECK(names_of(mesh) == std::vector<std::string>{"stiffness", "fibre direction", "a <\"&'> b"});
  CHECK(values(mesh, "stiffness", 1) == Values{2.5, 4});
  CHECK(values(mesh, "fibre direction", 3) == Values{1, 0, 0, 0, -0.6, 0.8});
  CHECK(values(mesh, "a <\"&'> b", 1) == Values{2, 3});
}

TEST_CASE("joins VTK XML fields over pieces, a piece without one has no numbers there") {
  const std::size_t begin = samples::vtu.find("<Piece"), end = samples::vtu.find("</Piece>") + 8;
  const std::string piece = samples::vtu.substr(begin, end - begin);
  const std::string other = replaced(replaced(piece, "stiffness", "softness"), "nan 2.5 4", "0 1 2");
  const TetMesh mesh = read_vtu("a.vtu", replaced(samples::vtu, piece, piece + other)).mesh;
  CHECK(values(mesh, "fibre direction", 3) == Values{1, 0, 0, 0, -0.6, 0.8, 1, 0, 0, 0, -0.6, 0.8});
  const Values stiff = values(mesh, "stiffness", 1), soft = values(mesh, "softness", 1);
  CHECK(stiff[1] == 4);
  CHECK(std::isnan(stiff[2]));
  CHECK(std::isnan(soft[1]));
  CHECK(soft[3] == 2);
}

TEST_CASE("reads TetGen attributes after the first as fields without names of their own") {
  const TetMesh mesh = read_tetgen("a.node", samples::node, "a.ele", samples::ele_attributes).mesh;
  CHECK(mesh.regions == std::vector<int>{7, -3});
  CHECK(names_of(mesh) == std::vector<std::string>{"attribute1", "attribute2"});
  CHECK(values(mesh, "attribute1", 1) == Values{2.5, 4});
  CHECK(values(mesh, "attribute2", 1) == Values{-1, std::numeric_limits<double>::infinity()});
}

TEST_CASE("reads every integer of 32 bits as a TetGen region, and refuses what is none") {
  const auto with_regions = [](const std::string& one, const std::string& other) {
    const std::string text = replaced(replaced(samples::ele, " 7", " " + one), "-3.0", other);
    return read_tetgen("a.node", samples::node, "a.ele", text).mesh.regions;
  };
  CHECK(with_regions("2147483647", "-2147483648") == std::vector<int>{2147483647, -2147483647 - 1});
  for (const char* region : {"2147483648", "-2147483649", "1.5", "nan"})
    CHECK(says(refusal([&] { with_regions(region, "1"); }), {"a.ele: line 2"}));
}

TEST_CASE("refuses broken fields by line") {
  const auto gmsh = [](const std::string& from, const std::string& to) {
    return refusal([&] { read_gmsh("a.msh", replaced(samples::gmsh_2_data, from, to)); });
  };
  CHECK(says(gmsh("2 2.5", "2 2.5 1"), {"a.msh: line 34", "goes on after the element's data"}));
  CHECK(says(gmsh("2 2.5", "2"), {"line 34", "ends where a value"}));
  CHECK(says(gmsh("2 2.5", "2 soft"), {"line 34", "'soft'"}));
  CHECK(says(gmsh("3\n0\n1\n3\n", "2\n0\n1\n3\n"), {"line 29", "2 integer tags"}));
  CHECK(says(gmsh("3\n0\n1\n3\n", "3\n0\n1\n999999\n"), {"line 32", "999999"}));
  CHECK(says(gmsh("3\n0\n1\n3\n", "3\n0\n1\n4\n"), {"line 36", "'$EndElementData'"}));
  const auto vtk = [](const std::string& from, const std::string& to) {
    return refusal([&] { read_vtk("a.vtk", replaced(samples::vtk, from, to)); });
  };
  CHECK(says(vtk("nan 2.5 4", "nan 2.5 soft"), {"a.vtk: line", "'soft'"}));
  CHECK(says(vtk("other 2 3 int\n1 2 3 4 5 6", "other 1 2 int\n1 2"), {"3 cells have 2 values of 'other'"}));
  CHECK(says(vtk("other 2 3 int", "other 1 600000000 int"), {"600000000 values should follow"}));
  const auto vtu = [](const std::string& from, const std::string& to) {
    return refusal([&] { read_vtu("a.vtu", replaced(samples::vtu, from, to)); });
  };
  CHECK(says(vtu("nan 2.5 4", "nan 2.5"), {"3 cells have 2 values of 'stiffness'", "1 a cell"}));
  CHECK(says(vtu("7 7 7 1", "7 7 1"), {"3 cells have 8 values of 'fibre direction'", "3 a cell"}));
  const auto tetgen = [](const std::string& text) {
    return refusal([&] { read_tetgen("a.node", samples::node, "a.ele", text); });
  };
  CHECK(says(tetgen(replaced(samples::ele_attributes, " 4 inf", " 4")), {"a.ele: line 3", "ends where an attribute"}));
  CHECK(says(tetgen(replaced(samples::ele_attributes, "2.5", "x")), {"a.ele: line 2", "'x'"}));
}

TEST_CASE("refuses fields that change their components from piece to piece") {
  const std::string other = "$ElementData\n1\n\"stiffness\"\n0\n3\n0\n3\n1\n2 1 2 3\n$EndElementData\n";
  CHECK(says(refusal([&] { read_gmsh("a.msh", samples::gmsh_2_data + other); }),
             {"'stiffness' has 3 components here and 1 before"}));
}

TEST_CASE("refuses many fields that say next to nothing, before memory runs out") {
  std::string nodes = samples::gmsh_2.substr(0, samples::gmsh_2.find("$Elements")), tets, data;
  for (int t = 1; t <= 20000; ++t) tets += fmt::format("{} 4 2 7 1 40 20 21 33\n", t);
  for (int f = 0; f < 900; ++f)
    data += fmt::format("$ElementData\n1\n\"f{}\"\n0\n3\n0\n3\n1\n2 1 2 3\n$EndElementData\n", f);
  const std::string text = nodes + "$Elements\n20000\n" + tets + "$EndElements\n" + data;
  CHECK(says(refusal([&] { read_gmsh("a.msh", text); }), {"900 fields leave most of the 20000 tetrahedra"}));
  for (int f = 900; f < 1100; ++f)
    data += fmt::format("$ElementData\n1\n\"f{}\"\n0\n3\n0\n1\n1\n2 1\n$EndElementData\n", f);
  CHECK(says(refusal([&] { read_gmsh("a.msh", samples::gmsh_2 + data); }), {"more than 1000 fields"}));
}

TEST_CASE("refuses a mesh whose fields do not fit its tetrahedra") {
  TetMesh mesh = make_box(Vec3(1, 1, 1), {1, 1, 1});
  mesh.fields = {{"E", 1, {1, 2, 3}}};
  CHECK(says(refusal([&] { check_tets(mesh); }), {"field 'E'", "3 values of 1 components for 5 tetrahedra"}));
}

}  // namespace heml::fields_test
