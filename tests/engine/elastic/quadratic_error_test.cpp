// The estimate of the error of quadratic tetrahedra against known errors.
#include <doctest/doctest.h>

#include <cmath>
#include <heml/elastic/error_estimate.hpp>
#include <heml/elastic/quadratic_error.hpp>
#include <heml/mesh/subdivide.hpp>
#include <numbers>

#include "quadratic_body.hpp"

namespace heml::quadratic_error_test {

using namespace heml::test;

namespace {

constexpr double lambda = 2e3, mu = 1e3;
constexpr double small = 1e-5;  // small strains, so that the law is linear

double product(const Mat3& A, const Mat3& B) {
  const Mat3 a = (A + A.transpose()) / 2, b = (B + B.transpose()) / 2;
  return lambda * a.trace() * b.trace() + 2 * mu * a.cwiseProduct(b).sum();
}

/// A displacement with strains of all degrees, and its gradient.
Vec3 wave(const Vec3& X) {
  return small * Vec3(std::sin(20 * X.x()) * std::cos(15 * X.y()), std::sin(18 * X.z() + 10 * X.x()),
                      std::cos(17 * X.y() + 5 * X.z()));
}
Mat3 wave_gradient(const Vec3& X) {
  Mat3 H;
  H << 20 * std::cos(20 * X.x()) * std::cos(15 * X.y()), -15 * std::sin(20 * X.x()) * std::sin(15 * X.y()), 0,
      10 * std::cos(18 * X.z() + 10 * X.x()), 0, 18 * std::cos(18 * X.z() + 10 * X.x()), 0,
      -17 * std::sin(17 * X.y() + 5 * X.z()), -5 * std::sin(17 * X.y() + 5 * X.z());
  return small * H;
}

struct Comparison {
  double relative, effectivity;
};

/// Of the interpolant in a mesh whose edges get middles. The error itself is summed over the points of the 8³ parts
/// of each element.
Comparison compare(const TetMesh& corners) {
  TetMesh mesh = corners;
  const MidEdges midedges = add_midedge_nodes(mesh);
  std::vector<double> x;
  for (const Vec3& X : mesh.nodes) {
    const Vec3 at = X + wave(X);
    x.insert(x.end(), {at.x(), at.y(), at.z()});
  }
  const std::vector<int> material_of(mesh.tets.size(), 0);
  ElasticBody<double> body(mesh, material_of, {Material{"neo_hookean", {lambda, mu}}}, {}, midedges);
  ThreadTeam team(1);
  const auto F = body.deformation_gradients(x.data());
  ErrorEstimate estimate;
  estimate.of_element = quadratic_recovery_errors(mesh, material_of, F, body.stresses(x.data(), team));
  for (const double e : estimate.of_element) estimate.squared += e;
  estimate.stored = body.energy(x.data(), team);
  double error = 0;
  constexpr double near = point_coordinate(0, 0), far = point_coordinate(0, 1);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    std::array<Vec3, 4> X;
    for (std::size_t c = 0; c < 4; ++c) X[c] = mesh.nodes[static_cast<std::size_t>(mesh.tets[t][c])];
    TetMesh parts;
    parts.nodes.assign(X.begin(), X.end());
    parts.tets = {{0, 1, 2, 3}};
    parts.regions = {0};
    for (int k = 0; k < 3; ++k) parts = subdivide_uniformly(parts).mesh;
    Mat3 D;
    D << X[1] - X[0], X[2] - X[0], X[3] - X[0];
    for (const Tet& part : parts.tets) {
      const auto at = [&](std::size_t c) { return parts.nodes[static_cast<std::size_t>(part[c])]; };
      const Vec3 middle = (at(0) + at(1) + at(2) + at(3)) / 4, inside = D.inverse() * (middle - X[0]);
      const std::array<double, 4> place{1 - inside.sum(), inside.x(), inside.y(), inside.z()};
      Mat3 d = Mat3::Identity() + wave_gradient(middle);  // F is linear through the four points
      for (std::size_t q = 0; q < 4; ++q) d -= (place[q] - far) / (near - far) * F[4 * t + q];
      error += signed_volume(at(0), at(1), at(2), at(3)) * product(d, d);
    }
  }
  return {estimate.relative(), std::sqrt(estimate.squared / error)};
}

}  // namespace

TEST_CASE("quadratic elements: fields that are linear in space show no error, fields of parts of a body neither") {
  std::mt19937_64 random(6);
  const QuadraticBody body(random, 0);
  std::vector<int> material_of(body.mesh.tets.size(), 0);
  for (std::size_t t = 0; t < material_of.size() / 2; ++t) material_of[t] = 1;
  std::array<Mat3, 4> f;
  for (Mat3& part : f) part = random_gradient(random, 0.5, 2);
  std::vector<Mat3> F, P;
  for (std::size_t t = 0; t < body.mesh.tets.size(); ++t)
    for (std::size_t q = 0; q < 4; ++q) {
      Vec3 X = Vec3::Zero();
      for (std::size_t c = 0; c < 4; ++c)
        X += point_coordinate(q, c) * body.mesh.nodes[static_cast<std::size_t>(body.mesh.tets[t][c])];
      F.push_back(f[0] + X.x() * f[1] + X.y() * f[2] + X.z() * f[3]);
      P.push_back((material_of[t] + 2) * F.back());  // stress jumps between the materials
    }
  for (const double e : quadratic_recovery_errors(body.mesh, material_of, F, P)) CHECK(e <= 1e-12 * 1e-5);
}

TEST_CASE("quadratic elements: of smooth deformations the estimate is near the error, and falls with its square") {
  TetMesh mesh = make_box(Vec3(0.1, 0.05, 0.05), {4, 2, 2});
  double before = 0;
  for (int halvings = 0; halvings < 3; ++halvings) {
    if (halvings > 0) mesh = subdivide_uniformly(mesh).mesh;
    const Comparison found = compare(mesh);
    MESSAGE("relative error " << found.relative << ", effectivity " << found.effectivity);
    CHECK(found.effectivity > 0.8);
    CHECK(found.effectivity < 1.3);
    if (halvings == 1) CHECK(found.relative < 0.4 * before);
    if (halvings == 2) CHECK(found.relative < 0.28 * before);  // a quarter in the limit
    before = found.relative;
  }
}

}  // namespace heml::quadratic_error_test
