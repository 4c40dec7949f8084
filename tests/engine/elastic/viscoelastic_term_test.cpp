// Viscosity, relaxation and plasticity of a body under a prescribed homogeneous deformation F.
#include <doctest/doctest.h>

#include <heml/materials/point.hpp>

#include "small_body.hpp"

namespace heml::viscoelastic_term_test {

using test::forces_of;
using test::largest;
using test::sample_material;

namespace {

/// One tetrahedron at F, and its first Piola–Kirchhoff stress from the forces, P = −Σ f_a ⊗ X_a / V.
struct Bench {
  TetMesh mesh;
  std::unique_ptr<ElasticBody<double>> body;

  explicit Bench(const Material& material) {
    mesh.nodes = {{0.01, 0, 0}, {0.11, 0.02, 0}, {0.01, 0.12, 0.03}, {0.02, 0.01, 0.1}};
    mesh.tets = {{0, 1, 2, 3}};
    mesh.regions = {0};
    body = std::make_unique<ElasticBody<double>>(mesh, std::vector<int>{0}, std::vector{material}, BodyOptions{});
  }
  std::vector<double> at(const Mat3& F) const {
    std::vector<double> x;
    for (const Vec3& X : mesh.nodes)
      for (const double v : Vec3(F * X)) x.push_back(v);
    return x;
  }
  /// A step of h seconds to F, committed. Returns the stress.
  Mat3 step(const Mat3& F, double h) {
    const auto x = at(F);
    body->begin_step(h);
    const Mat3 P = stress(x);
    body->commit(x.data());
    return P;
  }
  Mat3 stress(const std::vector<double>& x) {
    const auto f = forces_of(*body, x);
    Mat3 P = Mat3::Zero();
    for (std::size_t n = 0; n < 4; ++n) P -= Eigen::Map<const Vec3>(&f[3 * n]) * mesh.nodes[n].transpose();
    return P / signed_volume(mesh.nodes[0], mesh.nodes[1], mesh.nodes[2], mesh.nodes[3]);
  }
};

Mat3 turned(double angle) { return Eigen::AngleAxisd(angle, Vec3(1, 2, 3).normalized()).toRotationMatrix(); }

}  // namespace

TEST_CASE("viscosity at small strain is 2 η ε̇ + ζ tr(ε̇) I") {
  Material material = sample_material("neo_hookean_iso");
  material.viscosity = 3;
  material.bulk_viscosity = 5;
  Bench bench(material);
  const double h = 1e-3, size = 1e-3;
  Mat3 rate;
  rate << 1, 0.4, -0.2, 0.4, -0.5, 0.3, -0.2, 0.3, 0.8;
  const Mat3 P = bench.step(Mat3::Identity() + h * size * rate, h);
  const Mat3 elastic = make_material_point(material, false)->first_piola(Mat3::Identity() + h * size * rate);
  const Mat3 expected = size * (2 * 3 * rate + 5 * rate.trace() * Mat3::Identity());
  CHECK((P - elastic - expected).norm() <= 1e-5 * expected.norm());
}

TEST_CASE("viscosity does not damp a rigid motion, however fast it turns") {
  Material material = sample_material("neo_hookean_iso");
  material.viscosity = 100;
  Bench bench(material);
  const Mat3 F = Vec3(1.2, 0.9, 0.95).asDiagonal();
  bench.step(F, 1e9);  // slow enough for a strain rate of 0
  const Mat3 still = make_material_point(material, false)->first_piola(F);
  for (int k = 1; k <= 20; ++k) {
    const Mat3 R = turned(0.8 * k);
    CHECK((bench.step(R * F, 1e-3) - R * still).norm() <= 1e-9 * still.norm());
  }
}

TEST_CASE("stress after a step in stretch relaxes as the Prony series says") {
  Material material = sample_material("mooney_rivlin");
  material.relaxation = {{0.7, 0.05}, {0.4, 1.0}};
  Bench bench(material);
  Material isochoric = material;
  isochoric.relaxation.clear();
  const Mat3 F = turned(0.4) * Mat3(Vec3(1.4, 0.9, 0.85).asDiagonal());
  const Mat3 whole = make_material_point(isochoric, false)->first_piola(F);
  isochoric.parameters.back() = 1e-300;
  const Mat3 deviatoric = make_material_point(isochoric, false)->first_piola(F);
  const double h = 1e-3;
  Mat3 P = bench.step(F, 1e-9);  // instantaneous: no relaxation
  CHECK((P - whole - 1.1 * deviatoric).norm() <= 1e-7 * whole.norm());
  for (int k = 1; k <= 2000; ++k) {
    P = bench.step(F, h);
    const double t = k * h, left = 0.7 * std::exp(-t / 0.05) + 0.4 * std::exp(-t / 1.0);
    REQUIRE((P - whole - left * deviatoric).norm() <= 1e-7 * whole.norm());
  }
}

TEST_CASE("under a steady rate the relaxing branches follow their integral with second order") {
  // For one branch and S growing linearly, Q = γ τ Ṡ (1 − e^(−t/τ)); small strains, so that S is linear in time.
  Material material = sample_material("neo_hookean_iso");
  material.relaxation = {{2.0, 0.1}};
  const double rate = 1e-6, T = 0.3;
  Mat3 D = Mat3::Zero();
  D(0, 1) = D(1, 0) = 1;
  const double G = 2 * 500, exact = 2 * G * rate * 2.0 * 0.1 * (1 - std::exp(-T / 0.1));
  double error[2];
  for (int k = 0; k < 2; ++k) {
    Bench bench(material);
    const int steps = k == 0 ? 10 : 20;
    Mat3 P;
    for (int i = 1; i <= steps; ++i) P = bench.step(Mat3::Identity() + rate * T * i / steps * D, T / steps);
    error[k] = std::abs(P(0, 1) - 2 * G * rate * T - exact);
  }
  CHECK(error[0] <= 0.01 * exact);
  CHECK(error[0] / error[1] == doctest::Approx(4).epsilon(0.1));
}

TEST_CASE("creep under a steady shear stress follows the closed forms") {
  // Small simple shear γ: P12 = G γ + ..., with h so small that first order is enough.
  const double G = 1000, stress = 1e-4, h = 1e-3;
  const auto creep = [&](const Material& material, int steps) {
    Bench bench(material);
    const auto sheared = [](double gamma) {
      Mat3 F = Mat3::Identity();
      F(0, 1) = gamma;
      return F;
    };
    double gamma = 0;
    for (int k = 0; k < steps; ++k) {
      bench.body->begin_step(h);
      const double at = bench.stress(bench.at(sheared(gamma)))(0, 1);  // linear response: one secant step
      const double more = bench.stress(bench.at(sheared(gamma + 1e-7)))(0, 1);
      gamma += (stress - at) / (more - at) * 1e-7;
      bench.step(sheared(gamma), h);
    }
    return gamma;
  };
  Material voigt = sample_material("neo_hookean_iso");
  voigt.viscosity = 200;  // retardation time η/G = 0.2 s
  for (const int steps : {100, 400})
    CHECK(creep(voigt, steps) == doctest::Approx(stress / G * (1 - std::exp(-steps * h * G / 200))).epsilon(5e-3));
  // Standard linear solid: J(t) = (1 − γ/(1+γ) e^(−t/(τ(1+γ)))) / G.
  Material zener = sample_material("neo_hookean_iso");
  zener.relaxation = {{1.5, 0.2}};
  for (const int steps : {100, 1000})
    CHECK(creep(zener, steps) ==
          doctest::Approx(stress / G * (1 - 0.6 * std::exp(-steps * h / (0.2 * 2.5)))).epsilon(5e-3));
}

TEST_CASE("viscoelastic forces are the gradient of an incremental potential") {
  std::mt19937_64 random(51);
  for (const auto law : test::law_names()) {
    if (!find_law(law)->has_volume_term) continue;
    CAPTURE(std::string(law));
    test::SmallBody small(random, 0.06);
    Material material = sample_material(law);
    material.relaxation = {{0.8, 0.02}};
    material.viscosity = 2;
    material.bulk_viscosity = 1;
    auto body = small.of(material, false);
    for (const double h : {0.004, 0.006}) {
      body->begin_step(h);
      CHECK(test::gradient_error(*body, small.x) <= 1e-6);
      CHECK(test::stiffness_error(*body, small.x, random) <= 1e-5);
      body->commit(small.x.data());
      for (double& x : small.x) x *= 1.02;
    }
  }
}

TEST_CASE("beyond yield the stress stays on the yield surface and a permanent set is left") {
  for (const char* law : {"neo_hookean_iso", "mooney_rivlin", "ogden"})
    for (const double hardening : {0.0, 200.0}) {
      CAPTURE(law);
      Material material = sample_material(law);
      material.plasticity = Plasticity{150, hardening};
      Bench bench(material);
      double work = 0, before = 0;
      std::vector<ElementState<double>> states;
      // Isochoric stretch in steps; then, below, back to the initial length.
      for (int k = 1; k <= 40; ++k) {
        const double t = 1 + 0.02 * k, s = 1 / std::sqrt(t);
        const auto x = bench.at(Vec3(t, s, s).asDiagonal());
        bench.body->commit(x.data());
        bench.body->states(x.data(), states);
        // σ = yield + hardening · p, with p the plastic part of the logarithmic strain.
        if (hardening == 0 && k > 10) CHECK(states[0].von_mises == doctest::Approx(150).epsilon(1e-9));
        if (hardening > 0 && k > 10) CHECK(states[0].von_mises > before);
        before = states[0].von_mises;
        CHECK(bench.body->plastic_work() >= work);
        work = bench.body->plastic_work();
      }
      CHECK(work > 0);
      const Mat3 back = bench.stress(bench.at(Mat3::Identity()));
      CHECK(back(0, 0) < -10);  // compressed back to its initial length, it resists: its rest length has grown
      bench.body->reset_history(bench.at(Mat3::Identity()).data());
      CHECK(bench.stress(bench.at(Mat3::Identity())).norm() <= 1e-8);
    }
}

TEST_CASE("below yield nothing flows, and shape of volume change alone never does") {
  Material material = sample_material("neo_hookean_iso");
  material.plasticity = Plasticity{150, 0};
  Bench bench(material);
  bench.body->commit(bench.at(Vec3(1.03, 0.985, 0.985).asDiagonal()).data());
  CHECK(bench.body->plastic_work() == 0);
  bench.body->commit(bench.at(1.5 * Mat3::Identity()).data());
  CHECK(bench.body->plastic_work() == 0);
}

TEST_CASE("plastic flow is invariant under rotations") {
  Material material = sample_material("mooney_rivlin");
  material.plasticity = Plasticity{150, 50};
  Bench straight(material), other(material);
  const Mat3 F = Vec3(1.4, 0.8, 0.9).asDiagonal(), R = turned(1.1);
  straight.body->commit(straight.at(F).data());
  other.body->commit(other.at(R * F).data());
  const Mat3 P = straight.stress(straight.at(F));
  CHECK((other.stress(other.at(R * F)) - R * P).norm() <= 1e-10 * P.norm());
}

TEST_CASE("a body goes back to an earlier internal state, of every law and all that its material remembers") {
  std::mt19937_64 random(21);
  const test::SmallBody good(random, 0.05), bad(random, 0.3, Mat3(1.2 * Mat3::Identity())), next(random, 0.1);
  const double h = 0.01;
  for (const std::string_view law : test::law_names()) {
    if (law.starts_with("paper_")) continue;
    Material viscous = sample_material(law), relaxing = viscous, plastic = viscous;
    viscous.viscosity = 2;
    relaxing.relaxation = {{0.5, 0.01}, {0.2, 0.1}};
    plastic.plasticity = Plasticity{60, 10};
    for (const Material& material : {viscous, relaxing, plastic}) {
      if (material_problem(material)) continue;
      CAPTURE(law);
      CAPTURE(material.viscosity);
      CAPTURE(material.relaxation.size());
      const auto body = good.of(material, true);
      const auto step_to = [&](const test::SmallBody& place) {
        body->begin_step(h);
        const auto f = forces_of(*body, place.x);
        body->commit(place.x.data());
        return f;
      };
      step_to(good);
      const InternalState<double> kept = body->internal_state();
      const auto expected = step_to(next);
      const double work = body->plastic_work();
      step_to(bad);
      const auto away = [&](const std::vector<double>& f) {  // of the expected forces, relative
        double most = 0;
        for (std::size_t i = 0; i < f.size(); ++i) most = std::max(most, std::abs(f[i] - expected[i]));
        return most / largest(expected);
      };
      CHECK(away(step_to(next)) > 1e-3);
      step_to(bad);
      body->set_internal_state(kept);
      CHECK(away(step_to(next)) < 1e-12);
      CHECK(body->plastic_work() == work);
    }
  }
}

}  // namespace heml::viscoelastic_term_test
