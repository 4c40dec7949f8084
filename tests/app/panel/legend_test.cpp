#include <doctest/doctest.h>

#include <app/panel/legend.hpp>

namespace heml::legend_test {

using panel::legend_range;

TEST_CASE("the legend starts at 0 for stretch and below 0 only for inverted volume ratios") {
  const render::Range wide{-1.5f, 3.5f};
  CHECK(legend_range(Field::stretch, wide, false).low == 0);
  CHECK(legend_range(Field::stretch, wide, true).low == 0);
  CHECK(legend_range(Field::volume_ratio, wide, false).low == 0);
  CHECK(legend_range(Field::volume_ratio, wide, true).low == -1.5f);
  CHECK(legend_range(Field::volume_ratio, {0.9f, 1.1f}, false).low == 0.9f);
  CHECK(legend_range(Field::stretch, wide, false).high == 3.5f);
}

}  // namespace heml::legend_test
