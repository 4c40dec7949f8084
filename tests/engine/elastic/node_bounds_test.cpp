#include <doctest/doctest.h>

#include <cmath>
#include <heml/elastic/node_bounds.hpp>
#include <limits>
#include <random>

#include "small_body.hpp"

namespace heml::node_bounds_test {
namespace {

/// One evaluation of these bounds, `steps` after the last.
double evaluate(NodeBounds<double>& nodes, const std::vector<double>& bounds, int steps) {
  nodes.begin(bounds.size(), steps);
  for (const int n : nodes.due()) nodes.set(static_cast<std::size_t>(n), bounds[static_cast<std::size_t>(n)]);
  return nodes.end();
}

double maximum(const std::vector<double>& bounds) { return *std::max_element(bounds.begin(), bounds.end()); }

}  // namespace

TEST_CASE("node bounds: a node far below the maximum waits for its turn, the largest does not") {
  NodeBounds<double> nodes;
  const std::vector<double> bounds{1, 10, 2, 10};
  CHECK(evaluate(nodes, bounds, 8) == 10);
  CHECK(nodes.due().size() == 4);
  CHECK(evaluate(nodes, bounds, 2) == 10);
  CHECK(nodes.due().size() == 4);  // how fast they grow is known only now
  for (int steps = 2; steps < NodeBounds<double>::max_age; steps += 2) {
    CHECK(evaluate(nodes, bounds, 2) == 10);
    CHECK(nodes.due() == std::vector<int>{1, 3});
  }
  evaluate(nodes, bounds, 2);
  CHECK(nodes.due().size() == 4);
}

TEST_CASE("node bounds: where a step bears more than the largest, those between are not looked at") {
  NodeBounds<double> nodes;
  std::vector<double> bounds{1, 10, 9, 6};
  const auto look = [&](double bearable) {
    nodes.begin(bounds.size(), 1, bearable);
    for (const int n : nodes.due()) nodes.set(static_cast<std::size_t>(n), bounds[static_cast<std::size_t>(n)]);
    return nodes.end();
  };
  for (int k = 0; k < 2; ++k) look(0);
  bounds[1] = 11, bounds[2] = 9.5;  // neighbours may have grown as fast
  CHECK(look(30) == 11);
  CHECK(nodes.due() == std::vector<int>{1});
  bounds[1] = 12;
  look(14);  // 9 after two steps in which others grew by 1 a step: to 13 at most
  CHECK(nodes.due() == std::vector<int>{1});
  bounds[1] = 13;
  CHECK(look(14) == 13);
  CHECK(nodes.due() == std::vector<int>{1, 2});
}

TEST_CASE("node bounds: where one grows fast, others may have") {
  NodeBounds<double> nodes;
  std::vector<double> bounds{1, 10, 9, 10};
  for (int k = 0; k < 3; ++k) evaluate(nodes, bounds, 1);
  CHECK(nodes.due() == std::vector<int>{1, 3});
  bounds[1] = 11;  // in one step: two could take 9 to 11 in one
  evaluate(nodes, bounds, 1);
  bounds[2] = 20;
  CHECK(evaluate(nodes, bounds, 1) == 20);
  CHECK(nodes.due() == std::vector<int>{1, 2, 3});
}

TEST_CASE("node bounds: no maximum is missed while none grows faster than one that is watched") {
  std::mt19937_64 random(3);
  long looked = 0, all = 0;
  for (int round = 0; round < 20; ++round) {
    const std::size_t count = 400;
    const int fastest = std::uniform_int_distribution<int>(0, static_cast<int>(count) - 1)(random);
    std::vector<double> bounds(count), growth(count);
    for (std::size_t p = 0; p < count; ++p) {
      bounds[p] = test::uniform(random, 0, 100);
      growth[p] = test::uniform(random, 0, 0.05);
    }
    growth[static_cast<std::size_t>(fastest)] = 0.05;
    NodeBounds<double> nodes;
    nodes.watch({fastest});
    for (int k = 0; k < 200; ++k) {
      const int steps = std::uniform_int_distribution<int>(1, 4)(random);
      for (std::size_t p = 0; p < count; ++p) bounds[p] += steps * growth[p];
      REQUIRE(evaluate(nodes, bounds, steps) == maximum(bounds));
      looked += static_cast<long>(nodes.due().size());
      all += static_cast<long>(count);
    }
  }
  CHECK(looked < all / 4);
}

TEST_CASE("node bounds: watched ones are looked at each time, and all after something else is the case") {
  NodeBounds<double> nodes;
  std::vector<double> bounds{1, 10, 2, 10, 3};
  nodes.watch({0, 4});
  for (int k = 0; k < 3; ++k) evaluate(nodes, bounds, 1);
  CHECK(nodes.due() == std::vector<int>{0, 1, 3, 4});
  bounds[0] = 30;
  CHECK(evaluate(nodes, bounds, 1) == 30);
  bounds[1] = bounds[3] = bounds[0] = 5;  // the largest falls: what is known of the rest holds
  CHECK(evaluate(nodes, bounds, 1) == 5);
  nodes.forget();
  bounds[2] = 70;
  CHECK(evaluate(nodes, bounds, 1) == 70);
  bounds.assign(2, 4);
  CHECK(evaluate(nodes, bounds, 1) == 4);
  CHECK(evaluate(nodes, {}, 1) == 0);
}

TEST_CASE("node bounds: one that is no number is told, until it is one again") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  NodeBounds<double> nodes;
  std::vector<double> bounds{1, 10, 2};
  for (int k = 0; k < 3; ++k) evaluate(nodes, bounds, 1);
  bounds[1] = nan;
  CHECK(std::isnan(evaluate(nodes, bounds, 1)));
  bounds[1] = infinity;
  CHECK(evaluate(nodes, bounds, 1) == infinity);
  bounds[1] = 10;
  CHECK(evaluate(nodes, bounds, 1) == 10);
  for (int k = 0; k < NodeBounds<double>::max_age + 3; ++k) evaluate(nodes, bounds, 1);
  CHECK(nodes.due() == std::vector<int>{1});
}

