#include <doctest/doctest.h>

#include <studies/translation_error.hpp>

namespace heml::translation_error_test {

TEST_CASE("far from the origin HEML keeps the digits of positions, Mass-Tensor loses the cube of the distance") {
  const BenchBody body = bench_cube(3, true);
  const auto errors = translation_errors<double>(body, bench_material("stvk"));
  REQUIRE(errors.size() == 8);
  CHECK(errors.front().sizes == 0);
  CHECK(errors.front().heml < 1e-13);
  CHECK(errors.front().mass_tensor < 1e-13);
  for (const TranslationError& at : errors) {
    CAPTURE(at.sizes);
    CHECK(at.heml < 1e-13 * std::max(1.0, at.sizes));
    if (at.sizes >= 10) CHECK(at.mass_tensor > 10 * at.heml);
  }
}

}  // namespace heml::translation_error_test
