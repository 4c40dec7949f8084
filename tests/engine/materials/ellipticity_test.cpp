#include <doctest/doctest.h>

#include <algorithm>
#include <heml/materials/ellipticity.hpp>
#include <heml/materials/material.hpp>
#include <heml/materials/point.hpp>

namespace heml::ellipticity_test {

namespace {

constexpr double mu = 1e4 / 2.6, lambda = 1e4 * 0.3 / (1.3 * 0.4);

double lowest(const char* law, const Mat3& F) {
  const auto point = make_material_point({law, {lambda, mu}, 1000}, false);
  return min_acoustic_eigenvalue([&](const Mat3& dF) { return point->first_piola_differential(F, dF); });
}

Mat3 stretched(double x, double y, double z) { return Vec3(x, y, z).asDiagonal(); }

}  // namespace

TEST_CASE("ellipticity: at rest the lowest eigenvalue is the shear modulus") {
  for (const char* law : {"stvk", "neo_hookean"})
    CHECK(lowest(law, Mat3::Identity()) == doctest::Approx(mu).epsilon(1e-6));
}

TEST_CASE("ellipticity: pressed along one axis StVK loses it, first along oblique waves, and neo-Hookean never") {
  CHECK(lowest("stvk", stretched(0.72, 1, 1)) > 0);
  CHECK(lowest("stvk", stretched(0.69, 1, 1)) < 0);
  for (const double s : {0.72, 0.69, 0.6, 0.5}) {
    const double along = (lambda + 2 * mu) * (3 * s * s - 1) / 2, across = (lambda + 2 * mu) * (s * s - 1) / 2 + mu;
    CHECK(lowest("stvk", stretched(s, 1, 1)) <= std::min(along, across));  // closed forms of waves along the axis
  }
  for (const double s : {0.8, 0.5, 0.2, 0.05}) CHECK(lowest("neo_hookean", stretched(s, 1, 1)) > 0);
}

TEST_CASE("ellipticity: springs along the edges of a cube lose it under pressure") {
  const Vec3 edges[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}};
  const auto net = [&](double s) {
    return min_acoustic_eigenvalue([&](const Mat3& dF) {
      Mat3 sum = Mat3::Zero();
      for (const Vec3& edge : edges) sum += spring_tangent(2, edge, 1, stretched(s, s, s), dF);
      return sum;
    });
  };
  CHECK(net(1) > 0);
  CHECK(net(0.5) < 0);
}

}  // namespace heml::ellipticity_test
