#include "app/render/weld.hpp"

#include <doctest/doctest.h>

namespace heml::weld_test {

TEST_CASE("vertices at the same place are named by the first of them") {
  const std::vector<Vec3f> positions{{1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1e-30f}};
  CHECK(render::weld(positions) == std::vector<std::uint32_t>{0, 1, 0, 3, 0, 5});
}

}  // namespace heml::weld_test
