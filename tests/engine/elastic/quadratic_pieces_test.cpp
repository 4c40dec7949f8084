// Removed and divided quadratic elements: what is left, and pieces, act as the whole did and inherit its history.
#include <doctest/doctest.h>

#include <heml/mesh/cut.hpp>
#include <heml/mesh/quadratic_edit.hpp>

#include "quadratic_body.hpp"

namespace heml::quadratic_pieces_test {

using namespace heml::test;

namespace {

/// The elements that an edit leaves, in the place of a body's.
struct Edited {
  MeshEdit edit;
  TetMesh mesh;
  MidEdges midedges;
  std::vector<int> origins, materials;

  Edited(const QuadraticBody& whole, MeshEdit of) : edit(std::move(of)) {
    const auto tets = static_cast<int>(whole.mesh.tets.size());
    TetMesh all = whole.mesh;
    append(edit, all);
    MidEdges middles = whole.midedges;
    middles.insert(middles.end(), edit.midedges.begin(), edit.midedges.end());
    const auto elements = apply_edit(full_topology(whole.mesh), edit, tets).elements;
    mesh = with_elements(all, elements);
    midedges = with_elements(middles, elements);
    for (const int t : elements) origins.push_back(t < tets ? t : edit.parents[static_cast<std::size_t>(t - tets)]);
    materials.assign(elements.size(), 0);
  }
  std::vector<double> on_nodes(std::vector<double> values) const {
    append(edit, values, 3);
    return values;
  }
  void apply_to(ElasticBody<double>& body, const std::vector<double>& x) const {
    body.transfer_state(mesh, materials, origins, midedges, on_nodes(x).data());
  }
};

Edited cut_of(const QuadraticBody& whole) {
  std::vector<Vec3> x;
  for (std::size_t n = 0; n < whole.mesh.nodes.size(); ++n) x.push_back(whole.at(static_cast<int>(n)));
  const Sweep sweep{{{Vec3(0.05, -1, -1), Vec3(0.05, -1, 1)}, {Vec3(0.066, 1, -1), Vec3(0.066, 1, 1)}}};
  Cut cut;
  REQUIRE(make_cut(sweep, whole.mesh, x, full_topology(whole.mesh), 1e-9, {}, cut).ok());
  add_midedge_nodes(whole.mesh, whole.midedges, cut.edit);
  return {whole, cut.edit};
}

Material with_memory(int kind) {
  Material material = sample_material("neo_hookean_iso");
  if (kind == 1) material.viscosity = 40, material.bulk_viscosity = 15;
  if (kind == 2) material.relaxation = {{0.5, 0.02}, {0.3, 0.2}};
  if (kind == 3) material.plasticity = Plasticity{100, 200};
  return material;
}

std::vector<double> mapped(const TetMesh& mesh, const Mat3& F) {
  std::vector<double> x;
  for (const Vec3& X : mesh.nodes) {
    const Vec3 at = F * X;
    x.insert(x.end(), {at.x(), at.y(), at.z()});
  }
  return x;
}

/// A bent state, which is quadratic in each element.
std::vector<double> bent(const TetMesh& mesh, double by) {
  std::vector<double> x;
  for (const Vec3& X : mesh.nodes)
    x.insert(x.end(), {X.x() - 2 * by * X.x() * X.y(), X.y() + by * X.x() * X.x(), X.z() + by * X.x() * X.z()});
  return x;
}

double work(const std::vector<double>& f, const std::vector<double>& u) {
  double sum = 0;
  for (std::size_t i = 0; i < u.size(); ++i) sum += f[i] * u[i];
  return sum;
}

double norm(const std::vector<double>& values) { return std::sqrt(work(values, values)); }

}  // namespace

TEST_CASE("pieces of quadratic elements in affine motions: work and energy of the whole, its history included") {
  std::mt19937_64 random(11);
  const QuadraticBody whole(random, 0);
  const Edited cut = cut_of(whole);
  REQUIRE(cut.mesh.tets.size() > whole.mesh.tets.size() + 10);
  ThreadTeam team(1);
  for (const bool mean_dilatation : {false, true})
    for (const int kind : {0, 1, 2, 3}) {
      CAPTURE(mean_dilatation);
      CAPTURE(kind);
      const auto body = whole.of(with_memory(kind), true, mean_dilatation),
                 pieces = whole.of(with_memory(kind), true, mean_dilatation);
      std::vector<double> past;
      for (int step = 0; step < 3; ++step) {
        past = mapped(whole.mesh, random_gradient(random, 0.85, 1.2));
        for (ElasticBody<double>* each : {body.get(), pieces.get()}) {
          each->begin_step(0.01);
          each->commit(past.data());
        }
      }
      cut.apply_to(*pieces, past);
      const std::vector<double> now = mapped(whole.mesh, random_gradient(random, 0.9, 1.1)),
                                split_now = cut.on_nodes(now);
      body->begin_step(0.005);
      pieces->begin_step(0.005);
      const auto f = forces_of(*body, now), g = forces_of(*pieces, split_now);
      for (int trial = 0; trial < 3; ++trial) {
        std::vector<double> u(now.size());
        for (double& value : u) value = uniform(random, -1, 1);
        CHECK(std::abs(work(f, u) - work(g, cut.on_nodes(u))) <= 1e-10 * norm(f) * norm(u));
      }
      CHECK(pieces->potential(split_now.data(), team) ==
            doctest::Approx(body->potential(now.data(), team)).epsilon(1e-10));
      CHECK(pieces->plastic_work() == body->plastic_work());
      if (kind == 3) CHECK(body->plastic_work() > 0);
    }
}

TEST_CASE("pieces of quadratic elements at rest in a bent state: viscosity feels no cut, relaxation little of it") {
  std::mt19937_64 random(4);
  const QuadraticBody whole(random, 0);
  const Edited cut = cut_of(whole);
  const std::vector<double> x = bent(whole.mesh, 1.5), split = cut.on_nodes(x);
  const auto forces_after = [&](int kind, bool is_cut) {
    const auto body = whole.of(with_memory(kind), true);
    for (int step = 0; step < 3; ++step) {
      body->begin_step(0.01);
      body->commit(x.data());
    }
    if (is_cut) cut.apply_to(*body, x);
    body->begin_step(0.01);
    return forces_of(*body, is_cut ? split : x);
  };
  const auto elastic = forces_after(0, true), viscous = forces_after(1, true);
  std::vector<double> difference;
  for (std::size_t i = 0; i < elastic.size(); ++i) difference.push_back(viscous[i] - elastic[i]);
  CHECK(norm(difference) <= 1e-10 * norm(elastic));
  // Work on affine displacements: of the relaxing part alone, before the cut and after it.
  const auto relaxing = [&](bool is_cut, const std::vector<double>& u) {
    const auto& on = is_cut ? cut.on_nodes(u) : u;
    return work(forces_after(2, is_cut), on) - work(forces_after(0, is_cut), on);
  };
  double largest = 0;
  std::vector<double> changes;
  for (int trial = 0; trial < 4; ++trial) {
    const std::vector<double> u = mapped(whole.mesh, random_gradient(random, 0.5, 1.5));
    largest = std::max(largest, std::abs(relaxing(false, u)));
    changes.push_back(relaxing(true, u) - relaxing(false, u));
  }
  REQUIRE(largest > 0);
  for (const double change : changes) CHECK(std::abs(change) <= 0.1 * largest);
}

TEST_CASE("quadratic elements left by a removal act as a body made of them alone, and remember as it does") {
  std::mt19937_64 random(8);
  const QuadraticBody whole(random, 0.1);
  MeshEdit edit;
  edit.removed = {1, 4, 7};
  const Edited left(whole, edit);
  ThreadTeam team(1);
  for (const bool mean_dilatation : {false, true})
    for (const int kind : {0, 1, 2, 3}) {
      CAPTURE(mean_dilatation);
      CAPTURE(kind);
      const auto body = whole.of(with_memory(kind), true, mean_dilatation);
      ElasticBody<double> alone(left.mesh, left.materials, {with_memory(kind)}, BodyOptions{true, mean_dilatation},
                                left.midedges);
      std::vector<double> x = whole.x;
      for (int step = 0; step < 3; ++step) {
        for (ElasticBody<double>* each : {body.get(), &alone}) {
          each->begin_step(0.01);
          each->commit(x.data());
        }
        for (double& value : x) value += uniform(random, -1e-3, 1e-3);
      }
      left.apply_to(*body, x);
      body->begin_step(0.005);
      alone.begin_step(0.005);
      CHECK(forces_of(*body, x) == forces_of(alone, x));
      CHECK(body->energy(x.data(), team) == alone.energy(x.data(), team));
      CHECK(body->masses() == alone.masses());
      CHECK(body->consistent_masses() == alone.consistent_masses());
      CHECK(body->frequency_bound(x.data(), team) == alone.frequency_bound(x.data(), team));
      CHECK(body->internal_state().values == alone.internal_state().values);
    }
}

}  // namespace heml::quadratic_pieces_test
