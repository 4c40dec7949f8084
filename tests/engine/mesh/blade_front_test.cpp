#include <doctest/doctest.h>

#include <heml/mesh/blade_front.hpp>
#include <heml/mesh/generate.hpp>

namespace heml::blade_front_test {

namespace {

const std::array<Vec3, 2> blade{Vec3(0.43, 0.51, -1), Vec3(0.43, 0.51, 2)};

Sweep to(const Vec3& by) { return {{blade, {blade[0] + by, blade[1] + by}}}; }

}  // namespace

TEST_CASE("blade front: the joined sweep starts where the front is in the moved tissue") {
  const TetMesh mesh = make_box(Vec3(1, 1, 1), {3, 3, 3});
  const BladeFront front(blade, mesh, mesh.nodes, full_topology(mesh));
  CHECK(front.in_tissue());
  const Vec3 shift(0.02, 0.1, 0.01);
  std::vector<Vec3> x = mesh.nodes;
  for (Vec3& place : x) place += shift;
  const OrientedSweep joined = front.join(to(Vec3(0.1, 0, 0)), mesh, x, full_topology(mesh), 0.1);
  const SweptSurface surface(joined);
  // The strip from the moved front to the next blade closes the gap that the shift has opened.
  CHECK(surface.crossing(Vec3(0.40, 0.52, 0.5), Vec3(0.60, 0.52, 0.5)).has_value());
  CHECK(surface.crossing(Vec3(0.40, 0.60, 0.5), Vec3(0.60, 0.60, 0.5)).has_value());
  CHECK_FALSE(surface.crossing(Vec3(0.40, 0.62, 0.5), Vec3(0.60, 0.62, 0.5)).has_value());
}

TEST_CASE("blade front: blades behind the front are left out, and kept for later") {
  const TetMesh mesh = make_box(Vec3(1, 1, 1), {3, 3, 3});
  BladeFront front(blade, mesh, mesh.nodes, full_topology(mesh));
  std::vector<Vec3> x = mesh.nodes;
  for (Vec3& place : x) place += Vec3(0.2, 0, 0);
  const Sweep behind = to(Vec3(0.1, 0, 0));
  CHECK(SweptSurface(front.join(behind, mesh, x, full_topology(mesh), 0.1)).empty());
  front.pass(behind);
  const Vec3 step(0.2, 0, 0);
  const Sweep ahead{{behind.blades[1], {behind.blades[1][0] + step, behind.blades[1][1] + step}}};
  const SweptSurface surface(front.join(ahead, mesh, x, full_topology(mesh), 0.1));
  CHECK_FALSE(surface.crossing(Vec3(0.6, 0.4, 0.5), Vec3(0.6, 0.6, 0.5)).has_value());
  CHECK(surface.crossing(Vec3(0.7, 0.4, 0.5), Vec3(0.7, 0.6, 0.5)).has_value());
}

TEST_CASE("blade front: a blade in the air, or a sweep that starts elsewhere, leaves the sweep as it is") {
  const TetMesh mesh = make_box(Vec3(1, 1, 1), {3, 3, 3});
  const Sweep sweep = to(Vec3(0.1, 0, 0));
  const BladeFront in_air({Vec3(5, 0, 0), Vec3(5, 0, 1)}, mesh, mesh.nodes, full_topology(mesh));
  CHECK_FALSE(in_air.in_tissue());
  CHECK(in_air.join(sweep, mesh, mesh.nodes, full_topology(mesh), 0.1).sweep.blades == sweep.blades);
  const BladeFront elsewhere({Vec3(0.8, 0.5, -1), Vec3(0.8, 0.5, 2)}, mesh, mesh.nodes, full_topology(mesh));
  CHECK(elsewhere.join(sweep, mesh, mesh.nodes, full_topology(mesh), 0.1).sweep.blades == sweep.blades);
}

}  // namespace heml::blade_front_test
