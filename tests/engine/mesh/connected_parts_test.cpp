#include <doctest/doctest.h>

#include <heml/mesh/connected_parts.hpp>
#include <heml/mesh/generate.hpp>
#include <set>

#include "support.hpp"

namespace heml::connected_parts_test {

using namespace heml::test;

TEST_CASE("parts that share no node have a node of theirs each, mid-edge nodes are of them, and others stand alone") {
  TetMesh mesh = make_box(Vec3::Ones(), {2, 1, 1});
  const std::size_t first = mesh.nodes.size();
  const TetMesh other = make_box(Vec3::Ones(), {1, 1, 1});
  for (const Vec3& X : other.nodes) mesh.nodes.push_back(X + Vec3(3, 0, 0));
  for (Tet tet : other.tets) {
    for (int& n : tet) n += static_cast<int>(first);
    mesh.tets.push_back(tet);
    mesh.regions.push_back(0);
  }
  const std::size_t second = mesh.nodes.size();
  const MidEdges midedges = add_midedge_nodes(mesh);
  const std::size_t lonely = mesh.nodes.size();
  mesh.nodes.push_back(Vec3::Zero());
  const std::vector<int> part = connected_parts(mesh, midedges);
  REQUIRE(part.size() == mesh.nodes.size());
  CHECK(std::set<int>(part.begin(), part.end()).size() == 3);
  for (std::size_t n = 0; n < second; ++n) CHECK(part[n] == part[n < first ? 0 : first]);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    for (const int n : midedges[t])
      CHECK(part[static_cast<std::size_t>(n)] == part[static_cast<std::size_t>(mesh.tets[t][0])]);
  CHECK(part[lonely] == static_cast<int>(lonely));
  CHECK(static_cast<std::size_t>(part[first]) < lonely);
}

}  // namespace heml::connected_parts_test
