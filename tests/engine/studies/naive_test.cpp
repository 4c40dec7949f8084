#include <memory>
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

#define HEML_COMPILED_FOR(macro, name) , HEML_IS_ONE(macro)
constexpr bool compiled_for[] = {true HEML_X86_FEATURES(HEML_COMPILED_FOR)};  // of this file: not native
#undef HEML_COMPILED_FOR

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

TEST_CASE("naive loops for every processor are those for this one to round-off") {
  std::mt19937_64 random(83);
  for (const auto law : test::law_names(true)) {
    CAPTURE(std::string(law));
    Material material = test::sample_material(law);
    if (find_law(law)->has_fibre) material.fibre = Vec3(2, -1, 2) / 3;
    const SmallBody small(random, 0.1, test::random_gradient(random, 0.9, 1.2));
    std::vector<double> f(small.x.size());
    NaiveForces(small.mesh, material, naive_loop(portable_naive_set, law))(small.x.data(), f.data());
    CHECK(apart(naive_forces(small, material), f) < 1e-11);
  }
}

TEST_CASE("naive loops made for a processor run on none that lacks what they were made for") {
  const std::size_t count = native_naive_set.features;
  REQUIRE(count == portable_naive_set.features);
  std::vector<std::size_t> asked_for;
  for (std::size_t k = 1; k < count; ++k) {
    CHECK(portable_naive_set.compiled_for[k] == compiled_for[k]);
    if (native_naive_set.compiled_for[k]) asked_for.push_back(k);
  }
  CHECK(asked_for.empty() == (count == 1));          // with a list of features, at least SSE2
  const auto has = std::make_unique<bool[]>(count);  // std::vector<bool> has no bool array
  const auto chosen_without = [&](std::size_t lacking) {
    for (std::size_t k = 0; k < count; ++k) has[k] = k != lacking;
    return &naive_set({has.get(), count});
  };
  CHECK(chosen_without(count) == &native_naive_set);
  for (const std::size_t k : asked_for) CHECK(chosen_without(k) == &portable_naive_set);
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
