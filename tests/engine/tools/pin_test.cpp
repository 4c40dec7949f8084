#include <doctest/doctest.h>

#include <heml/tools/pin.hpp>

namespace heml::pin_test {

namespace {
const std::vector<Vec3> rest = {{0, 0, 0}, {0.01, 0, 0}, {0.03, 0, 0}, {0, 0.02, 0}, {0, 0, 0.019}};
const std::vector<int> all = {0, 1, 2, 3, 4};
}  // namespace

TEST_CASE_TEMPLATE("a pin takes the free nodes within its radius at rest, each where it is now", Real, float, double) {
  const std::vector<Real> x = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  const PinnedPatch pin = pin_patch(0, 0.02, all, rest, x.data(), std::vector<Real>{1, 1, 1, 2, 0});  // node 4 is held
  CHECK(pin.center == 0);
  CHECK(pin.nodes == std::vector<int>{0, 1, 3});  // node 3 lies on the radius
  CHECK(pin.positions == std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}, {10, 11, 12}});
}

TEST_CASE("a pin without a radius takes its centre alone, and of a held centre nothing") {
  const std::vector<double> x(15, 0.5);
  CHECK(pin_patch(1, 0, all, rest, x.data(), std::vector<double>(5, 1)).nodes == std::vector<int>{1});
  CHECK(pin_patch(1, 0, all, rest, x.data(), std::vector<double>{1, 0, 1, 1, 1}).nodes.empty());
}

TEST_CASE_TEMPLATE("the force of a pin cancels all others on its nodes", Real, float, double) {
  const PinnedPatch pin{0, {0, 2}, {}};
  const std::vector<Real> f = {1, 2, 3, 100, 100, 100, -0.5, 4, 8};
  CHECK(pin_force(pin, f.data()) == Vec3(-0.5, -6, -11));
}

}  // namespace heml::pin_test
