#include "app/render/smooth_surface.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "shapes.hpp"

namespace heml::smooth_surface_test {

using namespace heml::render;

namespace {

float volume(const SmoothSurface& surface) {
  double sum = 0;
  const auto& p = surface.positions();
  const auto& t = surface.triangles();
  for (std::size_t i = 0; i < t.size(); i += 3) sum += p[t[i]].dot(p[t[i + 1]].cross(p[t[i + 2]])) / 6;
  return static_cast<float>(sum);
}

}  // namespace

TEST_CASE("normals at the nodes of a sphere are radial") {
  const SmoothSurface surface(ball_surface(2, 0.05f), 3);
  for (std::size_t c = 0; c < surface.topology().corner_nodes.size(); ++c)
    CHECK((surface.normals()[c] - surface.positions()[c].normalized()).norm() < 1e-5f);
}

TEST_CASE("curved patches go through the nodes") {
  const SurfaceMesh surface_mesh = ball_surface(1, 0.05f);
  SmoothSurface surface(surface_mesh, 4);
  std::vector<Vec3f> moved = surface_mesh.rest;
  for (Vec3f& node : moved) node = Vec3f(node.x() + 0.3f * node.y(), 1.4f * node.y(), node.z() + 0.01f);
  surface.update(moved);
  const std::vector<int>& nodes = surface.topology().corner_nodes;
  REQUIRE(nodes.size() == surface_mesh.rest.size());
  for (std::size_t c = 0; c < nodes.size(); ++c) CHECK(surface.positions()[c] == moved[nodes[c]]);
}

TEST_CASE("the curved patch of an icosahedron's face is where the paper's formulas put it") {
  const SurfaceMesh surface_mesh = ball_surface(0, 1);
  const SmoothSurface curved(surface_mesh, 3), flat(surface_mesh, 1);
  // Heights along the face's axis: nodes h; control points of edges, (2P + Q − ((Q − P)·P) P)/3 with Q·P = 1/√5:
  // (4 − 1/√5)/3·h; the inner control point: E + (E − V)/2. The patch's centre weights nodes, edges, inside by 3:18:6.
  const float h = 0.794654f;
  const float edge = (4 - 1 / std::sqrt(5.0f)) / 3 * h, inside = edge + (edge - h) / 2;
  const float middle = (3 * h + 18 * edge + 6 * inside) / 27;
  int middles = 0;
  for (std::size_t p = 0; p < curved.blends().size(); ++p)
    if (curved.blends()[p].weights[2] > 0) {
      CHECK(curved.positions()[p].norm() == doctest::Approx(middle).epsilon(1e-5));
      CHECK(curved.normals()[p].dot(curved.positions()[p].normalized()) == doctest::Approx(1));
      ++middles;
    }
  CHECK(middles == 20);
  CHECK(volume(flat) == doctest::Approx(2.53615).epsilon(1e-4));  // icosahedron of circumradius 1
  CHECK(volume(curved) > 3.3f);                                   // ball: 4.19
}

TEST_CASE("patches meet without gaps") {
  const SmoothSurface surface(ball_surface(1, 1), 3);
  // In a closed surface every edge occurs once in each direction.
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  const auto& t = surface.triangles();
  for (std::size_t i = 0; i < t.size(); ++i) ++edges[{t[i], t[i % 3 == 2 ? i - 2 : i + 1]}];
  CHECK(t.size() == 3 * 80 * 9);
  for (const auto& [edge, count] : edges) {
    CHECK(count == 1);
    CHECK(edges.count({edge.second, edge.first}) == 1);
  }
}

TEST_CASE("a cube keeps flat faces and sharp edges") {
  const SurfaceMesh surface_mesh = cube_surface();
  const SmoothSurface surface(surface_mesh, 3);
  CHECK(surface.topology().corner_nodes.size() == 24);  // every node once per face
  for (std::size_t p = 0; p < surface.positions().size(); ++p) {
    CHECK(surface.positions()[p].cwiseAbs().maxCoeff() == doctest::Approx(0.5f));
    CHECK(surface.normals()[p].cwiseAbs().maxCoeff() == doctest::Approx(1.0f));
  }
  CHECK(volume(surface) == doctest::Approx(1));
}

TEST_CASE("values spread linearly over triangles") {
  const SurfaceMesh surface_mesh = ball_surface(1, 1);
  const SmoothSurface surface(surface_mesh, 3);
  std::vector<float> values, spread;
  for (const Vec3f& node : surface_mesh.rest) values.push_back(2 * node.x() - node.z() + 1);
  surface.spread(std::span<const float>(values), spread);
  for (std::size_t p = 0; p < spread.size(); ++p) {
    const auto& [corners, weights] = surface.blends()[p];
    Vec3f place = Vec3f::Zero();
    for (int k = 0; k < 3; ++k) place += weights[k] * surface_mesh.rest[surface.topology().corner_nodes[corners[k]]];
    CHECK(spread[p] == doctest::Approx(2 * place.x() - place.z() + 1).epsilon(1e-5));
  }
}

TEST_CASE("degenerate triangles give finite surfaces") {
  SurfaceMesh surface_mesh = ball_surface(1, 1);
  SmoothSurface surface(surface_mesh, 3);
  const std::vector<Vec3f> collapsed(surface_mesh.rest.size(), Vec3f(1, 2, 3));
  surface.update(collapsed);
  for (std::size_t p = 0; p < surface.positions().size(); ++p) {
    CHECK(surface.positions()[p].isApprox(Vec3f(1, 2, 3)));
    CHECK(surface.normals()[p].allFinite());
  }
}

}  // namespace heml::smooth_surface_test
