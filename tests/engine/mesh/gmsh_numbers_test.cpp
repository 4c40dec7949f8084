// Binary .msh files.
#include <doctest/doctest.h>

#include <heml/mesh/readers.hpp>
#include <messages.hpp>

#include "engine/mesh/binary_samples.hpp"
#include "engine/mesh/files.hpp"

namespace heml::gmsh_numbers_test {

namespace {

std::string refusal_of(const std::string& text) {
  return refusal([&] { read_gmsh("a.msh", text); });
}

void check_mesh(const TetMesh& mesh) {
  CHECK(mesh.nodes == std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1.5}});
  CHECK(mesh.tets == std::vector<Tet>{{0, 1, 2, 3}, {1, 2, 3, 4}});
  CHECK(mesh.regions == std::vector<int>{7, -3});
  CHECK(mesh.region_names == std::map<int, std::string>{{7, "left lobe"}});
}

}  // namespace

TEST_CASE("reads binary Gmsh 4.1 of either byte order, with names and data") {
  for (const bool little_endian : {true, false}) {
    const TetMesh mesh = read_gmsh("a.msh", samples::gmsh_4_binary(little_endian)).mesh;
    check_mesh(mesh);
    REQUIRE(mesh.fields.size() == 1);
    CHECK(mesh.fields[0].name == "stiffness");
    CHECK(mesh.fields[0].values == std::vector<double>{2.5, 4});
  }
}

TEST_CASE("reads binary Gmsh 2.2") { check_mesh(read_gmsh("a.msh", samples::gmsh_2_binary()).mesh); }

TEST_CASE("a binary Gmsh file that is cut off before the end of its elements is refused by byte") {
  for (const std::string& whole : {samples::gmsh_4_binary(true), samples::gmsh_2_binary()}) {
    const std::size_t end = whole.find("$EndElements");
    for (std::size_t length = whole.find("$EndMeshFormat"); length < end; ++length) {
      const std::string told = refusal_of(whole.substr(0, length));
      CAPTURE(length);
      const bool between_sections = whole.substr(0, length).ends_with("\n") || told.empty();
      if (!between_sections) CHECK(told.find("a.msh: byte ") == 0);
    }
  }
}

TEST_CASE("counts and indices of binary Gmsh files are checked against the file") {
  const std::string good = samples::gmsh_4_binary(true);
  const std::string nodes = "$Nodes\n" + std::string(samples::Binary(true).integers<long long>({2, 5}));
  const std::string many = "$Nodes\n" + std::string(samples::Binary(true).integers<long long>({2, 1ll << 40}));
  CHECK(refusal_of(replaced(good, nodes, many)).find("1099511627776, more than") != std::string::npos);
  const std::string tet = samples::Binary(true).integers<long long>({3, 2, 3, 5, 6});
  const std::string other = samples::Binary(true).integers<long long>({3, 2, 3, 5, 99});
  CHECK(refusal_of(replaced(good, tet, other)).find("names node 99") != std::string::npos);
  const std::string block = samples::Binary(true).integers<int>({2, 1, 2});
  const std::string unknown = samples::Binary(true).integers<int>({2, 1, 140});
  CHECK(refusal_of(replaced(good, block, unknown)).find("type 140") != std::string::npos);
  const std::string one = samples::Binary(true).integers<int>({1});
  CHECK(refusal_of(replaced(good, "8\n" + one, "8\n" + std::string(4, 'x'))).find("the number 1") != std::string::npos);
}

}  // namespace heml::gmsh_numbers_test
