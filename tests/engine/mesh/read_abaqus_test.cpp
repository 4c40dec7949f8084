#include <doctest/doctest.h>

#include <heml/mesh/readers.hpp>
#include <messages.hpp>

#include "engine/mesh/binary_samples.hpp"
#include "engine/mesh/files.hpp"

namespace heml::read_abaqus_test {

namespace {

using Names = std::map<int, std::string>;

std::string refusal_of(const std::string& text) {
  return refusal([&] { read_abaqus("a.inp", text); });
}

}  // namespace

TEST_CASE("reads Abaqus elements and nodes in any order, left out coordinates, and sets as regions") {
  const TetMesh mesh = read_abaqus("a.inp", samples::abaqus).mesh;
  CHECK(mesh.nodes == std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1.5}});
  CHECK(mesh.tets == std::vector<Tet>{{0, 1, 2, 3}, {1, 2, 3, 4}});
  CHECK(mesh.regions == std::vector<int>{1, 2});
  CHECK(mesh.region_names == Names{{1, "left lobe"}, {2, "right"}});
}

TEST_CASE("reads elements of ten nodes that go on in the next line") {
  std::string text = "*NODE\n";
  for (int n = 1; n <= 10; ++n) text += std::to_string(n) + ", " + std::to_string(n) + "\n";
  const ReadMesh read = read_abaqus("a.inp", text + "*ELEMENT, TYPE=C3D10\n1, 1, 2, 3, 4,\n 5, 6, 7,\n8, 9, 10\n");
  CHECK(read.mesh.tets == std::vector<Tet>{{0, 1, 2, 3}});
  REQUIRE(read.midedges.size() == 1);
  // tet_edges are 01 02 03 12 13 23, the file's middles those of 01 12 20 03 13 23.
  CHECK(read.midedges[0] == std::array{4, 6, 7, 5, 8, 9});
}

TEST_CASE("sets that sections name are the regions, others are not") {
  const TetMesh mesh = read_abaqus("a.inp", samples::abaqus + "*Solid Section, elset=BOTH, material=x\n").mesh;
  CHECK(mesh.regions == std::vector<int>{1, 1});
  CHECK(mesh.region_names == Names{{1, "both"}});
}

TEST_CASE("reads one part in an assembly and passes over the assembly's own nodes") {
  const std::string text = "*Part, name=p\n" + replaced(samples::abaqus, "*HEADING", "** ") +
                           "*End Part\n*Assembly, name=a\n*Instance, name=p-1, part=p\n1, 2, 3\n*End Instance\n"
                           "*Node\n10, 5, 5, 5\n*Elset, elset=picked, instance=p-1\n7\n*End Assembly\n";
  const TetMesh mesh = read_abaqus("a.inp", replaced(text, "two tetrahedra, 1\n", "")).mesh;
  CHECK(mesh.nodes.size() == 5);
  CHECK(mesh.tets.size() == 2);
  CHECK(says(refusal_of(samples::abaqus + "*PART, NAME=b\n*END PART\n*PART, NAME=c\n"),
              {"a.inp: line 26", "second PART", "one part alone"}));
}

TEST_CASE("counts other solids") {
  const std::string text = samples::abaqus + "*ELEMENT, TYPE=C3D7\n30, 10, 20, 30, 40,\n 10, 20, 30\n";
  CHECK(read_abaqus("a.inp", text).ignored == 1);
}

TEST_CASE("refuses what an Abaqus file cannot say, by line, with a remedy") {
  const auto told = [](const std::string& from, const std::string& to) {
    return refusal_of(replaced(samples::abaqus, from, to));
  };
  CHECK(says(told("*STEP", "*INCLUDE, INPUT=mesh.inp"), {"a.inp: line 22", "'mesh.inp'", "put its lines here"}));
  CHECK(says(told("12, 20, 30, 40, 55", "12, 20, 30, 40, 56"), {"line 9", "node 56"}));
  CHECK(says(told("12, 20, 30, 40, 55", "12, 20, 30, 40"), {"line 10", "element 12 has 3 nodes", "4"}));
  CHECK(says(told("12, 20, 30, 40, 55", "12, 20, 30, 40, 55, 10"), {"line 9", "more than 4"}));
  CHECK(says(told("12, 20, 30, 40, 55", "12, 20, 30, 40, x"), {"line 9", "'x'", "whole number"}));
  CHECK(says(told("30, , 1.e+0", "30, , one"), {"line 13", "'one'"}));
  CHECK(says(told("30, , 1.e+0", "30, , nan"), {"line 13", "'nan'"}));
  CHECK(says(told("55, 1, 1, 1.5", "40, 1, 1, 1.5"), {"node number 40", "twice"}));
  CHECK(says(told("7, 12, 5", "7, 12, 0"), {"line 17", "step is 0"}));
  CHECK(says(told("12,\n", "middle\n"), {"line 19", "'middle'", "not given before"}));
  CHECK(says(refusal_of("5 2 0 0 0\n1 0 0 0\n"), {"line 1", "keyword", "*NODE"}));
}

}  // namespace heml::read_abaqus_test
