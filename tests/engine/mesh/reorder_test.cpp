#include <doctest/doctest.h>

#include <algorithm>
#include <heml/mesh/generate.hpp>
#include <heml/mesh/reorder.hpp>
#include <numeric>
#include <random>

namespace heml::reorder_test {

namespace {
// A box with nodes and tetrahedra in random order, and an orphan node first. Shuffles by hand, since std::shuffle
// differs between standard libraries.
TetMesh shuffled_box(int cells, unsigned seed) {
  const TetMesh box = make_box(Vec3(1, 1, 1), {cells, cells, cells});
  std::mt19937 random(seed);
  const auto shuffled = [&](std::size_t count) {
    std::vector<int> order(count);
    std::iota(order.begin(), order.end(), 0);
    for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random() % i]);
    return order;
  };
  const std::vector<int> nodes = shuffled(box.nodes.size()), tets = shuffled(box.tets.size());
  TetMesh mesh;
  mesh.nodes.resize(box.nodes.size() + 1, Vec3(9, 9, 9));
  for (std::size_t n = 0; n < nodes.size(); ++n) mesh.nodes[nodes[n] + 1] = box.nodes[n];
  for (int t : tets) {
    Tet tet = box.tets[t];
    for (int& node : tet) node = nodes[node] + 1;
    mesh.tets.push_back(tet);
    mesh.regions.push_back(t);
  }
  return mesh;
}

// Mean range of the node numbers of a tetrahedron.
double mean_span(const TetMesh& mesh) {
  double sum = 0;
  for (const Tet& tet : mesh.tets) {
    const auto [least, most] = std::minmax_element(tet.begin(), tet.end());
    sum += *most - *least;
  }
  return sum / static_cast<double>(mesh.tets.size());
}
}  // namespace

TEST_CASE("reordering is a permutation and its inverse") {
  const TetMesh mesh = shuffled_box(6, 1);
  const Reordering order = hilbert_order(mesh);
  REQUIRE(order.new_node.size() == mesh.nodes.size());
  REQUIRE(order.file_tet.size() == mesh.tets.size());
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) CHECK(order.file_node[order.new_node[n]] == static_cast<int>(n));
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) CHECK(order.file_tet[order.new_tet[t]] == static_cast<int>(t));
}

TEST_CASE("a reordered mesh is the same body: positions, corners in order, regions") {
  const TetMesh mesh = shuffled_box(4, 2);
  const Reordering order = hilbert_order(mesh);
  const TetMesh inner = reordered(mesh, order);
  REQUIRE(inner.nodes.size() == mesh.nodes.size());
  REQUIRE(inner.tets.size() == mesh.tets.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const int at = order.new_tet[t];
    CHECK(inner.regions[at] == mesh.regions[t]);
    for (int a = 0; a < 4; ++a) CHECK(inner.nodes[inner.tets[at][a]] == mesh.nodes[mesh.tets[t][a]]);
  }
}

TEST_CASE("a reordered mesh carries its fields along") {
  TetMesh mesh = shuffled_box(4, 6);
  mesh.fields = {{"region", 1, {}}, {"centre", 3, {}}};
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    mesh.fields[0].values.push_back(mesh.regions[t]);
    Vec3 sum = Vec3::Zero();
    for (int node : mesh.tets[t]) sum += mesh.nodes[node];
    mesh.fields[1].values.insert(mesh.fields[1].values.end(), sum.begin(), sum.end());
  }
  const TetMesh inner = reordered(mesh, hilbert_order(mesh));
  REQUIRE(inner.fields.size() == 2);
  CHECK(inner.fields[1].name == "centre");
  REQUIRE(inner.fields[1].values.size() == 3 * mesh.tets.size());
  for (std::size_t t = 0; t < inner.tets.size(); ++t) {
    CHECK(inner.fields[0].values[t] == inner.regions[t]);
    Vec3 sum = Vec3::Zero();
    for (int node : inner.tets[t]) sum += inner.nodes[node];
    for (int i = 0; i < 3; ++i) CHECK(inner.fields[1].values[3 * t + static_cast<std::size_t>(i)] == sum[i]);
  }
}

TEST_CASE("nodes of no element come last") {
  const TetMesh mesh = shuffled_box(3, 3);
  const Reordering order = hilbert_order(mesh);
  CHECK(order.new_node[0] == static_cast<int>(mesh.nodes.size()) - 1);
}

TEST_CASE("neighbours along the space-filling curve are neighbours in space") {
  const TetMesh mesh = shuffled_box(16, 4);
  const TetMesh inner = reordered(mesh, hilbert_order(mesh));
  // In random order a tetrahedron spans 3/5 of all nodes on average; along a space-filling curve a small part.
  CHECK(mean_span(mesh) > 0.5 * static_cast<double>(mesh.nodes.size()));
  CHECK(mean_span(inner) < 0.1 * static_cast<double>(mesh.nodes.size()));
}

TEST_CASE("on a grid of 8 cells a side the curve steps from each node to a neighbour") {
  // Nodes at the cell centres of an 8×8×8 grid, between which a Hilbert curve makes unit steps only.
  TetMesh mesh;
  for (int i = 0; i < 512; ++i) mesh.nodes.emplace_back(i % 8, i / 8 % 8, i / 64);
  for (int i = 0; i + 3 < 512; i += 4) mesh.tets.push_back({i, i + 1, i + 2, i + 3});
  mesh.regions.assign(mesh.tets.size(), 0);
  const Reordering order = hilbert_order(mesh);
  for (int i = 1; i < 512; ++i)
    CHECK((mesh.nodes[order.file_node[i]] - mesh.nodes[order.file_node[i - 1]]).norm() == doctest::Approx(1));
}

TEST_CASE("the order depends on the mesh alone and survives a mesh of nothing") {
  const TetMesh mesh = shuffled_box(5, 5);
  CHECK(hilbert_order(mesh).file_node == hilbert_order(mesh).file_node);
  CHECK(hilbert_order(TetMesh{}).file_node.empty());
}

}  // namespace heml::reorder_test
