#include <doctest/doctest.h>

#include <algorithm>
#include <heml/dynamics/nested_dissection.hpp>
#include <heml/dynamics/supernodes.hpp>
#include <heml/mesh/generate.hpp>
#include <numeric>
#include <random>
#include <set>

#include "support.hpp"

namespace heml::nested_dissection_test {

using namespace heml::test;

namespace {

NodeGraph graph_of(std::size_t count, const std::vector<Tet>& tets) {
  std::vector<std::set<int>> lists(count);
  for (const Tet& tet : tets)
    for (const int a : tet)
      for (const int b : tet)
        if (a != b) lists[static_cast<std::size_t>(a)].insert(b);
  NodeGraph graph;
  for (const auto& list : lists) {
    graph.neighbour.insert(graph.neighbour.end(), list.begin(), list.end());
    graph.start.push_back(static_cast<int>(graph.neighbour.size()));
  }
  return graph;
}

bool is_permutation_of(std::vector<int> order, std::size_t count) {
  std::vector<int> all(count);
  std::iota(all.begin(), all.end(), 0);
  std::sort(order.begin(), order.end());
  return order == all;
}

/// The later neighbours of every node, by elimination one node after another.
std::vector<std::set<int>> eliminated(const NodeGraph& graph, const std::vector<int>& order) {
  std::vector<int> place(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) place[static_cast<std::size_t>(order[k])] = static_cast<int>(k);
  std::vector<std::set<int>> later(order.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    for (const int n : graph.neighbours(order[k]))
      if (place[static_cast<std::size_t>(n)] > static_cast<int>(k)) later[k].insert(place[static_cast<std::size_t>(n)]);
  for (std::size_t k = 0; k < order.size(); ++k)
    if (!later[k].empty()) {
      const int parent = *later[k].begin();
      for (const int r : later[k])
        if (r != parent) later[static_cast<std::size_t>(parent)].insert(r);
    }
  return later;
}

}  // namespace

TEST_CASE("an order has every node once, whatever the graph and the positions") {
  std::mt19937_64 engine(1);
  for (const std::size_t count : {0, 1, 2, 500, 2500})
    for (const int pairs : {0, 1, 3, 10})
      for (const bool alike : {false, true}) {
        std::vector<Vec3> position(count, Vec3::Zero());
        std::vector<Tet> coupled;
        for (Vec3& x : position)
          if (!alike) x = random_vector(engine, 1);
        for (std::size_t e = 0; count > 0 && e < count * static_cast<std::size_t>(pairs); ++e) {
          const int a = static_cast<int>(engine() % count), b = static_cast<int>(engine() % count);
          coupled.push_back({a, b, a, b});
        }
        const NodeGraph graph = graph_of(count, coupled);
        const std::vector<int> order = nested_dissection(graph, position);
        CHECK(is_permutation_of(order, count));
        CHECK(is_permutation_of(minimum_degree(graph), count));
        CHECK(is_permutation_of(Supernodes(graph, order).order, count));
      }
}

TEST_CASE("a cube takes a small part of the work that the order of its nodes would take") {
  const TetMesh mesh = make_box(Vec3(1, 1, 1), {16, 16, 16});
  const NodeGraph graph = graph_of(mesh.nodes.size(), mesh.tets);
  std::vector<int> plain(mesh.nodes.size());
  std::iota(plain.begin(), plain.end(), 0);
  const double dissected = Supernodes(graph, nested_dissection(graph, mesh.nodes)).work();
  CHECK(dissected < 0.35 * Supernodes(graph, plain).work());
  // Planes that do not follow the mesh are found by the edges they cut.
  std::vector<Vec3> turned;
  for (const Vec3& x : mesh.nodes) turned.push_back(Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized()) * x);
  CHECK(Supernodes(graph, nested_dissection(graph, turned)).work() < 1.6 * dissected);
}

TEST_CASE("minimum degree goes through a long body from its ends") {
  const TetMesh mesh = make_box(Vec3(20, 1, 1), {100, 5, 5});
  const NodeGraph graph = graph_of(mesh.nodes.size(), mesh.tets);
  const double by_degree = Supernodes(graph, minimum_degree(graph)).work();
  CHECK(by_degree < 0.6 * Supernodes(graph, nested_dissection(graph, mesh.nodes)).work());
}

TEST_CASE("supernodes hold all entries that elimination makes, and few zeros") {
  const TetMesh mesh = make_box(Vec3(2, 1, 1), {10, 5, 5});
  const NodeGraph graph = graph_of(mesh.nodes.size(), mesh.tets);
  const Supernodes supernodes(graph, nested_dissection(graph, mesh.nodes));
  const auto needed = eliminated(graph, supernodes.order);
  double stored = 0, used = 0;
  for (std::size_t s = 0; s < supernodes.size(); ++s) {
    const auto rows = supernodes.rows(s);
    CHECK(std::is_sorted(rows.begin(), rows.end()));
    const int last = supernodes.first[s + 1];
    for (int k = supernodes.first[s]; k < last; ++k) {
      for (const int r : needed[static_cast<std::size_t>(k)])
        CHECK((r < last || std::binary_search(rows.begin(), rows.end(), r)));
      stored += last - k + static_cast<double>(rows.size());
      used += 1 + static_cast<double>(needed[static_cast<std::size_t>(k)].size());
    }
    // What is left of the rows is in the front of the parent.
    if (supernodes.parent[s] < 0) {
      CHECK(rows.empty());
      continue;
    }
    const auto parent = static_cast<std::size_t>(supernodes.parent[s]);
    CHECK(parent > s);
    const auto above = supernodes.rows(parent);
    for (const int r : rows) {
      CHECK(r >= supernodes.first[parent]);
      CHECK((r < supernodes.first[parent + 1] || std::binary_search(above.begin(), above.end(), r)));
    }
  }
  CHECK(stored < 1.4 * used);
}

}  // namespace heml::nested_dissection_test
