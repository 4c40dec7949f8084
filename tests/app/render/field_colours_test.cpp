#include "app/render/field_colours.hpp"

#include <doctest/doctest.h>

#include <limits>

namespace heml::field_colours_test {

using namespace heml::render;

namespace {

void check_colour(const Vec3f& colour, const Vec3f& expected, float tolerance) {
  CHECK((colour - expected).cwiseAbs().maxCoeff() < tolerance);
}

}  // namespace

TEST_CASE("the map of stress is viridis") {
  // matplotlib's table, entries 0, 64, 128, 192, 255 of 256.
  check_colour(map_colour(Field::von_mises, 0), {0.267004f, 0.004874f, 0.329415f}, 0.015f);
  check_colour(map_colour(Field::von_mises, 64 / 255.f), {0.229739f, 0.322361f, 0.545706f}, 0.015f);
  check_colour(map_colour(Field::von_mises, 128 / 255.f), {0.127568f, 0.566949f, 0.550556f}, 0.015f);
  check_colour(map_colour(Field::von_mises, 192 / 255.f), {0.369214f, 0.788888f, 0.382914f}, 0.015f);
  check_colour(map_colour(Field::von_mises, 1), {0.993248f, 0.906157f, 0.143936f}, 0.015f);
}

TEST_CASE("the maps of stretch and J are neutral in the middle and cool below it") {
  for (const Field field : {Field::stretch, Field::volume_ratio}) {
    const Vec3f middle = map_colour(field, 0.5f);
    CHECK(middle.maxCoeff() - middle.minCoeff() < 0.01f);
    CHECK(map_colour(field, 0.1f).z() > map_colour(field, 0.1f).x());
    CHECK(map_colour(field, 0.9f).x() > map_colour(field, 0.9f).z());
  }
}

TEST_CASE("ranges start at 0 or are symmetric about 1 and omit values that are not finite") {
  const std::vector<float> values = {0.9f, 1.3f, std::numeric_limits<float>::quiet_NaN(), 1.0f};
  CHECK(natural_range(Field::von_mises, values) == Range{0, 1.3f});
  const Range stretch = natural_range(Field::stretch, values);
  CHECK(stretch.low == doctest::Approx(0.7f));
  CHECK(stretch.high == doctest::Approx(1.3f));
  const Range rest = natural_range(Field::volume_ratio, std::vector<float>(5, 1.0f));
  CHECK(rest.low < 1);
  CHECK(rest.high > 1);
}

TEST_CASE("the shown range follows at once, then smoothly, unless fixed") {
  ColourRange range;
  CHECK(range.update(Field::displacement, std::vector<float>{0.01f}, 0).high == doctest::Approx(0.01f));
  const float next = range.update(Field::displacement, std::vector<float>{0.02f}, 1 / 60.f).high;
  CHECK(next > 0.01f);
  CHECK(next < 0.02f);
  for (int i = 0; i < 60; ++i) range.update(Field::displacement, std::vector<float>{0.02f}, 1 / 60.f);
  CHECK(range.update(Field::displacement, std::vector<float>{0.02f}, 1 / 60.f).high == doctest::Approx(0.02f));
  CHECK(range.update(Field::von_mises, std::vector<float>{500}, 1 / 60.f).high == doctest::Approx(500));
  range.fix({0, 3});
  CHECK(range.update(Field::von_mises, std::vector<float>{500}, 1) == Range{0, 3});
}

TEST_CASE("labels carry the unit that suits the range") {
  CHECK(field_label(Field::displacement, {0, 0.01f}).unit == "mm");
  CHECK(field_label(Field::von_mises, {0, 400}).unit == "Pa");
  CHECK(field_label(Field::von_mises, {0, 4000}).unit == "kPa");
  CHECK(field_label(Field::stretch, {0.5f, 1.5f}).unit.empty());
}

TEST_CASE("ticks are few, round and inside the range") {
  for (const Range range : {Range{0, 8.3f}, Range{0.83f, 1.17f}, Range{0, 1}, Range{0, 1234}, Range{0, 3e-4f}}) {
    const std::vector<float> places = ticks(range);
    CHECK(places.size() >= 3);
    CHECK(places.size() <= 8);
    CHECK(places.front() >= range.low - 1e-4f * (range.high - range.low));
    CHECK(places.back() <= range.high + 1e-4f * (range.high - range.low));
  }
  CHECK(ticks({0, 8.3f}) == std::vector<float>{0, 2, 4, 6, 8});
  CHECK(ticks({0, 1e-44f}) == std::vector<float>{0});  // no step is that small
}

}  // namespace heml::field_colours_test
