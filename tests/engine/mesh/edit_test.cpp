#include <doctest/doctest.h>

#include <heml/mesh/edit.hpp>
#include <heml/mesh/generate.hpp>
#include <messages.hpp>

namespace heml::edit_test {

namespace {

TetMesh block() {
  TetMesh mesh = make_box(Vec3(0.4, 0.1, 0.1), {4, 1, 1});  // 20 elements
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) mesh.regions[t] = t < 5 ? 3 : 8;
  return mesh;
}

ElementSelection tets(std::vector<int> numbers) { return {std::move(numbers), {}, {}, {}}; }

/// The message of a removal; "" if it is valid.
std::string problem_of(const ElementSelection& which, const Topology& topology) {
  MeshEdit edit;
  return make_removal_edit(which, block(), topology, edit).message();
}

}  // namespace

TEST_CASE("an edit leaves the numbers of what stays") {
  const TetMesh mesh = block();
  const Topology all = full_topology(mesh);
  CHECK(all.elements.size() == 20);
  CHECK(all.version == 0);
  MeshEdit edit;
  REQUIRE(make_removal_edit(tets({7, 2, 2, 19}), mesh, all, edit).ok());
  CHECK(edit.removed == std::vector<int>{2, 7, 19});
  const Topology rest = apply_edit(all, edit, 20);
  CHECK(rest.version == 1);
  CHECK(rest.elements == std::vector<int>{0, 1, 3, 4, 5, 6, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18});
  const TetMesh left = with_elements(mesh, rest.elements);
  CHECK(left.nodes.size() == mesh.nodes.size());
  CHECK(left.tets[2] == mesh.tets[3]);
  CHECK(left.regions.back() == 8);
}

TEST_CASE("elements are chosen by region, and by box or sphere of their centroids, of those that are there") {
  const TetMesh mesh = block();
  Topology topology = full_topology(mesh);
  MeshEdit edit;
  REQUIRE(make_removal_edit({{}, 3, {}, {}}, mesh, topology, edit).ok());
  CHECK(edit.removed == std::vector<int>{0, 1, 2, 3, 4});
  REQUIRE(make_removal_edit({{}, {}, std::array{Vec3(0.3, -1, -1), Vec3(1, 1, 1)}, {}}, mesh, topology, edit).ok());
  CHECK(edit.removed == std::vector<int>{15, 16, 17, 18, 19});
  topology = apply_edit(topology, edit, 20);
  REQUIRE(make_removal_edit({{}, {}, std::array{Vec3(0.2, -1, -1), Vec3(1, 1, 1)}, {}}, mesh, topology, edit).ok());
  CHECK(edit.removed == std::vector<int>{10, 11, 12, 13, 14});
  REQUIRE(make_removal_edit({{}, {}, {}, std::pair{Vec3(0.05, 0.05, 0.05), 0.06}}, mesh, topology, edit).ok());
  CHECK(edit.removed == std::vector<int>{0, 1, 2, 3, 4});
}

TEST_CASE("a removal that makes no sense is refused in words") {
  Topology topology = apply_edit(full_topology(block()), {{5, 6}, {}, {}, {}}, 20);
  CHECK(problem_of(tets({20}), topology) == "element 20 does not exist; the mesh has elements 0 to 19");
  CHECK(says(problem_of(tets({3, -1}), topology), "element -1 does not exist"));
  CHECK(problem_of(tets({4, 5}), topology) == "element 5 was removed before");
  CHECK(says(problem_of(tets({}), topology), "names no element"));
  CHECK(problem_of({{}, 9, {}, {}}, topology) == "no element of region 9 is there; the regions that are: 3, 8");
  CHECK(says(problem_of({{}, {}, std::array{Vec3(1, 1, 1), Vec3(2, 2, 2)}, {}}, topology),
             "the box holds no centroid of an element; at rest they lie from ["));
  CHECK(says(problem_of({{}, {}, {}, std::pair{Vec3(0, 0, 0), 1e-6}}, topology), "the sphere holds no centroid"));
  CHECK(says(problem_of({{}, {}, {}, std::pair{Vec3(0, 0, 0), 9.0}}, topology),
             "all 18 elements that are left would go"));
  CHECK(problem_of(tets({4, 4}), topology).empty());
}

}  // namespace heml::edit_test
