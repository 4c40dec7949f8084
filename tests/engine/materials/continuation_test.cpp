#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "every_law.hpp"

// Limits of the range of laws, and their continuations beyond.

namespace heml::continuation_test {

using namespace heml::test;

TEST_CASE("a continuation changes nothing in moderate states") {
  std::mt19937_64 random(10);
  for (const Material& material : samples()) {
    CAPTURE(material.law);
    const auto plain = make_material_point(material, false), continued = make_material_point(material, true);
    for (int i = 0; i < 100; ++i) {
      const Mat3 F = random_gradient(random, 0.85, 1.3), dF = random_direction(random);
      REQUIRE(plain->valid(F));
      CHECK(plain->energy(F) == continued->energy(F));
      CHECK(plain->first_piola(F) == continued->first_piola(F));
      CHECK(plain->first_piola_differential(F, dF) == continued->first_piola_differential(F, dF));
    }
  }
}

// Checks along straight paths through a law's range and beyond that energy, stress and stiffness have no jumps. The
// steps are so small that a smooth law hardly changes.
struct Path {
  std::string name;
  Vec3 from, to;
};
void check_smooth_along(const std::vector<Path>& paths) {
  constexpr int steps = 40000;
  const Mat3 turn = Eigen::AngleAxisd(0.7, askew).toRotationMatrix();
  const Mat3 direction = (askew * askew.transpose() + Mat3::Identity()).normalized();
  for (const Material& material : samples())
    for (const auto& path : paths) {
      const auto& [name, from, to] = path;
      CAPTURE(material.law);
      CAPTURE(path.name);
      const auto point = make_material_point(material, true);
      // The stiffness of a fibre law itself jumps where the fibre begins to bear load.
      const bool jumps = material.law == "stvk" || find_law(material.law)->has_fibre;
      const Mat3 step = turn * ((to - from) / steps).asDiagonal();
      struct At {
        double W;
        Mat3 P, dP, stiffness;
      };
      const auto at = [&](int k) {
        const Mat3 F = turn * path.from.asDiagonal() + k * step;
        return At{point->energy(F), point->first_piola(F), point->first_piola_differential(F, step),
                  point->first_piola_differential(F, direction)};
      };
      double energy_jump = 0, stress_jump = 0, stiffness_jump = 0;  // less the first-order change, relative
      At before = at(0);
      for (int k = 1; k <= steps; ++k) {
        const At now = at(k);
        const double stiffness = std::min(before.stiffness.norm(), now.stiffness.norm()) + 10 * min_stress(material);
        const double stress = now.P.norm() + stiffness * step.norm();
        energy_jump = std::max(energy_jump, std::abs(now.W - before.W - inner(now.P + before.P, step) / 2) / stress);
        stress_jump = std::max(stress_jump, (now.P - before.P - (now.dP + before.dP) / 2).norm() / stiffness);
        stiffness_jump = std::max(stiffness_jump, (now.stiffness - before.stiffness).norm() / stiffness);
        before = now;
      }
      CHECK(energy_jump < 1e-2 * step.norm());
      CHECK(stress_jump < (jumps ? 1 : 1e-2) * step.norm());
      if (!jumps) CHECK(stiffness_jump < 0.1);
      if (material.law == "stvk" && to[0] < 0) CHECK(stiffness_jump > 0.1);  // the check detects a real jump
    }
}

TEST_CASE("continued laws are smooth through inversion, to the second derivative but for StVK") {
  check_smooth_along({{"flattened and turned inside out", {1, 1.1, 0.9}, {-1, 1.1, 0.9}},
                      {"shrunk to a point and turned inside out", {1, 1, 1}, {-0.7, -0.7, -0.7}}});
}

TEST_CASE("continued laws are smooth far out, to the second derivative") {
  check_smooth_along({{"pulled", {1, 1, 1}, {12, 0.4, 0.3}}, {"pulled two ways", {1, 1, 1}, {9, 8, 0.05}}});
}

TEST_CASE("a continued law pushes a flat or inverted cube back to its orientation") {
  for (const Material& material : samples()) {
    CAPTURE(material.law);
    const auto point = make_material_point(material, true);
    for (double t = -1; t < 0.9; t += 0.05) {
      CAPTURE(t);
      CHECK(point->first_piola(Vec3(t, 1, 1).asDiagonal())(0, 0) < 0);
    }
  }
}

TEST_CASE("laws are undefined at J = 0, where exponentials overflow, and beyond locking") {
  const Mat3 flat = Vec3(1, 1, 0).asDiagonal(), inverted = Vec3(1, 1, -1).asDiagonal();
  const Mat3 far = Mat3::Identity() + 200 * askew * askew.transpose();
  for (const Material& material : samples()) {
    CAPTURE(material.law);
    const auto point = make_material_point(material, false), continued = make_material_point(material, true);
    const bool logarithm = material.law == "neo_hookean" || material.volume_term != VolumeTerm::quadratic;
    const LawInfo& law = *find_law(material.law);
    const bool bears_flat = material.law == "stvk" || !law.is_stress_free;
    const bool ends_far = std::any_of(law.parameters.begin(), law.parameters.end(), [](const ParameterInfo& info) {
      return info.kind == ParameterKind::exponent || info.kind == ParameterKind::limit;
    });
    CHECK(point->valid(flat) == (bears_flat || material.law == "stable_neo_hookean"));
    CHECK(point->valid(inverted) == !logarithm);
    CHECK(point->valid(far) == !ends_far);
    for (const Mat3& F : {flat, inverted, far}) {
      CHECK(continued->valid(F));
      CHECK(std::isfinite(continued->energy(F)));
      CHECK(continued->first_piola(F).allFinite());
      CHECK(continued->first_piola_differential(F, askew * askew.transpose()).allFinite());
    }
  }
}

TEST_CASE("where a law is valid its stress and stiffness are finite, to where its energy overflows") {
  for (const Material& material : samples()) {
    CAPTURE(material.law);
    const auto point = make_material_point(material, false);
    for (double stretch = 1; stretch < 300; stretch *= 1.001) {
      const Mat3 F = Mat3::Identity() + (stretch - 1) * askew * askew.transpose();
      if (!point->valid(F)) break;
      CAPTURE(stretch);
      CHECK(point->first_piola(F).allFinite());
      CHECK(point->first_piola_differential(F, F).allFinite());
    }
  }
}

TEST_CASE("StVK loses its stiffness below a stretch of 1/√3, which the continuation prevents") {
  // Confined: P11 = (lambda + 2 mu)/2 (t³ − t), whose slope is zero at 1/√3.
  const Material material = sample_material("stvk");
  const auto formula = make_material_point(material, false), continued = make_material_point(material, true);
  const auto P11 = [](const MaterialPoint& point, double t) {
    return point.first_piola(Vec3(t, 1, 1).asDiagonal())(0, 0);
  };
  const double t = 1 / std::sqrt(3.0), h = 1e-4, modulus = material.parameters[0] + 2 * material.parameters[1];
  CHECK(std::abs(P11(*formula, t + h) - P11(*formula, t - h)) <= 1e-6 * modulus * h);
  CHECK(std::abs(P11(*formula, 0.1)) < std::abs(P11(*formula, t)));
  for (double s = t; s > -0.5; s -= 0.05) CHECK(P11(*continued, s - 0.05) < P11(*continued, s));
}

}  // namespace heml::continuation_test
