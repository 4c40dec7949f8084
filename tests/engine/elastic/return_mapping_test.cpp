#include <doctest/doctest.h>

#include <heml/elastic/return_mapping.hpp>
#include <heml/elastic/term_parts.hpp>
#include <heml/materials/point.hpp>

#include "small_body.hpp"

namespace heml::return_mapping_test {

TEST_CASE_TEMPLATE("flow is where the incremental potential is least, the stress along it and on the yield surface",
                   Real, float, double) {
  std::mt19937_64 random(73);
  constexpr bool is_double = std::is_same_v<Real, double>;
  for (const LawInfo& info : laws()) {
    if (!info.has_volume_term || info.has_fibre) continue;
    CAPTURE(std::string(info.name));
    const Material material = test::sample_material(info.name);
    const auto law = make_law_term<Real>(material, false, false);
    const auto point = make_material_point(material, false);
    const ElementGroup<Real> group;
    for (const double hardening : {0.0, 40.0, 4000.0})
      for (int sample = 0; sample < 20; ++sample) {
        Vec3 strain = test::random_vector(random, 0.3);
        const FlowStress<Real> yield{static_cast<Real>(test::uniform(random, 1, 100)), static_cast<Real>(hardening)};
        Real c[3], J = 1;
        for (int i = 0; i < 3; ++i) {
          c[i] = static_cast<Real>(std::exp(2 * strain[i]));
          J *= static_cast<Real>(std::exp(strain[i]));
        }
        const auto found = return_mapping(*law, group, 0, c, J, yield);
        if (found.length == 0) {
          CHECK(found.stress.norm() * std::sqrt(1.5) <= yield.at_start);
          continue;
        }
        REQUIRE(found.is_minimum);
        const double stress = static_cast<double>(found.stress.norm()), tolerance = is_double ? 1e-10 : 1e-3;
        const double expected =
            static_cast<double>(yield.at_start) + hardening * static_cast<double>(found.equivalent_strain());
        CHECK(std::sqrt(1.5) * stress == doctest::Approx(expected).epsilon(tolerance));
        CHECK(found.work() == doctest::Approx(stress * static_cast<double>(found.length)).epsilon(tolerance));
        if (!is_double) continue;
        const auto potential = [&](const Vec3& d) {
          const Mat3 F = (strain - d).array().exp().matrix().asDiagonal();
          const double p = std::sqrt(2.0 / 3) * d.norm();
          return point->energy(F) + static_cast<double>(yield.at_start) * p + hardening / 2 * p * p;
        };
        const Vec3 d(static_cast<double>(found.flow[0]), static_cast<double>(found.flow[1]),
                     static_cast<double>(found.flow[2]));
        CHECK(std::abs(d.sum()) <= 1e-14);
        for (int k = 0; k < 10; ++k) {
          Vec3 aside = test::random_vector(random, 0.05 * d.norm());
          aside.array() -= aside.mean();
          CHECK(potential(d + aside) >= potential(d));
        }
      }
  }
}

}  // namespace heml::return_mapping_test
