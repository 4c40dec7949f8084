// What an electrode coagulates, by its distance from the path, and what keeps it.
#include <doctest/doctest.h>

#include <heml/mesh/burn.hpp>
#include <heml/mesh/generate.hpp>
#include <heml/mesh/refine.hpp>
#include <heml/mesh/reorder.hpp>
#include <heml/mesh/subdivide.hpp>
#include <limits>

#include "support.hpp"

namespace heml::burn_test {
namespace {

constexpr Heat heat{0.02, 0.25};

Sweep line(std::vector<Vec3> tips) {
  Sweep sweep;
  for (const Vec3& tip : tips) sweep.blades.push_back({tip, tip});
  return sweep;
}

std::vector<Burn> burns_of(const TetMesh& mesh, const Sweep& sweep, const Heat& with = heat) {
  return burns_after(with, sweep, mesh, mesh.nodes, full_topology(mesh));
}

/// The distance of an element from the convex hull of a path's points, by Gilbert's algorithm (1966): the point of the
/// hull of all differences that is nearest to the origin.
double hull_distance(const TetMesh& mesh, std::size_t t, const std::vector<Vec3>& path) {
  std::vector<Vec3> differences;
  for (const int n : mesh.tets[t])
    for (const Vec3& point : path) differences.push_back(point - mesh.nodes[static_cast<std::size_t>(n)]);
  Vec3 nearest = differences[0];
  for (int k = 0; k < 20000; ++k) {
    const auto along = [&](const Vec3& a, const Vec3& b) { return a.dot(nearest) < b.dot(nearest); };
    const Vec3 step = *std::min_element(differences.begin(), differences.end(), along) - nearest;
    if (!(-step.dot(nearest) > 1e-12 * nearest.squaredNorm())) break;
    nearest += std::min(1.0, -step.dot(nearest) / step.squaredNorm()) * step;
  }
  return nearest.norm();
}

}  // namespace

TEST_CASE("burn: all up to half the radius, nothing from the radius on, and falling between them") {
  for (const double d : {0.0, 0.004, 0.01}) CHECK(burn_level(d, 0.02) == 1);
  for (const double d : {0.02, 0.03, 1e9}) CHECK(burn_level(d, 0.02) == 0);
  CHECK(burn_level(0.015, 0.02) == doctest::Approx(0.5));
  double before = 1;
  for (int k = 1; k < 100; ++k) {
    const double now = burn_level(0.01 + k * 1e-4, 0.02);
    CHECK(now < before);
    before = now;
  }
}

TEST_CASE("burn: an element has the level of its nearest point, and shrinks in proportion") {
  const TetMesh mesh = make_box(Vec3(0.1, 0.05, 0.05), {8, 4, 4});
  const Vec3 from(0.02, 0.05, 0.02), to(0.07, 0.05, 0.03);
  const std::vector<Burn> burns = burns_of(mesh, line({from, to}));
  int whole = 0, partly = 0, none = 0;
  for (std::size_t t = 0; t < burns.size(); ++t) {
    const double level = burn_level(hull_distance(mesh, t, {from, to}), heat.radius);
    CHECK(burns[t].level == doctest::Approx(level).epsilon(1e-3));
    CHECK(burns[t].shrink == doctest::Approx(0.25 * burns[t].level));
    CHECK(burns[t].scale == 1);
    ++(burns[t].level == 1 ? whole : burns[t].level == 0 ? none : partly);
  }
  CHECK(whole > 10);
  CHECK(partly > 10);
  CHECK(none > 10);
}

TEST_CASE("burn: a long electrode burns about all that it sweeps, a single place about itself") {
  const TetMesh mesh = make_box(Vec3(0.1, 0.06, 0.1), {10, 6, 10});
  const Vec3 down(0, -0.04, 0), a(0.02, 0.06, 0.047), b(0.08, 0.06, 0.047);
  const std::vector<Vec3> rectangle{a, b, b + down, a + down};
  const std::vector<Burn> swept = burns_of(mesh, {{{a, a + down}, {b, b + down}}}, {0.012, 0.2});
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    CHECK(swept[t].level == doctest::Approx(burn_level(hull_distance(mesh, t, rectangle), 0.012)).epsilon(1e-3));
  const std::vector<Burn> spot = burns_of(mesh, line({a}), {0.012, 0.2});
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    CHECK(spot[t].level == doctest::Approx(burn_level(hull_distance(mesh, t, {a}), 0.012)).epsilon(1e-3));
}

TEST_CASE("burn: no place on large elements is missed, however small the electrode, on the surface or in them") {
  const TetMesh mesh = make_box(Vec3(0.1, 0.1, 0.1), {2, 2, 2});
  std::mt19937_64 random(9);
  for (int k = 0; k < 100; ++k) {
    const Vec3 tip(test::uniform(random, 0, 0.1), test::uniform(random, 0, 0.1), k % 2 ? 0.1 : 0.05);
    const Sweep stab{{{tip, tip - Vec3(0, 0, 0.01)}}};
    for (const Sweep& sweep : {line({tip}), stab}) {
      const std::vector<Burn> burns = burns_of(mesh, sweep, {1e-4, 0.2});
      CHECK(std::any_of(burns.begin(), burns.end(), [](const Burn& burn) { return burn.level == 1; }));
    }
  }
}

TEST_CASE("burn: rest shapes go on to their end by equal parts of their first length, and no further") {
  std::vector<Burn> burns{{1, 0.2, 1}, {0.25, 0.05, 1}, {}};
  CHECK(are_contracting(burns));
  contract(burns, 0.06);
  CHECK(burns[0].scale == doctest::Approx(0.94));
  CHECK(burns[1].scale == 0.95);
  CHECK(burns[2] == Burn{});
  CHECK(are_contracting(burns));
  contract(burns, 0.06);
  CHECK(are_contracting(burns));
  contract(burns, 1);
  CHECK(burns[0].scale == 0.8);
  CHECK_FALSE(are_contracting(burns));
  burns[0].shrink = 0.3;
  CHECK(are_contracting(burns));
  contract(burns, std::numeric_limits<double>::infinity());
  CHECK(burns[0].scale == 0.7);
}

TEST_CASE("burn: of several passes the highest level and the smallest shape hold, in any order") {
  TetMesh once = make_box(Vec3(0.1, 0.05, 0.05), {8, 4, 4});
  const Sweep path = line({Vec3(0.02, 0.05, 0.02), Vec3(0.07, 0.05, 0.03)});
  TetMesh twice = once, back = once;
  once.burns = twice.burns = burns_of(once, path);
  for (int k = 0; k < 5; ++k) twice.burns = burns_of(twice, path);
  CHECK(twice.burns == once.burns);
  const Sweep other = line({Vec3(0.05, 0.05, 0), Vec3(0.05, 0.05, 0.05)});
  once.burns = burns_of(once, other, {0.03, 0.4});
  back.burns = burns_of(back, other, {0.03, 0.4});
  back.burns = burns_of(back, path);
  CHECK(once.burns == back.burns);
  for (const Burn& burn : once.burns) {
    CHECK(burn.level <= 1);
    CHECK(burn.shrink <= 0.4);
  }
}

TEST_CASE("burn: distances are those of the tissue as it lies now, and elements that are gone stay as they were") {
  const TetMesh mesh = make_box(Vec3(0.1, 0.05, 0.05), {4, 2, 2});
  std::vector<Vec3> moved = mesh.nodes;
  for (Vec3& x : moved) x += Vec3(1, 2, 3);
  const Vec3 spot(0.05, 0.05, 0.02);
  const auto there = burns_after(heat, line({spot + Vec3(1, 2, 3)}), mesh, moved, full_topology(mesh));
  const auto here = burns_of(mesh, line({spot}));
  for (std::size_t t = 0; t < here.size(); ++t) CHECK(there[t].level == doctest::Approx(here[t].level));
  Topology half = full_topology(mesh);
  half.elements.resize(mesh.tets.size() / 2);
  const std::vector<Burn> burns = burns_after({1, 0.2}, line({spot}), mesh, mesh.nodes, half);
  for (std::size_t t = 0; t < burns.size(); ++t) CHECK((burns[t].level == 1) == (t < mesh.tets.size() / 2));
}

TEST_CASE("burn: pieces, refined elements, subsets, other orders and integration points have that of their element") {
  std::mt19937_64 random(5);
  TetMesh mesh = make_box(Vec3(0.1, 0.05, 0.05), {2, 1, 1});
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) mesh.burns.push_back({test::uniform(random, 0, 1), 0.2, 0.9});

