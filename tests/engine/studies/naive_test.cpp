#include <studies/naive.hpp>

#include "engine/elastic/small_body.hpp"

namespace heml::naive_test {

using test::largest;
using test::SmallBody;

namespace {

double apart(const std::vector<double>& a, const std::vector<double>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
  return worst / largest(b);
}

std::vector<double> naive_forces(const SmallBody& small, const Material& material) {
  std::vector<double> f(small.x.size());
  NaiveForces(small.mesh, material)(small.x.data(), f.data());
  return f;
}

}  // namespace

TEST_CASE("naive forces of every law are the engine's to round-off") {
  std::mt19937_64 random(81);
  for (const auto law : test::law_names(true))
    for (int trial = 0; trial < 5; ++trial) {
      CAPTURE(std::string(law));
      Material material = test::sample_material(law);
      if (find_law(law)->has_fibre) material.fibre = Vec3(2, -1, 2) / 3;
      const SmallBody small(random, 0.1, test::random_gradient(random, 0.9, 1.2));
      auto body = small.of(material, false);
      CHECK(apart(naive_forces(small, material), test::forces_of(*body, small.x)) < 1e-11);
    }
}

TEST_CASE("naive forces tell laws and parameters apart") {
  std::mt19937_64 random(82);
  const SmallBody small(random, 0.1);
  for (const auto law : test::law_names(true)) {
    CAPTURE(std::string(law));
    const Material material = test::sample_material(law);
    const auto f = naive_forces(small, material);
    for (std::size_t k = 0; k < material.parameters.size(); ++k) {
      Material other = material;
      other.parameters[k] *= 1.01;
      CHECK(apart(naive_forces(small, other), f) > 1e-9);
    }
  }
}

}  // namespace heml::naive_test
