#include <doctest/doctest.h>

#include <heml/elastic/body.hpp>

#include "engine/materials/energy_materials.hpp"
#include "small_body.hpp"

// Bodies of laws by expression against bodies of the same laws of their own types: forces by every instruction set,
// energy, stiffness, and the bound of the stable step.

namespace heml::energy_term_test {

using test::SmallBody;

TEST_CASE("a law by expression has the forces, energy and stiffness of its own type") {
  std::mt19937_64 random(5);
  ThreadTeam team(1);
  for (const test::SameEnergy& same : test::same_energies()) {
    CAPTURE(same.expression.law);
    SmallBody small(random, 0.06);
    std::vector<double> dx(small.x.size()), a(small.x.size()), b(small.x.size());
    for (double& d : dx) d = test::uniform(random, -1, 1);
    const auto own = small.of(same.law, false);
    const auto off = [&] {
      double worst = 0;
      for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
      return worst / test::largest(a);
    };
    for (const InstructionSet isa : instruction_sets()) {
      CAPTURE(std::string(name_of(isa)));
      ElasticBody<double> other(small.mesh, std::vector<int>(small.mesh.tets.size(), 0), {same.expression},
                                BodyOptions{false, false, isa});
      REQUIRE(own->forces(small.x.data(), a.data(), team));
      REQUIRE(other.forces(small.x.data(), b.data(), team));
      CHECK(off() < 1e-11);
    }
    const auto other = small.of(same.expression, false);
    CHECK(other->energy(small.x.data(), team) == doctest::Approx(own->energy(small.x.data(), team)).epsilon(1e-11));
    own->linearise(small.x.data(), team);
    other->linearise(small.x.data(), team);
    own->force_differential(dx.data(), a.data(), team);
    other->force_differential(dx.data(), b.data(), team);
    CHECK(off() < 1e-9);
    const auto single = small.of<float>(same.expression, false);
    const std::vector<float> x(small.x.begin(), small.x.end());
    std::vector<float> f(x.size());
    REQUIRE(single->forces(x.data(), f.data(), team));
    a = test::forces_of(*own, small.x);
    b.assign(f.begin(), f.end());
    CHECK(off() < 2e-3);
  }
}

TEST_CASE("forces and stiffness of expressions are differences of the energy") {
  std::mt19937_64 random(9);
  for (const char* text :
       {"200*(I1-3) - 400*log(J) + 3000*(J-1)^2 + 50*(I2-3)*(I4-1)^2", "300*(l1+l2+l3-3) - 300*log(J) + 3000*(J-1)^2",
        "100*(l1b^3+l2b^3+l3b^3-3) + 20*(I4b-1)^2*l1 + 3000*(J-1)^2"}) {
    CAPTURE(text);
    SmallBody small(random, 0.05);
    const auto body = small.of(test::energy_material(text, {}, Vec3(2, -1, 2) / 3), false);
    CHECK(test::gradient_error(*body, small.x) <= 1e-6);
    CHECK(test::stiffness_error(*body, small.x, random) <= 1e-5);
  }
}

TEST_CASE("the bound of the step holds for expressions") {
  std::mt19937_64 random(31);
  ThreadTeam team(1);
  for (const test::SameEnergy& same : test::same_energies()) {
    CAPTURE(same.expression.law);
    SmallBody small(random, 0.06);
    const auto body = small.of(same.expression, false);
    const double bound = body->frequency_bound(small.x.data(), team);
    const std::vector<double> mass = body->masses();
    body->linearise(small.x.data(), team);
    // The largest eigenvalue of M⁻¹K by power iteration, a lower bound of it.
    std::vector<double> v(small.x.size()), Kv(small.x.size());
    for (double& each : v) each = test::uniform(random, -1, 1);
    double found = 0;
    for (int i = 0; i < 200; ++i) {
      body->force_differential(v.data(), Kv.data(), team);
      double vKv = 0, vMv = 0, size = 0;
      for (std::size_t k = 0; k < v.size(); ++k) {
        vKv -= v[k] * Kv[k], vMv += v[k] * v[k] * mass[k / 3];
        v[k] = -Kv[k] / mass[k / 3];
        size = std::max(size, std::abs(v[k]));
      }
      found = vKv / vMv;
      for (double& each : v) each /= size;
    }
    CHECK(bound >= found * 0.999);
    CHECK(bound <= 12 * found);
  }
}

TEST_CASE("a body outside the range of an expression says so") {
  std::mt19937_64 random(2);
  ThreadTeam team(1);
  SmallBody small(random, 0.05);
  std::vector<double> f(small.x.size());
  for (const char* text : {"log(I1-3.001)", "sqrt(l1-2)", "exp(900*J)"})
    CHECK_MESSAGE(!small.of(test::energy_material(text), false)->forces(small.x.data(), f.data(), team), text);
  for (double& each : small.x) each *= -1;  // mirrored
  for (const char* text : {"I1", "l1"})
    CHECK_MESSAGE(!small.of(test::energy_material(text), false)->forces(small.x.data(), f.data(), team), text);
}

}  // namespace heml::energy_term_test