TEST_CASE("node bounds of a body: at first those of all nodes, then of those near the largest, by any threads") {
  std::mt19937_64 random(4);
  const TetMesh mesh = test::irregular_box(random, {12, 10, 8});
  std::vector<int> material_of(mesh.tets.size());
  for (std::size_t t = 0; t < material_of.size(); ++t) material_of[t] = static_cast<int>(t % 2);
  ElasticBody<double> body(mesh, material_of,
                           {test::sample_material("neo_hookean"), test::sample_material("mooney_rivlin")},
                           BodyOptions{true, false});
  std::vector<double> x;
  for (const Vec3& X : mesh.nodes) x.insert(x.end(), {X.x(), X.y(), X.z()});
  const Mat3 stretch = Vec3(-2e-4, 1e-4, 0).asDiagonal();  // a step, and more to one side than to the other
  NodeBounds<double> of_one, of_three;
  ThreadTeam one(1), three(3);
  std::size_t looked = 0, all = 0;
  for (int k = 0; k < 50; ++k) {
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
      Eigen::Map<Vec3>(&x[3 * n]) += mesh.nodes[n].x() / 0.1 * (stretch * mesh.nodes[n]);
    const double whole = body.frequency_bound(x.data(), one);
    const double partial = body.frequency_bound(x.data(), one, of_one, 2);
    CHECK(body.frequency_bound(x.data(), three, of_three, 2) == partial);
    if (k < 2) CHECK(partial == whole);
    CHECK(partial == doctest::Approx(whole).epsilon(0.02));
    looked += of_one.due().size();
    all += mesh.nodes.size();
  }
  CHECK(looked < all / 4);
}

