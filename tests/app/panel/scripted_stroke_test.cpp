#include "app/panel/scripted_stroke.hpp"

#include <doctest/doctest.h>

namespace heml::scripted_stroke_test {

using panel::scripted_stroke;

TEST_CASE("the blade is where the last sweep ended, for a tenth of a second") {
  const Vec3 up = Vec3::UnitY();
  const auto sweep = [&](double from, double to) {
    return CutTissue{{{{Vec3(from, 0, 0), Vec3(from, 0, 0) + up}, {Vec3(to, 0, 0), Vec3(to, 0, 0) + up}}}, false};
  };
  const std::vector<Event> events{{100, sweep(0, 1)}, {120, sweep(1, 2)}, {125, Release{}}, {500, sweep(8, 7)}};
  CHECK_FALSE(scripted_stroke(events, 99, 1000).blade);
  const auto at = [&](long tick) { return scripted_stroke(events, tick, 1000).blade; };
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
  CHECK_FALSE(scripted_stroke({}, 10, 1000).blade);
}

TEST_CASE("an electrode is where it last burnt, in place of a blade") {
  const auto burn = [](const Vec3& at) { return CauterizeTissue{{{{at, at + Vec3(0, 0, -1)}}}, {1, 0.2}}; };
  const std::vector<Event> events{{100, burn(Vec3(1, 2, 3))}, {130, burn(Vec3(4, 5, 6))}};
  REQUIRE(scripted_stroke(events, 110, 1000).electrode);
  CHECK(scripted_stroke(events, 110, 1000).electrode->tip == Vec3f(1, 2, 3));
  CHECK(scripted_stroke(events, 130, 1000).electrode->tip == Vec3f(4, 5, 6));
  CHECK_FALSE(scripted_stroke(events, 130, 1000).blade);
  CHECK_FALSE(scripted_stroke(events, 231, 1000).electrode);
}

}  // namespace heml::scripted_stroke_test
