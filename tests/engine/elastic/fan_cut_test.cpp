// Removal and cutting of elements in bodies of several fan blocks: blocks that an edit does not touch are kept.
#include <doctest/doctest.h>

#include <heml/elastic/fan_cut.hpp>
#include <heml/elastic/fan_layout.hpp>
#include <heml/mesh/cut.hpp>
#include <heml/mesh/reorder.hpp>
#include <numeric>
#include <set>

#include "small_body.hpp"

namespace heml::fan_cut_test {

using namespace heml::test;

namespace {

TetMesh box_of(std::mt19937_64& random, const std::array<int, 3>& cells) {
  TetMesh mesh = make_box(Vec3(0.1, 0.08, 0.06), cells);
  for (Vec3& X : mesh.nodes) X += random_vector(random, 0.01 / cells[0]);
  return reordered(mesh, hilbert_order(mesh));
}

/// An edited body: its mesh and the positions of its nodes.
struct Edited {
  TetMesh mesh;
  std::vector<int> material_of;
  std::vector<double> x;
  std::vector<Material> materials;
  std::vector<std::unique_ptr<ElasticBody<double>>> bodies;  ///< all with the same history of edits

  Edited(std::mt19937_64& random, std::vector<Material> of, const std::vector<int>& threads)
      : mesh(box_of(random, {12, 11, 11})), materials(std::move(of)) {
    for (std::size_t t = 0; t < mesh.tets.size(); ++t)
      material_of.push_back(static_cast<int>(3 * t / mesh.tets.size() * materials.size() / 3));
    for (const Vec3& X : mesh.nodes) {
      const Vec3 moved = Vec3(1.05 * X.x(), 0.97 * X.y(), X.z()) + random_vector(random, 4e-4);
      x.insert(x.end(), {moved.x(), moved.y(), moved.z()});
    }
    for (const int count : threads) bodies.push_back(make(count));
  }

  std::unique_ptr<ElasticBody<double>> make(int threads) const {
    BodyOptions options;
    options.threads = threads;
    return std::make_unique<ElasticBody<double>>(mesh, material_of, materials, options);
  }

  void remove(const std::set<int>& gone) {
    std::vector<int> kept;
    for (int t = 0; t < static_cast<int>(mesh.tets.size()); ++t)
      if (!gone.contains(t)) kept.push_back(t);
    for (const auto& body : bodies) body->keep_elements(kept);
    mesh = with_elements(mesh, kept);
    material_of = with_elements(material_of, kept);
  }

  void cut(const Sweep& sweep) {
    std::vector<Vec3> at;
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) at.push_back(Eigen::Map<const Vec3>(&x[3 * n]));
    Cut cut;
    REQUIRE(make_cut(sweep, mesh, at, full_topology(mesh), snapping_distance(mesh), {}, cut).ok());
    REQUIRE(cut.edit.added.size() > 20);
    const auto tets = static_cast<int>(mesh.tets.size());
    std::vector<int> origins, of_all = material_of;
    for (const int parent : cut.edit.parents) of_all.push_back(material_of[static_cast<std::size_t>(parent)]);
    const auto elements = apply_edit(full_topology(mesh), cut.edit, tets).elements;
    append(cut.edit, mesh);
    append(cut.edit, x, 3);
    mesh = with_elements(mesh, elements);
    material_of = with_elements(of_all, elements);
    for (const int t : elements) origins.push_back(t < tets ? t : cut.edit.parents[static_cast<std::size_t>(t - tets)]);
    for (const auto& body : bodies) body->transfer_state(mesh, material_of, origins);
  }

  /// All bodies give the same bits, equal to those of a body built from the present mesh to round-off.
  void check() const {
    const auto f = forces_of(*bodies.front(), x), anew = forces_of(*make(1), x);
    for (std::size_t b = 1; b < bodies.size(); ++b) CHECK(forces_of(*bodies[b], x, static_cast<int>(b) + 1) == f);
    double worst = 0;
    for (std::size_t i = 0; i < f.size(); ++i) worst = std::max(worst, std::abs(f[i] - anew[i]));
    CHECK(worst <= 1e-12 * largest(anew));
    CHECK(largest(anew) > 0);
    const auto masses = bodies.front()->masses(), fresh = make(1)->masses();
    for (std::size_t n = 0; n < masses.size(); ++n) CHECK(masses[n] == doctest::Approx(fresh[n]).epsilon(1e-13));
  }
};

std::set<int> near(const TetMesh& mesh, const Vec3& place, double radius) {
  std::set<int> found;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    Vec3 centre = Vec3::Zero();
    for (const int n : mesh.tets[t]) centre += mesh.nodes[static_cast<std::size_t>(n)] / 4;
    if ((centre - place).norm() < radius) found.insert(static_cast<int>(t));
  }
  return found;
}

}  // namespace