TEST_CASE("node bounds of a body: what springs add to all counts against what a step bears") {
  std::mt19937_64 random(9);
  TetMesh mesh = test::irregular_box(random, {6, 3, 2});
  for (Vec3& X : mesh.nodes) X.x() = X.x() < 0.02 ? X.x() : 0.02 + 4 * (X.x() - 0.02);  // large ones at one end
  Material springs = test::sample_material("mass_spring");
  springs.parameters[0] *= 100;
  std::vector<int> material_of(mesh.tets.size());
  for (std::size_t t = 0; t < material_of.size(); ++t) material_of[t] = t % 5 == 0;
  ElasticBody<double> body(mesh, material_of, {test::sample_material("veronda_westmann"), springs},
                           BodyOptions{true, false});
  ThreadTeam team(1);
  std::vector<double> x;
  for (const Vec3& X : mesh.nodes) x.insert(x.end(), {X.x(), X.y(), X.z()});
  const double bearable = 1.1 * body.frequency_bound(x.data(), team);
  NodeBounds<double> nodes;
  double whole = 0;
  for (int k = 0; k < 25; ++k) {  // fewer steps than it takes for all to be looked at in turn
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
      if (mesh.nodes[n].x() > 0.2) x[3 * n] = 0.2 + (1 + 0.1 * k) * (mesh.nodes[n].x() - 0.2);
    whole = body.frequency_bound(x.data(), team);
    const double partial = body.frequency_bound(x.data(), team, nodes, 1, bearable);
    CAPTURE(k);
    if (whole > 1.02 * bearable) CHECK(partial > bearable);
  }
  CHECK(whole > 1.5 * bearable);
}

TEST_CASE("node bounds of a body: those near a place are watched where nobody would look") {
  std::mt19937_64 random(5);
  const TetMesh mesh = test::irregular_box(random, {8, 8, 8});
  ElasticBody<double> body(mesh, std::vector<int>(mesh.tets.size(), 0), {test::sample_material("neo_hookean")},
                           BodyOptions{true, false});
  ThreadTeam team(1);
  std::vector<double> x;
  for (const Vec3& X : mesh.nodes) x.insert(x.end(), {X.x(), X.y(), X.z()});
  // A node of low bound is pressed against its neighbours between two evaluations.
  NodeBounds<double> at_rest;
  body.frequency_bound(x.data(), team, at_rest, 0);
  const auto& bounds = at_rest.bounds();
  const auto n = static_cast<std::size_t>(std::min_element(bounds.begin(), bounds.end()) - bounds.begin());
  const auto beside = *std::find_if(mesh.tets.begin(), mesh.tets.end(), [n](const Tet& tet) {
    return std::find(tet.begin(), tet.end(), static_cast<int>(n)) != tet.end();
  });
  const auto other = static_cast<std::size_t>(beside[0] == static_cast<int>(n) ? beside[1] : beside[0]);
  std::vector<int> near;
  for (std::size_t k = 0; k < mesh.nodes.size(); ++k)
    if ((mesh.nodes[k] - mesh.nodes[n]).norm() < 0.025) near.push_back(static_cast<int>(k));
  REQUIRE(near.size() < mesh.nodes.size() / 4);
  for (const bool watches : {false, true}) {
    NodeBounds<double> nodes;
    if (watches) nodes.watch(near);
    auto moved = x;
    for (int k = 0; k < 3; ++k) body.frequency_bound(moved.data(), team, nodes, 1);
    for (int i = 0; i < 3; ++i) {
      const auto c = static_cast<std::size_t>(i);
      moved[3 * n + c] += 0.9 * (mesh.nodes[other][i] - x[3 * n + c]);
    }
    const double whole = body.frequency_bound(moved.data(), team);
    const double partial = body.frequency_bound(moved.data(), team, nodes, 1);
    CHECK((partial == whole) == watches);
  }
}

}  // namespace heml::node_bounds_test
