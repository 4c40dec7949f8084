// The estimate of the discretisation error against known errors.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <heml/elastic/error_estimate.hpp>
#include <heml/materials/point.hpp>
#include <heml/mesh/subdivide.hpp>

#include "small_body.hpp"

namespace heml::error_estimate_test {

using namespace heml::test;

namespace {

constexpr double lambda = 2e3, mu = 1e3;
constexpr double small = 1e-5;  // small strains, so that the law is linear

/// A displacement that is quadratic in the rest position, and its gradient.
struct Displacement {
  std::function<Vec3(const Vec3&)> u;
  std::function<Mat3(const Vec3&)> gradient;
};

/// Pure bending of curvature c about z, with Poisson's effect.
Displacement bending() {
  const double c = small * 10, nu = lambda / (2 * (lambda + mu));
  return {[=](const Vec3& X) -> Vec3 {
            return c *
                   Vec3(-X.x() * X.y(), (X.x() * X.x() + nu * (X.y() * X.y() - X.z() * X.z())) / 2, nu * X.y() * X.z());
          },
          [=](const Vec3& X) {
            Mat3 H;
            H << -X.y(), -X.x(), 0, X.x(), nu * X.y(), -nu * X.z(), 0, nu * X.z(), nu * X.y();
            return Mat3(c * H);
          }};
}

/// A hanging bar with constrained sides: the strain varies linearly along it.
Displacement hanging() {
  const double c = small * 10;
  return {[=](const Vec3& X) -> Vec3 { return c * Vec3(X.x() * (0.2 - X.x()), 0, 0); },
          [=](const Vec3& X) {
            Mat3 H = Mat3::Zero();
            H(0, 0) = c * (0.2 - 2 * X.x());
            return H;
          }};
}

double strain_energy_product(const Mat3& A, const Mat3& B) {
  const Mat3 a = (A + A.transpose()) / 2, b = (B + B.transpose()) / 2;
  return lambda * a.trace() * b.trace() + 2 * mu * a.cwiseProduct(b).sum();
}

/// ‖u − u_h‖² in the energy norm, J, u_h the interpolant. Gradients are linear, so corner values integrate it exactly.
double true_error(const TetMesh& mesh, const std::vector<Mat3>& F, const Displacement& exact) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto X = [&](std::size_t a) { return mesh.nodes[static_cast<std::size_t>(mesh.tets[t][a])]; };
    const double volume = signed_volume(X(0), X(1), X(2), X(3));
    Mat3 d[4];
    for (std::size_t a = 0; a < 4; ++a) d[a] = exact.gradient(X(a)) - (F[t] - Mat3::Identity());
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b) sum += volume / 20 * (a == b ? 2 : 1) * strain_energy_product(d[a], d[b]);
  }
  return sum;
}

struct Comparison {
  double relative, effectivity;
};

Comparison compare(const TetMesh& mesh, const Displacement& exact) {
  std::vector<Vec3> x;
  std::vector<double> flat;
  for (const Vec3& X : mesh.nodes) {
    x.push_back(X + exact.u(X));
    for (const double value : x.back()) flat.push_back(value);
  }
  const std::vector<int> material_of(mesh.tets.size(), 0);
  ElasticBody<double> body(mesh, material_of, {Material{"neo_hookean", {lambda, mu}}}, {});
  ThreadTeam team(1);
  const auto F = deformation_gradients(mesh, x);
  ErrorEstimate estimate;
  estimate.of_element = recovery_errors(mesh, material_of, F, body.stresses(flat.data(), team));
  for (const double e : estimate.of_element) estimate.squared += e;
  estimate.stored = body.energy(flat.data(), team);
  return {estimate.relative(), std::sqrt(estimate.squared / true_error(mesh, F, exact))};
}

}  // namespace

TEST_CASE("stresses of elements are those of their law at their deformation, with nodal pressure too") {
  std::mt19937_64 random(5);
  const Mat3 F = (Mat3() << 1.1, 0.2, 0, 0.05, 0.9, 0.1, 0, -0.1, 1.2).finished();
  const SmallBody body(random, 0, F, Vec3(1, 2, 3));
  ThreadTeam team(1);
  for (const std::string_view law : law_names()) {
    CAPTURE(law);
    const Material material = sample_material(law);
    if (!material.fibre.isZero() || !material.fibre_field.empty()) continue;
    const Mat3 expected = make_material_point(material, false)->first_piola(F);
    for (const bool nodal : {false, true}) {
      if (nodal && !find_law(law)->has_volume_term) continue;
      for (const Mat3& P : body.of(material, false, nodal)->stresses(body.x.data(), team))
        CHECK((P - expected).norm() <= 1e-9 * expected.norm());
    }
  }
}

