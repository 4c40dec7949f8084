// Each operation applied wherever it is taken: the body stays the same, and what is to be better is better.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <heml/mesh/improve/collapse_edge.hpp>
#include <heml/mesh/improve/remove_edge.hpp>
#include <heml/mesh/improve/remove_face.hpp>
#include <heml/mesh/improve/smooth_node.hpp>
#include <heml/mesh/improve/split_edge.hpp>

#include "engine/mesh/improve/bodies.hpp"

namespace heml::improve_operations_test {
namespace {

struct Body {
  TetMesh start = test::shaken_box(4, 0.25);
  LocalMesh mesh{start, ShapeMeasure()};
  SurfaceGuard guard{constrained_surface(start), 1e-4};

  double worst() const {
    std::vector<int> all;
    for (int t = 0; t < mesh.slots(); ++t)
      if (mesh.exists(t)) all.push_back(t);
    return mesh.worst(all);
  }

  /// Applies an operation to every element once; returns how often it was taken.
  template <class Operation>
  int everywhere(const Operation& operation) {
    int taken = 0;
    const int slots = mesh.slots();
    for (int t = 0; t < slots; ++t)
      if (mesh.exists(t)) taken += operation(t, mesh.tet(t));
    test::check_same_body(start, mesh.extract("test"));
    return taken;
  }
};

TEST_CASE("smoothing raises the worst quality and keeps the body") {
  Body body;
  const double before = body.worst();
  CHECK(body.everywhere([&](int, const Tet& tet) { return smooth_node(body.mesh, body.guard, tet[0]); }) > 10);
  CHECK(body.worst() >= before);
}

TEST_CASE("removing edges raises the worst quality and keeps the body") {
  Body body;
  const double before = body.worst();
  CHECK(body.everywhere([&](int, const Tet& tet) {
    return std::any_of(tet_edges.begin(), tet_edges.end(),
                       [&](const auto& e) { return remove_edge(body.mesh, body.guard, tet[e[0]], tet[e[1]]); });
  }) > 10);
  CHECK(body.worst() >= before);
}

TEST_CASE("a face between two flat elements is removed, which gives three better ones") {
  const double c = -0.5, s = std::sqrt(0.75);
  const TetMesh start{
      {{1, 0, 0}, {c, s, 0}, {c, -s, 0}, {0, 0, 0.2}, {0, 0, -0.2}}, {{0, 1, 2, 3}, {0, 2, 1, 4}}, {5, 5}, "flat"};
  LocalMesh mesh(start, ShapeMeasure());
  const double before = mesh.worst(std::array{0, 1});
  CHECK(remove_face(mesh, 0, 3));
  CHECK(mesh.count() == 3);
  CHECK(mesh.worst(std::array{0, 1, 2}) > before);
  test::check_same_body(start, mesh.extract("test"));
}

TEST_CASE("removing faces keeps the body") {
  Body body;
  const double before = body.worst();
  body.everywhere([&](int t, const Tet&) {
    for (int face = 0; face < 4; ++face)
      if (remove_face(body.mesh, t, face)) return true;
    return false;
  });
  CHECK(body.worst() >= before);
}

TEST_CASE("collapsing keeps the body, its corners and its creases") {
  Body body;
  const int before = body.mesh.count();
  CHECK(body.everywhere(
            [&](int, const Tet& tet) { return collapse_edge(body.mesh, body.guard, tet[0], tet[1], 0.02); }) > 5);
  CHECK(body.mesh.count() < before);
}

TEST_CASE("splitting keeps the body, and puts the middle of a surface edge on the surface") {
  Body body;
  const int before = body.mesh.count();
  body.everywhere([&](int t, const Tet& tet) {
    if (t % 7 == 0) split_edge(body.mesh, tet[1], tet[2]);
    return t % 7 == 0;
  });
  CHECK(body.mesh.count() > before);
  const TetMesh mesh = body.mesh.extract("test");
  const LocalMesh again(mesh, ShapeMeasure());
  for (int n = 0; n < body.mesh.nodes(); ++n) CHECK(body.mesh.is_on_surface(n) == again.is_on_surface(n));
}

TEST_CASE("a split that does not help leaves the mesh as it was") {
  const TetMesh start = make_box(Vec3::Constant(0.1), {2, 2, 2});
  LocalMesh mesh(start, ShapeMeasure());
  const SurfaceGuard guard(constrained_surface(start), 1e-4);
  const Tet tet = mesh.tet(0);
  if (!split_if_better(mesh, guard, tet[0], tet[1])) {
    CHECK(mesh.nodes() == static_cast<int>(start.nodes.size()));
    CHECK(mesh.count() == static_cast<int>(start.tets.size()));
  }
  test::check_same_body(start, mesh.extract("test"));
}

TEST_CASE("nodes of a box are free by where they lie") {
  using Kind = NodeFreedom::Kind;
  const TetMesh start = make_box(Vec3::Constant(2), {2, 2, 2});
  const LocalMesh mesh(start, ShapeMeasure());
  for (int n = 0; n < mesh.nodes(); ++n) {
    const Vec3& x = mesh.node(n);
    const int planes = static_cast<int>((x.array() != 1).count());
    const Kind expected[] = {Kind::interior, Kind::smooth, Kind::crease, Kind::corner};
    CHECK(freedom_of(mesh, n).kind == expected[planes]);
  }
}

TEST_CASE("the surface may not leave its tolerance, nor may what it was near to be left") {
  const TriangleMesh square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}, "square"};
  const SurfaceGuard guard(square, 0.01);
  const auto patch = [](double x, double z) { return Patch{{Vec3(x, 0.5, z), Vec3(0, 0, 0), Vec3(1, 0, 0)}}; };
  CHECK(guard.allows(patch(0.5, 0), patch(0.495, 0.005)));
  CHECK_FALSE(guard.allows(patch(0.5, 0), patch(0.5, 0.02)));
  CHECK_FALSE(guard.allows(patch(0.5, 0), {{Vec3(0.5, 0.5, 0), Vec3(1, 0, 0), Vec3(0, 0, 0)}}));  // faces the other way
  CHECK_FALSE(guard.allows({SurfaceTree(square).corners(0)}, {{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 0.3, 0)}}));
}

}  // namespace
}  // namespace heml::improve_operations_test
