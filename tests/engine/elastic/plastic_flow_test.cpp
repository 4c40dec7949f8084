// Plastic flow within a step: what an implicit method sees of it. How it goes on over steps is in
// viscoelastic_term_test.cpp.
#include <doctest/doctest.h>

#include "small_body.hpp"

namespace heml::plastic_flow_test {

using test::largest;
using test::sample_material;

namespace {

double fourth_order(double a, double b, double c, double d, double h) { return (8 * (a - b) - (c - d)) / (12 * h); }

/// A body as an implicit step evaluates it.
struct Within {
  ElasticBody<double>& body;
  ThreadTeam team{1};

  std::vector<double> forces(const std::vector<double>& x) {
    std::vector<double> f(x.size());
    const FlowTrial trial(body, x.data(), team);
    body.forces(x.data(), f.data(), team);
    return f;
  }
  double potential(const std::vector<double>& x) {
    const FlowTrial trial(body, x.data(), team);
    return body.potential(x.data(), team);
  }
  std::vector<double> stiffness_times(const std::vector<double>& x, const std::vector<double>& dx) {
    std::vector<double> out(x.size());
    const FlowTrial trial(body, x.data(), team);
    body.linearise(x.data(), team);
    body.force_differential(dx.data(), out.data(), team);
    return out;
  }
  /// Derivative of `of` along dx at x by fourth-order differences.
  template <class Of>
  auto derivative(const std::vector<double>& x, const std::vector<double>& dx, double h, const Of& of) {
    const auto at = [&](double by) {
      auto moved = x;
      for (std::size_t i = 0; i < x.size(); ++i) moved[i] += by * dx[i];
      return of(moved);
    };
    return std::array{at(h), at(-h), at(2 * h), at(-2 * h)};
  }
  /// Largest difference between −K dx and differences of the forces, relative to its largest entry.
  double stiffness_error(const std::vector<double>& x, const std::vector<double>& dx) {
    constexpr double h = 1e-7;
    const auto change = stiffness_times(x, dx);
    const auto F = derivative(x, dx, h, [&](const auto& at) { return forces(at); });
    double worst = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
      worst = std::max(worst, std::abs(fourth_order(F[0][i], F[1][i], F[2][i], F[3][i], h) - change[i]));
    return worst / largest(change);
  }
};

std::vector<std::string_view> laws_that_flow() {
  std::vector<std::string_view> names;
  for (const LawInfo& law : laws())
    if (law.has_volume_term && !law.has_fibre) names.push_back(law.name);
  return names;
}

}  // namespace

TEST_CASE("while elements flow forces are the gradient of a potential, and the stiffness their derivative, any law") {
  std::mt19937_64 random(71);
  for (const auto law : laws_that_flow())
    for (const double hardening : {0.0, 300.0})
      for (const bool other_volume_term : {false, true}) {
        CAPTURE(std::string(law));
        CAPTURE(hardening);
        test::SmallBody small(random, 0.1);
        Material material = sample_material(law);
        material.plasticity = Plasticity{60, hardening};
        if (other_volume_term) material.volume_term = VolumeTerm::logarithmic;
        auto body = small.of(material, false);
        body->commit(small.x.data());  // flow of a step before
        const double before = body->plastic_work();
        CHECK(before > 0);
        for (double& x : small.x) x += test::uniform(random, -1, 1) * 0.002;
        std::vector<double> dx(small.x.size());
        for (double& d : dx) d = test::uniform(random, -1, 1);
        Within within{*body};
        const auto f = within.forces(small.x);
        double slope = 0;
        for (std::size_t i = 0; i < f.size(); ++i) slope -= f[i] * dx[i];
        constexpr double h = 1e-7;
        const auto U = within.derivative(small.x, dx, h, [&](const auto& x) { return within.potential(x); });
        CHECK(std::abs(fourth_order(U[0], U[1], U[2], U[3], h) - slope) <= 1e-7 * largest(f));
        CHECK(within.stiffness_error(small.x, dx) <= 1e-6);
        body->commit(small.x.data());
        CHECK(body->plastic_work() > before);
        const auto flowed = test::forces_of(*body, small.x);
        for (std::size_t i = 0; i < f.size(); ++i) CHECK(std::abs(flowed[i] - f[i]) <= 1e-9 * largest(f));
      }
}

TEST_CASE("the stiffness of what flows has its limit where stretches are equal") {
  std::mt19937_64 random(74);
  for (const auto law : laws_that_flow())
    for (const Vec3& stretches : {Vec3(1.4, 0.85, 0.85), Vec3(0.8, 1.15, 1.15)}) {
      CAPTURE(std::string(law));
      const test::SmallBody small(random, 0, Mat3(stretches.asDiagonal()));
      Material material = sample_material(law);
      material.plasticity = Plasticity{60, 20};
      const auto body = small.of(material, false);
      std::vector<double> dx(small.x.size());
      for (double& d : dx) d = test::uniform(random, -1, 1);
      CHECK(Within{*body}.stiffness_error(small.x, dx) <= 1e-6);
    }
}

TEST_CASE("a trial of flow leaves nothing behind") {
  std::mt19937_64 random(72);
  test::SmallBody small(random, 0.1);
  Material material = sample_material("mooney_rivlin");
  material.plasticity = Plasticity{60, 10};
  auto body = small.of(material, false);
  const auto before = test::forces_of(*body, small.x);
  const auto values = body->internal_state().values;
  Within within{*body};
  CHECK(within.forces(small.x) != before);
  CHECK(test::forces_of(*body, small.x) == before);
  CHECK(body->internal_state().values == values);
  CHECK(body->plastic_work() == 0);
}

}  // namespace heml::plastic_flow_test