TEST_CASE("patch test: a body of one deformation shows no error, of whatever materials") {
  std::mt19937_64 random(6);
  const SmallBody body(random, 0, (Mat3() << 1.3, 0.2, 0, 0.1, 0.9, 0.1, 0, 0, 0.8).finished());
  std::vector<int> material_of(body.mesh.tets.size(), 0);
  for (std::size_t t = 0; t < material_of.size() / 2; ++t) material_of[t] = 1;
  ElasticBody<double> two(body.mesh, material_of,
                          {Material{"neo_hookean", {lambda, mu}}, Material{"neo_hookean", {90 * lambda, 90 * mu}}}, {});
  ThreadTeam team(1);
  std::vector<Vec3> x;
  for (std::size_t n = 0; n < body.mesh.nodes.size(); ++n)
    x.emplace_back(body.x[3 * n], body.x[3 * n + 1], body.x[3 * n + 2]);
  const auto F = deformation_gradients(body.mesh, x);
  const auto errors = recovery_errors(body.mesh, material_of, F, two.stresses(body.x.data(), team));
  CHECK(largest(errors) <= 1e-24 * two.energy(body.x.data(), team));
}

TEST_CASE("where F and P vary linearly their fits have their values, at the surface and its corners too") {
  std::mt19937_64 random(7);
  const TetMesh mesh = irregular_box(random, {4, 3, 2});
  const auto number = [&] { return uniform(random, -1, 1); };
  std::array<Mat3, 4> f, p;  // F(X) = f[0] + Σ X_i f[i + 1]
  for (std::size_t k = 0; k < 4; ++k) {
    f[k] = Mat3::NullaryExpr(number);
    p[k] = f[k] * 3;  // of a law P = 3 F, so that the estimate is a square
  }
  const auto value = [](const std::array<Mat3, 4>& of, const Vec3& X) {
    return Mat3(of[0] + X.x() * of[1] + X.y() * of[2] + X.z() * of[3]);
  };
  std::vector<Mat3> F, P;
  std::vector<double> expected;
  for (const Tet& tet : mesh.tets) {
    std::array<Vec3, 4> X;
    for (std::size_t a = 0; a < 4; ++a) X[a] = mesh.nodes[static_cast<std::size_t>(tet[a])];
    const Vec3 middle = (X[0] + X[1] + X[2] + X[3]) / 4;
    F.push_back(value(f, middle));
    P.push_back(value(p, middle));
    double sum = 0;  // ∫ over the element of a square of a linear field: V/20 (Σ d_a² + (Σ d_a)²), Σ d_a = 0
    for (const Vec3& corner : X) sum += 3 * (value(f, corner) - F.back()).squaredNorm();
    expected.push_back(signed_volume(X[0], X[1], X[2], X[3]) / 20 * sum);
  }
  const auto errors = recovery_errors(mesh, std::vector<int>(mesh.tets.size(), 0), F, P);
  for (std::size_t t = 0; t < errors.size(); ++t) CHECK(errors[t] == doctest::Approx(expected[t]).epsilon(1e-3));
}

TEST_CASE("of one element alone, and of one a material, nothing can be estimated") {
  TetMesh mesh;
  mesh.nodes = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 1, 1)};
  mesh.tets = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  if (signed_volume(mesh.nodes[1], mesh.nodes[2], mesh.nodes[3], mesh.nodes[4]) < 0)
    std::swap(mesh.tets[1][0], mesh.tets[1][1]);
  const std::vector<Mat3> F = {Mat3::Identity(), 2 * Mat3::Identity()};
  CHECK(recovery_errors(mesh, {0, 1}, F, F) == std::vector<double>{0, 0});
}

TEST_CASE("of smooth deformations the estimate is 0.9 to 1.3 of the error, and falls with the edges") {
  for (const Displacement& exact : {bending(), hanging()}) {
    TetMesh mesh = make_box(Vec3(0.1, 0.05, 0.05), {4, 2, 2});
    double before = 0;
    for (int halvings = 0; halvings < 3; ++halvings) {
      if (halvings > 0) mesh = subdivide_uniformly(mesh).mesh;
      const Comparison found = compare(mesh, exact);
      CAPTURE(halvings);
      CAPTURE(found.effectivity);
      CHECK(found.effectivity > 0.9);
      CHECK(found.effectivity < 1.3);
      if (halvings > 0) CHECK(found.relative < 0.7 * before);
      before = found.relative;
    }
  }
}

}  // namespace heml::error_estimate_test