  MeshEdit edit;
  edit.removed = {2};
  edit.added = {mesh.tets[2], mesh.tets[2]};
  edit.parents = {2, 2};
  TetMesh cut = mesh;
  append(edit, cut);
  REQUIRE(cut.burns.size() == cut.tets.size());
  CHECK(cut.burns.back() == mesh.burns[2]);

  const Refinement refined = refine_longest_edge(mesh, {1, 4});
  REQUIRE(refined.mesh.burns.size() == refined.mesh.tets.size());
  for (std::size_t t = 0; t < refined.parents.size(); ++t)
    CHECK(refined.mesh.burns[t] == mesh.burns[static_cast<std::size_t>(refined.parents[t])]);

  const TetMesh eighths = subdivide_uniformly(mesh).mesh;
  REQUIRE(eighths.burns.size() == 8 * mesh.burns.size());
  for (std::size_t t = 0; t < eighths.burns.size(); ++t) CHECK(eighths.burns[t] == mesh.burns[t / 8]);

  CHECK(with_elements(mesh, {3, 7}).burns == std::vector{mesh.burns[3], mesh.burns[7]});

  const Reordering order = hilbert_order(mesh);
  const TetMesh inner = reordered(mesh, order);
  for (std::size_t t = 0; t < inner.burns.size(); ++t)
    CHECK(inner.burns[t] == mesh.burns[static_cast<std::size_t>(order.file_tet[t])]);

  TetMesh quadratic = mesh;
  const MidEdges midedges = add_midedge_nodes(quadratic);
  const TetMesh points = virtual_tets(quadratic, midedges);
  REQUIRE(points.burns.size() == element_points * mesh.burns.size());
  for (std::size_t t = 0; t < points.burns.size(); ++t) CHECK(points.burns[t] == mesh.burns[t / element_points]);
}

}  // namespace heml::burn_test
