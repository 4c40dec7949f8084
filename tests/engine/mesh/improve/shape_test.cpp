#include <doctest/doctest.h>

#include <heml/mesh/improve/shape.hpp>
#include <heml/mesh/quality.hpp>
#include <numbers>

#include "support.hpp"

namespace heml::improve_shape_test {

TEST_CASE("quality is the sine of the worst dihedral angle, negative where inverted") {
  std::mt19937_64 random(3);
  for (int k = 0; k < 50; ++k) {
    Corners x;
    for (Vec3& corner : x) corner = test::random_vector(random, 1);
    if (signed_volume(x[0], x[1], x[2], x[3]) < 0) std::swap(x[2], x[3]);
    const double quality = ShapeMeasure{2, 0}(x), angle = min_dihedral(x) * std::numbers::pi / 180;
    CHECK(quality <= std::sin(angle) + 1e-12);  // less where an angle near 180° is worse
    CHECK(quality > 0);
    std::swap(x[2], x[3]);
    CHECK(ShapeMeasure{2, 0}(x) < 0);
  }
  const Corners regular{Vec3(1, 1, 1), Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(-1, -1, 1)};
  CHECK(std::abs(ShapeMeasure()(regular)) == doctest::Approx(std::sqrt(8.0) / 3));
  CHECK(std::abs(smallest_altitude(regular)) == doctest::Approx(4 / std::sqrt(3.0)));
}

TEST_CASE("gradients of the terms are those of differences") {
  std::mt19937_64 random(4);
  for (const ShapeMeasure measure : {ShapeMeasure{2, 0, 0}, ShapeMeasure{-1, 0.5, 0}, ShapeMeasure{1, 0, 3}}) {
    Corners x;
    for (Vec3& corner : x) corner = test::random_vector(random, 1);
    if (signed_volume(x[0], x[1], x[2], x[3]) < 0) std::swap(x[2], x[3]);
    for (int corner = 0; corner < 4; ++corner) {
      std::vector<ShapeTerm> terms;
      measure.append_terms(x, corner, 1e9, terms);
      REQUIRE(!terms.empty());
      for (std::size_t k = 0; k < terms.size(); ++k)
        for (int axis = 0; axis < 3; ++axis) {
          double difference = 0;
          for (const double side : {1.0, -1.0}) {
            Corners moved = x;
            moved[corner][axis] += side * 1e-6;
            std::vector<ShapeTerm> there;
            measure.append_terms(moved, corner, 1e9, there);
            difference += side * there[k].value / 2e-6;
          }
          CHECK(terms[k].gradient[axis] == doctest::Approx(difference).epsilon(1e-5));
        }
    }
  }
}

}  // namespace heml::improve_shape_test
