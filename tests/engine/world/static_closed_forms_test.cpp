// Statics against solutions on paper; the cases are those SOFA publishes for its own elements: the traction of a linear
// elastic cylinder, and one regular tetrahedron. (Its third, the affine patch, is in static_test.cpp.)
#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "world_support.hpp"

namespace heml::static_closed_forms_test {

using namespace heml::test;

namespace {

constexpr double young = 1e4;

/// A cylinder along z from z = 0: a block whose square rings are pulled out to circles.
TetMesh cylinder(double radius, double height, int around, int along) {
  TetMesh mesh = make_box(Vec3(2, 2, height), {around, around, along}, Vec3(-1, -1, 0));
  for (Vec3& X : mesh.nodes) {
    const double ring = std::max(std::abs(X.x()), std::abs(X.y())), distance = std::hypot(X.x(), X.y());
    if (ring > 0) X.head<2>() *= radius * ring / distance;
  }
  return mesh;
}

WorldSetup static_setup(TetMesh mesh, const Material& material, double tolerance) {
  WorldSetup setup;
  setup.mesh = std::move(mesh);
  setup.materials = {{std::nullopt, material}};
  setup.solver.integrator = Integrator::static_equilibrium;
  setup.solver.tolerance = tolerance;
  setup.solver.threads = 1;
  return setup;
}

/// Pulls the nodes at a height along z.
Load pull(const TetMesh& mesh, double z, double traction) {
  Load load;
  load.kind = Load::Kind::traction;
  load.nodes = nodes_where(mesh, [&](const Vec3& X) { return std::abs(X.z() - z) < 1e-9; });
  load.vector = Vec3(0, 0, traction);
  return load;
}

/// A regular tetrahedron of that edge, its apex (node 3) above the middle of a face in the plane z = 0 that is held.
WorldSetup regular_tetrahedron(double edge, const Material& material) {
  TetMesh mesh;
  const double height = edge * std::sqrt(2.0 / 3), reach = edge / std::sqrt(3.0);
  for (int corner = 0; corner < 3; ++corner) {
    const double angle = 2 * std::numbers::pi * corner / 3;
    mesh.nodes.emplace_back(reach * std::cos(angle), reach * std::sin(angle), 0);
  }
  mesh.nodes.emplace_back(0, 0, height);
  mesh.tets = {{0, 1, 2, 3}};
  mesh.regions = {0};
  WorldSetup setup = static_setup(mesh, material, 1e-9);
  setup.boundary.push_back({{0, 1, 2}});
  return setup;
}

Vec3 apex_under(WorldSetup setup, const Vec3& force) {
  Load load;
  load.nodes = {3};
  load.vector = force;
  setup.loads = {load};
  const auto world = make_world(setup);
  world->load_to(1);
  if (world->halt()) FAIL(world->halt()->message);
  CHECK((world->reactions()[0] + force).norm() <= 1e-8 * force.norm());
  return world->positions()[3];
}

}  // namespace

TEST_CASE("static: a cylinder under traction p grows by p/E and thins by nu p/E") {
  constexpr double radius = 1, height = 4, strain = 1e-6;
  for (const double poisson : {0.0, 0.1, 0.2, 0.3, 0.4, 0.45, 0.49}) {
    CAPTURE(poisson);
    // The linear law is that of every hyperelastic one at small strain: what differs is of the order of the strain.
    WorldSetup setup = static_setup(cylinder(radius, height, 4, 6), soft("stvk", young, poisson), 1e-7);
    setup.loads = {pull(setup.mesh, height, strain * young), pull(setup.mesh, 0, -strain * young)};
    const auto world = make_world(setup);
    world->load_to(1);
    if (world->halt()) FAIL(world->halt()->message);
    const auto x = world->positions();
    const auto& X = setup.mesh.nodes;
    const auto grown = [&](std::size_t a, std::size_t b) { return (x[a] - x[b]).norm() / (X[a] - X[b]).norm() - 1; };
    // Nodes come x fastest, then y, then z: each with the one opposite on the rim, and with the one at the other end.
    constexpr std::size_t ring = 25, top = 6 * ring;
    for (std::size_t n = 0; n < ring; ++n) CHECK(grown(n, n + top) == doctest::Approx(strain).epsilon(1e-4));
    for (const std::size_t level : {std::size_t{0}, 3 * ring, top})
      for (const auto& [a, b] : {std::pair<std::size_t, std::size_t>{0, 24}, {2, 22}, {10, 14}, {4, 20}})
        CHECK(std::abs(grown(level + a, level + b) + poisson * strain) <= 1e-4 * strain);
  }
}

TEST_CASE("static: the apex of a regular tetrahedron goes where the closed form says, pulled up and aside") {
  // Its base held, F = I + u ⊗ e_z/H for a displacement u of the apex, and the force there is A/3 P e_z.
  constexpr double edge = 0.1, poisson = 0.3;
  const double height = edge * std::sqrt(2.0 / 3), third_of_base = edge * edge * std::sqrt(3.0) / 12;
  const LameParameters lame = lame_parameters(young, poisson);
  const auto neo_hookean = [&](double t) { return lame.mu * (t - 1 / t) + lame.lambda * std::log(t) / t; };
  const auto stvk = [&](double t) { return (lame.lambda / 2 + lame.mu) * (t * t - 1) * t; };
  for (const double t : {0.8, 1 - 1e-6, 1 + 1e-6, 1.1, 1.6})
    for (const auto& [law, stress] :
         {std::pair<std::string, std::function<double(double)>>{"neo_hookean", neo_hookean}, {"stvk", stvk}}) {
      const auto& name = law;
      CAPTURE(name);
      CAPTURE(t);
      const WorldSetup setup = regular_tetrahedron(edge, soft(law.c_str(), young, poisson));
      const Vec3 apex = apex_under(setup, Vec3(0, 0, third_of_base * stress(t)));
      CHECK((apex - Vec3(0, 0, t * height)).norm() <= 1e-8 * std::abs(t - 1) * height);
    }
  // Simple shear: of the Neo-Hookean law, P e_z = μγ e_x, whatever γ.
  for (const double shear : {1e-6, 0.1, 1.0}) {
    CAPTURE(shear);
    const WorldSetup setup = regular_tetrahedron(edge, soft("neo_hookean", young, poisson));
    const Vec3 apex = apex_under(setup, Vec3(third_of_base * lame.mu * shear, 0, 0));
    CHECK((apex - Vec3(shear * height, 0, height)).norm() <= 1e-8 * shear * height);
  }
}

}  // namespace heml::static_closed_forms_test
