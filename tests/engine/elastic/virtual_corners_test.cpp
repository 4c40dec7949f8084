// Quadratic tetrahedra against ten-node shape functions and full deformation gradients, computed here.
#include <doctest/doctest.h>

#include <heml/elastic/body.hpp>
#include <heml/materials/point.hpp>

#include "quadratic_body.hpp"

namespace heml::virtual_corners_test {

using test::highest_eigenvalue;
using test::largest;
using test::QuadraticBody;
using test::sample_material;

/// Gradients by ξ of the ten shape functions on the unit tetrahedron, λ0 = 1 − ξ1 − ξ2 − ξ3.
Eigen::Matrix<double, 10, 3> shape_gradients(const Vec3& xi) {
  const double lambda[4] = {1 - xi.sum(), xi[0], xi[1], xi[2]};
  const Vec3 d[4] = {-Vec3::Ones(), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  Eigen::Matrix<double, 10, 3> result;
  for (int a = 0; a < 4; ++a) result.row(a) = (4 * lambda[a] - 1) * d[a];
  const int ends[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
  for (int e = 0; e < 6; ++e)
    result.row(4 + e) = 4 * (lambda[ends[e][0]] * d[ends[e][1]] + lambda[ends[e][1]] * d[ends[e][0]]);
  return result;
}

std::array<Vec3, 4> gauss_points() {
  const double a = (5 - std::sqrt(5)) / 20, b = (5 + 3 * std::sqrt(5)) / 20;
  return {Vec3(a, a, a), Vec3(b, a, a), Vec3(a, b, a), Vec3(a, a, b)};
}

/// Energy and forces by the textbook: F = Σ x_a ⊗ ∇N_a, P from the law at a point.
double reference(const QuadraticBody& body, const Material& material, std::vector<double>& f) {
  const auto point = make_material_point(material, false);
  f.assign(body.x.size(), 0.0);
  double energy = 0;
  for (std::size_t t = 0; t < body.mesh.tets.size(); ++t) {
    const auto nodes = quadratic_nodes(body.mesh.tets[t], body.midedges[t]);
    for (const Vec3& xi : gauss_points()) {
      const auto dN = shape_gradients(xi);
      Mat3 Dm = Mat3::Zero(), Ds = Mat3::Zero();
      for (int a = 0; a < 10; ++a) {
        Dm += body.mesh.nodes[static_cast<std::size_t>(nodes[static_cast<std::size_t>(a)])] * dN.row(a);
        Ds += body.at(nodes[static_cast<std::size_t>(a)]) * dN.row(a);
      }
      const Mat3 F = Ds * Dm.inverse();
      const double weight = Dm.determinant() / 24;
      energy += weight * point->energy(F);
      const Mat3 stress = weight * point->first_piola(F) * Dm.inverse().transpose();
      for (int a = 0; a < 10; ++a)
        Eigen::Map<Vec3>(&f[3 * static_cast<std::size_t>(nodes[static_cast<std::size_t>(a)])]) -=
            stress * dN.row(a).transpose();
    }
  }
  return energy;
}

TEST_CASE("forces and energy of quadratic elements equal those of ten-node shape functions") {
  std::mt19937_64 random(31);
  ThreadTeam team(1), many(3);
  for (const auto law : test::law_names())
    for (const bool curved : {false, true}) {
      CAPTURE(std::string(law));
      CAPTURE(curved);
      const QuadraticBody small(random, 0.05, curved);
      const Material material = sample_material(law);
      auto body = small.of(material);
      std::vector<double> f(small.x.size()), again(f.size()), expected;
      const double energy = reference(small, material, expected);
      CHECK(body->forces(small.x.data(), f.data(), team));
      CHECK(body->energy(small.x.data(), team) == doctest::Approx(energy).epsilon(1e-10));
      for (std::size_t i = 0; i < f.size(); ++i) CHECK(std::abs(f[i] - expected[i]) <= 1e-10 * largest(expected));
      body->forces(small.x.data(), again.data(), many);
      CHECK(f == again);
    }
}

TEST_CASE("quadratic elements: forces are minus the gradient of the energy, stiffness that of the forces") {
  std::mt19937_64 random(32);
  for (const auto law : test::law_names()) {
    CAPTURE(std::string(law));
    const QuadraticBody small(random, 0.05, true);
    auto body = small.of(sample_material(law));
    CHECK(test::gradient_error(*body, small.x) <= 1e-6);
    CHECK(test::stiffness_error(*body, small.x, random) <= 1e-5);
  }
}

TEST_CASE("stiffnesses of quadratic elements add up to the stiffness") {
  std::mt19937_64 random(33);
  ThreadTeam team(1);
  const QuadraticBody small(random, 0.05);
  auto body = small.of(sample_material("neo_hookean"));
  std::vector<double> dx(small.x.size()), sum(small.x.size(), 0.0), change(small.x.size());
  for (double& d : dx) d = test::uniform(random, -1, 1);
  body->linearise(small.x.data(), team);
  int seen = 0;
  body->each_stiffness([&](const auto& node, const auto& K) {
    if constexpr (std::tuple_size_v<std::decay_t<decltype(node)>> == 10) ++seen;
    const std::size_t entries = 3 * node.size();
    for (std::size_t r = 0; r < entries; ++r)
      for (std::size_t c = 0; c < entries; ++c)
        sum[3 * static_cast<std::size_t>(node[r / 3]) + r % 3] -=
            K[r][c] * dx[3 * static_cast<std::size_t>(node[c / 3]) + c % 3];
  });
  CHECK(seen == static_cast<int>(small.mesh.tets.size()));
  body->force_differential(dx.data(), change.data(), team);
  for (std::size_t i = 0; i < sum.size(); ++i) CHECK(std::abs(sum[i] - change[i]) <= 1e-11 * largest(change));
}

TEST_CASE("quadratic elements reproduce a homogeneous deformation and a quadratic field") {
  std::mt19937_64 random(34);
  ThreadTeam team(1);
  QuadraticBody small(random, 0);
  const Mat3 F = test::random_gradient(random, 0.8, 1.3);
  const auto put = [&](const auto& map) {
    for (std::size_t n = 0; n < small.mesh.nodes.size(); ++n)
      Eigen::Map<Vec3>(&small.x[3 * n]) = map(small.mesh.nodes[n]);
  };
  auto body = small.of(sample_material("neo_hookean"));
  put([&](const Vec3& X) { return Vec3(F * X + Vec3(1, 2, 3)); });
  for (const Mat3& at : body->deformation_gradients(small.x.data())) CHECK((at - F).norm() <= 1e-12);
  std::vector<ElementState<double>> states;
  body->states(small.x.data(), states);
  CHECK(states.size() == 4 * small.mesh.tets.size());
  for (const auto& s : states) CHECK(s.J == doctest::Approx(F.determinant()).epsilon(1e-12));

  // x = X + (b·X) (c·X) d, of gradient I + d ⊗ ((c·X) b + (b·X) c)
  const Vec3 b(1, 2, -1), c(0.5, 1, 2), d(0.3, -0.4, 0.5);
  put([&](const Vec3& X) { return Vec3(X + b.dot(X) * c.dot(X) * d); });
  const auto gradients = body->deformation_gradients(small.x.data());
  for (std::size_t t = 0; t < small.mesh.tets.size(); ++t)
    for (std::size_t q = 0; q < 4; ++q) {
      Vec3 X = Vec3::Zero();
      for (std::size_t i = 0; i < 4; ++i)
        X += point_coordinate(q, i) * small.mesh.nodes[static_cast<std::size_t>(small.mesh.tets[t][i])];
      const Mat3 exact = Mat3::Identity() + d * (c.dot(X) * b + b.dot(X) * c).transpose();
      CHECK((gradients[4 * t + q] - exact).norm() <= 1e-12);
    }
}

TEST_CASE("masses of quadratic elements are positive and consistent ones integrate linear fields") {
  std::mt19937_64 random(35);
  for (const bool curved : {false, true}) {
    const QuadraticBody small(random, 0, curved);
    auto body = small.of(sample_material("neo_hookean"));
    const auto lumped = body->masses(), consistent = body->consistent_masses();
    double all = 0, sum = 0;
    Vec3 moment = Vec3::Zero(), expected = Vec3::Zero();
    for (std::size_t n = 0; n < lumped.size(); ++n) {
      CHECK(lumped[n] > 0);
      all += lumped[n];
      sum += consistent[n];
      moment += consistent[n] * small.mesh.nodes[n];
    }
    CHECK(all == doctest::Approx(sum).epsilon(1e-12));
    if (curved) continue;
    double volume = 0;
    for (const Tet& tet : small.mesh.tets) {
      const auto X = [&](std::size_t a) { return small.mesh.nodes[static_cast<std::size_t>(tet[a])]; };
      const double V = signed_volume(X(0), X(1), X(2), X(3));
      volume += V;
      expected += V * (X(0) + X(1) + X(2) + X(3)) / 4;
    }
    const double density = sample_material("neo_hookean").density;
    CHECK(all == doctest::Approx(density * volume).epsilon(1e-12));
    CHECK((moment - density * expected).norm() <= 1e-12 * moment.norm());
  }
}

TEST_CASE("the frequency bound of quadratic elements bounds the highest eigenvalue, and not by much") {
  std::mt19937_64 random(36);
  ThreadTeam team(1);
  for (const auto law : {"neo_hookean", "ogden", "mooney_rivlin"}) {
    CAPTURE(law);
    const QuadraticBody small(random, 0.03);
    auto body = small.of(sample_material(law));
    const double highest = highest_eigenvalue(*body, small.x);
    const double bound = body->frequency_bound(small.x.data(), team);
    CHECK(bound >= highest);
    CHECK(bound <= 4 * highest);
  }
}

TEST_CASE("quadratic elements remember a viscous stress at every point") {
  std::mt19937_64 random(37);
  ThreadTeam team(1);
  const QuadraticBody small(random, 0.05);
  Material material = sample_material("neo_hookean");
  material.viscosity = 20;
  auto body = small.of(material);
  body->begin_step(0.01);
  CHECK(test::gradient_error(*body, small.x) <= 1e-6);
  body->commit(small.x.data());
  auto snapshot = body->snapshot();
  auto other = small.of(material);
  other->restore_all(snapshot, small.x.data());
  std::vector<double> f(small.x.size()), g(small.x.size());
  body->forces(small.x.data(), f.data(), team);
  other->forces(small.x.data(), g.data(), team);
  CHECK(f == g);
}

}  // namespace heml::virtual_corners_test
