#include <doctest/doctest.h>

#include <heml/mesh/embedding.hpp>
#include <heml/mesh/generate.hpp>

#include "support.hpp"

namespace heml::embedding_test {

namespace {

std::vector<Vec3> random_points(int count, double reach) {
  std::mt19937_64 random(5);
  std::vector<Vec3> points;
  for (int k = 0; k < count; ++k) points.push_back(Vec3::Constant(0.5) + test::random_vector(random, reach));
  return points;
}

std::vector<Vec3> moved(const std::vector<Vec3>& nodes, const auto& map) {
  std::vector<Vec3> result;
  for (const Vec3& x : nodes) result.push_back(map(x));
  return result;
}

/// Of a point with float weights, by double positions.
Vec3 place(const Embedding& embedding, std::size_t p, const std::vector<Vec3>& nodes) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < 4; ++i)
    sum += static_cast<double>(embedding.weights[p][i]) * nodes[static_cast<std::size_t>(embedding.nodes[p][i])];
  return sum;
}

}  // namespace

TEST_CASE("embedded points follow an affine motion of the body, inside and outside of it") {
  const TetMesh mesh = make_box(Vec3::Ones(), {4, 3, 2});
  const std::vector<Vec3> points = random_points(2000, 0.8);
  const Embedding embedding = embed(points, mesh);
  Mat3 A;
  A << 1.2, 0.3, -0.1, 0.2, 0.9, 0.4, -0.3, 0.1, 1.1;
  const auto affine = [&](const Vec3& x) { return Vec3(A * x + Vec3(3, -2, 1)); };
  const std::vector<Vec3> nodes = moved(mesh.nodes, affine);
  int outside = 0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    CHECK((place(embedding, p, mesh.nodes) - points[p]).norm() < 1e-6);
    CHECK((place(embedding, p, nodes) - affine(points[p])).norm() < 2e-6);
    const bool is_inside = (points[p].array() >= 0).all() && (points[p].array() <= 1).all();
    outside += !is_inside;
    for (const float w : embedding.weights[p])
      if (is_inside) CHECK((w > -1e-6f && w < 1 + 1e-6f));
  }
  CHECK(outside > 500);
  CHECK(outside < 1900);
}

TEST_CASE("the farthest distance is that of the point farthest from the body") {
  const TetMesh mesh = make_box(Vec3::Ones(), {2, 2, 2});
  CHECK(embed(std::vector<Vec3>{{0.5, 0.5, 0.5}, {1, 1, 1}}, mesh).farthest == 0);
  CHECK(embed(std::vector<Vec3>{{0.5, 0.5, 1.25}, {1, 0.5, 0.2}}, mesh).farthest == doctest::Approx(0.25));
  CHECK(embed(std::vector<Vec3>{}, mesh).size() == 0);
}

TEST_CASE("a surface through the body stays in one piece in any deformation") {
  // Points close to each other, on both sides of faces between tetrahedra.
  const TetMesh mesh = make_box(Vec3::Ones(), {3, 3, 3});
  std::mt19937_64 random(6);
  std::vector<Vec3> points;
  for (int k = 0; k < 500; ++k) {
    points.push_back(Vec3::Constant(0.5) + test::random_vector(random, 0.5));
    points.push_back(points.back() + test::random_vector(random, 1e-5));
  }
  const Embedding embedding = embed(points, mesh);
  const std::vector<Vec3> nodes =
      moved(mesh.nodes, [&](const Vec3& x) { return Vec3(x + test::random_vector(random, 0.1)); });
  for (std::size_t p = 0; p < points.size(); p += 2)
    CHECK((place(embedding, p, nodes) - place(embedding, p + 1, nodes)).norm() < 1e-4);
}

}  // namespace heml::embedding_test
