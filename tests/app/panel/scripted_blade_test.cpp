#include "app/panel/scripted_blade.hpp"

#include <doctest/doctest.h>

namespace heml::scripted_blade_test {

using panel::scripted_blade;

TEST_CASE("the blade is where the last sweep ended, for a tenth of a second") {
  const Vec3 up = Vec3::UnitY();
  const auto sweep = [&](double from, double to) {
    return CutTissue{{{{Vec3(from, 0, 0), Vec3(from, 0, 0) + up}, {Vec3(to, 0, 0), Vec3(to, 0, 0) + up}}}, false};
  };
  const std::vector<Event> events{{100, sweep(0, 1)}, {120, sweep(1, 2)}, {125, Release{}}, {500, sweep(8, 7)}};
  CHECK_FALSE(scripted_blade(events, 99, 1000));
  const auto at = [&](long tick) { return scripted_blade(events, tick, 1000); };
  REQUIRE(at(100));
  CHECK(at(100)->edge[0] == Vec3f(1, 0, 0));
  CHECK(at(100)->edge[1] == Vec3f(1, 1, 0));
  REQUIRE(at(130));
  CHECK(at(130)->edge[0] == Vec3f(2, 0, 0));
  CHECK(at(130)->heading.x() > 0);
  CHECK(at(220));
  CHECK_FALSE(at(221));
  REQUIRE(at(510));
  CHECK(at(510)->heading.x() < 0);
  CHECK_FALSE(scripted_blade({}, 10, 1000));
}

}  // namespace heml::scripted_blade_test
