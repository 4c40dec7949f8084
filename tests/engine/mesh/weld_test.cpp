#include <doctest/doctest.h>

#include <heml/mesh/weld.hpp>

namespace heml::weld_test {

TEST_CASE("vertices at the same place are named by the first of them") {
  const std::vector<Vec3f> positions{{1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1e-30f}};
  CHECK(weld(positions) == std::vector<std::uint32_t>{0, 1, 0, 3, 0, 5});
}

}  // namespace heml::weld_test