TEST_CASE("overlapping tetrahedra are cut into groups of fans of one size, each in one of them") {
  std::mt19937_64 random(5);
  std::vector<Vec3> X(30);
  for (Vec3& place : X) place = random_vector(random, 1);
  std::uniform_int_distribution<int> any(0, 29);
  std::vector<Tet> tets;
  while (tets.size() < 2000) {
    const Tet t{any(random), any(random), any(random), any(random)};
    const auto at = [&](std::size_t c) { return X[static_cast<std::size_t>(t[c])]; };
    if (signed_volume(at(0), at(1), at(2), at(3)) > 1e-3) tets.push_back(t);
  }
  for (const std::size_t lanes : {4, 8, 16}) {
    const std::vector<Fan> fans = cut_into_fans(tets, lanes);
    REQUIRE(fans.size() % lanes == 0);
    std::vector<int> times(tets.size(), 0);
    bool are_one_size = true;
    for (std::size_t f = 0; f < fans.size(); ++f) {
      const FanSize size = fans[f].size(), first = fans[f - f % lanes].size();
      are_one_size &= size.tets == first.tets && size.ring == first.ring;
      for (const std::size_t t : fans[f].tets) ++times[t];
    }
    CHECK(are_one_size);
    CHECK(std::all_of(times.begin(), times.end(), [](int k) { return k == 1; }));
  }
}

TEST_CASE("edited bodies have the forces of bodies built anew, for every layout") {
  Material soft = sample_material("neo_hookean"), stiff = sample_material("ogden"), fibres = sample_material("hgo");
  const std::vector<std::vector<Material>> all = {{sample_material("stvk")}, {soft, stiff, fibres}};
  for (std::size_t kind = 0; kind < all.size(); ++kind) {
    CAPTURE(kind);
    std::mt19937_64 random(41 + kind);
    Edited body(random, all[kind], {1, 3});
    body.remove(near(body.mesh, Vec3(0.03, 0.03, 0.03), 0.012));
    body.check();
    body.cut({{{Vec3(0.06, 0.02, -1), Vec3(0.06, 0.05, -1)}, {Vec3(0.065, 0.02, 1), Vec3(0.062, 0.05, 1)}}});
    body.check();
    std::set<int> scattered;  // pieces too
    while (scattered.size() < 60)
      scattered.insert(std::uniform_int_distribution<int>(0, static_cast<int>(body.mesh.tets.size()) - 1)(random));
    body.remove(scattered);
    body.check();
    body.cut({{{Vec3(-1, 0.041, 0.01), Vec3(-1, 0.041, 0.04)}, {Vec3(1, 0.043, 0.01), Vec3(1, 0.04, 0.04)}}});
    body.check();
  }
}

TEST_CASE("a material that is cut away altogether takes its fans along, and the others stay") {
  std::mt19937_64 random(44);
  Edited body(random, {sample_material("stvk"), sample_material("yeoh")}, {1, 2});
  std::set<int> gone;
  for (std::size_t t = 0; t < body.material_of.size(); ++t)
    if (body.material_of[t] == 0) gone.insert(static_cast<int>(t));
  body.remove(gone);
  body.check();
}

TEST_CASE("blocks that an edit does not touch keep their layout") {
  std::mt19937_64 random(45);
  const TetMesh mesh = box_of(random, {14, 12, 12});
  std::vector<int> all(mesh.tets.size()), kept;
  std::iota(all.begin(), all.end(), 0);
  ThreadTeam team(1);
  const FanLayout<float> before(mesh, {{all}}, 8, team);
  REQUIRE(before.blocks.size() >= 4);
  const auto gone = near(mesh, Vec3(0.01, 0.01, 0.01), 0.009);
  REQUIRE(gone.size() > 5);
  for (const int t : all)
    if (!gone.contains(t)) kept.push_back(t);
  const TetMesh left = with_elements(mesh, kept);
  all.resize(kept.size());
  FanLayout<float> after = before.after_edit(mesh, left, {{all}}, kept, 8, team);
  CHECK(after.elements() == kept.size());
  std::size_t same = 0, lost = 0;
  REQUIRE(after.blocks.size() == before.blocks.size());
  for (std::size_t b = 0; b < before.blocks.size(); ++b) {
    const auto &old = before.blocks[b], &now = after.blocks[b];
    lost += old.elements - now.elements;
    if (old.elements != now.elements) continue;
    ++same;
    CHECK(old.groups == now.groups);
    const NodeBlocks::Block &nodes = before.nodes.blocks[b], &nodes_now = after.nodes.blocks[b];
    CHECK(nodes.own == nodes_now.own);
    const auto* const place = &before.nodes.place[nodes.place];
    CHECK(std::equal(place, place + nodes.nodes, &after.nodes.place[nodes_now.place]));
    CHECK(before.index[old.index] == after.index[now.index]);
    CHECK(before.shape[old.shape] == after.shape[now.shape]);
  }
  CHECK(lost == gone.size());
  CHECK(same >= before.blocks.size() / 2);
  // Removes all elements of one block.
  std::vector<int> without;
  const auto& first = after.blocks.front();
  const std::set<int> of_first(&after.element[first.element], &after.element[first.element] + first.elements);
  for (const int t : all)
    if (!of_first.contains(t)) without.push_back(t);
  const TetMesh less = with_elements(left, without);
  all.resize(without.size());
  const std::size_t blocks = after.blocks.size();
  after = after.after_edit(left, less, {{all}}, without, 8, team);
  CHECK(after.blocks.size() == blocks - 1);
  CHECK(after.elements() == without.size());
}

}  // namespace heml::fan_cut_test
