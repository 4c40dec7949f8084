#include <doctest/doctest.h>

#include <heml/mesh/generate.hpp>
#include <heml/mesh/region_tag.hpp>
#include <limits>
#include <messages.hpp>

namespace heml::region_tag_test {

namespace {

/// Two cells of 5 elements: regions 3 and 8, the first named.
TetMesh block() {
  TetMesh mesh = make_box(Vec3(0.2, 0.1, 0.1), {2, 1, 1});
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) mesh.regions[t] = t < 5 ? 3 : 8;
  mesh.region_names = {{3, "stem"}};
  return mesh;
}

RegionTag tag(std::vector<int> tets, std::string name, std::optional<int> number = {}) {
  return {{}, {std::move(tets), {}, {}, {}}, std::move(name), number};
}

std::string problem_of(const RegionTag& tag, const TetMesh& mesh = block()) {
  TaggedRegion region;
  return resolve_region(tag, mesh, full_topology(mesh), region).message();
}

TaggedRegion resolved(const RegionTag& tag, const TetMesh& mesh = block()) {
  TaggedRegion region;
  const Status status = resolve_region(tag, mesh, full_topology(mesh), region);
  REQUIRE_MESSAGE(status.ok(), status.message());
  return region;
}

}  // namespace

TEST_CASE("a region of nodes has the elements whose corners are all among them") {
  const TetMesh mesh = block();
  std::vector<int> left;  // the cell 0 ≤ x ≤ 0.1: its elements have no other corners
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    if (mesh.nodes[n].x() < 0.11) left.push_back(static_cast<int>(n));
  CHECK(resolved({left, {}, "half", {}}).tets == std::vector{0, 1, 2, 3, 4});
  left.pop_back();
  const std::vector<int> fewer = resolved({left, {}, "half", {}}).tets;
  CHECK(!fewer.empty());
  CHECK(fewer.size() < 5);
  const Tet& tet = mesh.tets[7];
  CHECK(resolved({{tet[3], tet[0], tet[2], tet[1]}, {}, "one", {}}).tets == std::vector{7});
}

TEST_CASE("a name means its region, a new one a number above all others") {
  CHECK(resolved(tag({8}, "stem")).number == 3);
  CHECK(resolved(tag({8}, "lesion")).number == 9);
  CHECK(resolved(tag({8}, "lesion", -4)).number == -4);
  CHECK(resolved(tag({8}, "crown", 8)).number == 8);
  TetMesh mesh = block();
  tag_region(resolved(tag({8, 2, 8}, "lesion"), mesh), mesh);
  CHECK(mesh.regions == std::vector{3, 3, 9, 3, 3, 8, 8, 8, 9, 8});
  CHECK(mesh.region_names == std::map<int, std::string>{{3, "stem"}, {9, "lesion"}});
  CHECK(resolved(tag({0}, "lesion"), mesh).number == 9);
  CHECK(resolved(tag({0}, "other"), mesh).number == 10);
}

TEST_CASE("a region of nothing, of what is not there, or of a name that clashes is refused") {
  CHECK(says(problem_of({{0, 1}, {}, "x", {}}), "no element has all its corners among the 2 nodes"));
  CHECK(says(problem_of({{0, 99}, {}, "x", {}}), "node 99 does not exist; the body has nodes 0 to 11"));
  CHECK(says(problem_of(tag({10}, "x")), "element 10 does not exist"));
  CHECK(says(problem_of(tag({1}, "")), "name is empty"));
  CHECK(says(problem_of(tag({1}, "a\nb")), "line end"));
  CHECK(says(problem_of(tag({1}, "crown", 3)), "region 3 is named 'stem', not 'crown'"));
  CHECK(says(problem_of(tag({1}, "stem", 8)), "'stem' is the name of region 3, not of 8"));
  TetMesh twice = block();
  twice.region_names[8] = "stem";
  CHECK(says(problem_of(tag({1}, "stem"), twice), "regions 3 and 8 are both named 'stem'"));
  CHECK(problem_of(tag({1}, "stem", 8), twice).empty());
  TetMesh full = block();
  full.regions[0] = std::numeric_limits<int>::max();
  CHECK(says(problem_of(tag({1}, "x"), full), "no number is left"));
}

}  // namespace heml::region_tag_test
