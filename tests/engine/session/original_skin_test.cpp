#include <doctest/doctest.h>

#include <heml/session/original_skin.hpp>

#include "cut_body.hpp"

namespace heml::original_skin_test {

namespace {

float area(const SurfaceMesh& surface_mesh, const Triangle& t) {
  return (surface_mesh.rest[t[1]] - surface_mesh.rest[t[0]])
             .cross(surface_mesh.rest[t[2]] - surface_mesh.rest[t[0]])
             .norm() /
         2;
}

}  // namespace

TEST_CASE("the faces inside a box are the exposed ones and the rest have the area of the skin") {
  const CutBody body;
  const OriginalSkin skin(*body.cut);
  REQUIRE(skin.exposed().size() == body.cut->triangles.size());
  double exposed = 0, original = 0;
  for (std::size_t t = 0; t < skin.exposed().size(); ++t) {
    const Triangle& triangle = body.cut->triangles[t];
    const Vec3f middle = (body.cut->rest[triangle[0]] + body.cut->rest[triangle[1]] + body.cut->rest[triangle[2]]) / 3;
    const float inside = std::min(middle.minCoeff(), (Vec3f::Constant(0.08f) - middle).minCoeff());
    CHECK((skin.exposed()[t] != 0) == (inside > 1e-6f));
    (skin.exposed()[t] ? exposed : original) += area(*body.cut, triangle);
  }
  CHECK(original == doctest::Approx(6 * 0.0064).epsilon(1e-4));
  CHECK(exposed == doctest::Approx(2 * 0.08 * 0.039).epsilon(0.2));  // both sides of the cut
}

TEST_CASE("the depth of a point is its distance from the skin, and its place interpolates the skin there") {
  const CutBody body;
  const OriginalSkin skin(*body.cut);
  for (std::size_t n = 0; n < skin.places().size(); ++n) {
    const Vec3f& rest = body.cut->rest[n];
    const float depth = std::min(rest.minCoeff(), (Vec3f::Constant(0.08f) - rest).minCoeff());
    CHECK(skin.places()[n].depth == doctest::Approx(std::max(0.0f, depth)).epsilon(1e-3));
    Vec3f place = Vec3f::Zero();
    for (std::size_t k = 0; k < 3; ++k)
      place += skin.places()[n].weights[k] * body.whole->rest[skin.places()[n].nodes[k]];
    CHECK((place - rest).norm() == doctest::Approx(skin.places()[n].depth).epsilon(1e-3));
  }
}

}  // namespace heml::original_skin_test
