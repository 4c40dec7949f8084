#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <heml/elastic/mass_scaling.hpp>
#include <limits>
#include <numeric>

#include "quadratic_body.hpp"
#include "small_body.hpp"

namespace heml::mass_scaling_test {

using namespace heml::test;

namespace {

double added(const std::vector<double>& factors, const std::vector<double>& masses) {
  double sum = 0;
  for (std::size_t n = 0; n < factors.size(); ++n) sum += (factors[n] - 1) * masses[n];
  return sum;
}

/// λ_max of the stiffness at x over masses times factors.
double highest(ElasticBody<double>& body, const std::vector<double>& x) {
  ThreadTeam team(1);
  std::vector<double> mass = body.masses();
  const std::vector<double>& factors = body.mass_factors(team);
  for (std::size_t n = 0; n < factors.size(); ++n) mass[n] *= factors[n];
  const auto size = static_cast<Eigen::Index>(x.size());
  Eigen::MatrixXd K(size, size);
  std::vector<double> unit(x.size(), 0.0), column(x.size());
  body.linearise(x.data(), team);
  for (Eigen::Index j = 0; j < size; ++j) {
    const auto l = static_cast<std::size_t>(j);
    unit[l] = 1;
    body.force_differential(unit.data(), column.data(), team);
    unit[l] = 0;
    for (std::size_t k = 0; k < x.size(); ++k)
      K(static_cast<Eigen::Index>(k), j) = -column[k] / std::sqrt(mass[k / 3] * mass[l / 3]);
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K, Eigen::EigenvaluesOnly).eigenvalues()[size - 1];
}

}  // namespace

TEST_CASE("mass scaling: the largest bound falls as far as the share of mass allows, and no other node is heavier") {
  // By hand: 2 kg may be added of 20. T of the first node: 1 · 100 / (2 + 1) = 33.3, above 30: it alone.
  const std::vector<double> bounds{100, 30, 10, 1}, masses{1, 4, 5, 10};
  const std::vector<double> factors = mass_factors(bounds, masses, 0.1);
  CHECK(factors == std::vector<double>{3, 1, 1, 1});
  // 3 kg: (100 + 4 · 30) / (3 + 5) = 27.5.
  const std::vector<double> more = mass_factors(bounds, masses, 0.15);
  CHECK(more[0] == doctest::Approx(100 / 27.5));
  CHECK(more[1] == doctest::Approx(30 / 27.5));
  CHECK(more[2] == 1);
  CHECK(added(more, masses) == doctest::Approx(3));
}

TEST_CASE("mass scaling: any bounds and masses") {
  std::mt19937_64 random(3);
  for (int k = 0; k < 200; ++k) {
    std::vector<double> bounds, masses;
    for (int n = 0; n < 40; ++n) {
      bounds.push_back(n % 7 == 0 ? 0 : std::pow(10, uniform(random, 2, 8)));
      masses.push_back(n % 11 == 0 ? 0 : std::pow(10, uniform(random, -6, -3)));
    }
    const double share = std::pow(10, uniform(random, -4, 0));
    const std::vector<double> factors = mass_factors(bounds, masses, share);
    REQUIRE(factors.size() == bounds.size());
    const double whole = std::accumulate(masses.begin(), masses.end(), 0.0);
    CHECK(added(factors, masses) == doctest::Approx(share * whole));
    double largest = 0;
    for (std::size_t n = 0; n < bounds.size(); ++n) largest = std::max(largest, bounds[n] / factors[n]);
    for (std::size_t n = 0; n < bounds.size(); ++n) {
      CHECK(factors[n] >= 1);
      if (factors[n] > 1) CHECK(bounds[n] / factors[n] == doctest::Approx(largest));
    }
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(mass_factors<double>({1, nan}, {1, 1}, 0.1).empty());
  CHECK(mass_factors<double>({1, 2}, {1, 1}, 0).empty());
  CHECK(mass_factors<double>({0, 0}, {1, 1}, 0.1).empty());  // springs alone
  CHECK(mass_factors<double>({}, {}, 0.1).empty());
}

TEST_CASE("mass scaling: bounds are of the heavier masses, never below the highest frequency, and lower than before") {
  std::mt19937_64 random(5);
  ThreadTeam team(2);
  for (const char* law : {"neo_hookean", "neo_hookean_iso", "guccione", "mooney_rivlin"})
    for (const bool quadratic : {false, true})
      for (const bool averaged : {false, true}) {
        if (averaged && std::string_view(law) == "neo_hookean") continue;  // its volume term is its own
        CAPTURE(law);
        CAPTURE(quadratic);
        CAPTURE(averaged);
        TetMesh mesh = make_box(Vec3(0.1, 0.08, 0.06), quadratic ? std::array{2, 2, 1} : std::array{3, 3, 2});
        flatten_one(mesh, 0.03);
        const MidEdges midedges = quadratic ? add_midedge_nodes(mesh) : MidEdges{};
        const std::vector<int> material_of(mesh.tets.size(), 0);
        BodyOptions options{true, averaged};
        ElasticBody<double> plain(mesh, material_of, {sample_material(law)}, options, midedges);
        options.mass_scaling = 0.1;
        ElasticBody<double> body(mesh, material_of, {sample_material(law)}, options, midedges);
        double before = 0;
        for (const double noise : {0.0, 0.02}) {
          std::vector<double> x;
          for (const Vec3& X : mesh.nodes) {
            const Vec3 moved = X + random_vector(random, noise * 0.03);
            x.insert(x.end(), {moved.x(), moved.y(), moved.z()});
          }
          const double bound = body.frequency_bound(x.data(), team);
          CHECK(bound >= highest(body, x));
          if (noise > 0) continue;
          CHECK(bound < 0.6 * plain.frequency_bound(x.data(), team));
          before = bound;
        }
        const std::vector<double> masses = body.masses();
        CHECK(added(body.mass_factors(team), masses) ==
              doctest::Approx(options.mass_scaling * std::accumulate(masses.begin(), masses.end(), 0.0)));
        // No node is above the target at rest.
        NodeBounds<double> all;
        std::vector<double> rest;
        for (const Vec3& X : mesh.nodes) rest.insert(rest.end(), {X.x(), X.y(), X.z()});
        body.frequency_bound(rest.data(), team, all, 0);
        for (const double bound : all.bounds()) CHECK(bound <= before * (1 + 1e-12));
      }
}

}  // namespace heml::mass_scaling_test
