#include "driver.hpp"

namespace heml::timeline_test {

using namespace heml::test;
using panel::Action;
using panel::Request;
using panel::Timeline;

namespace {

constexpr float bar_y = 735;  // pixels, in an image 760 high

/// A recording of ten seconds, of which five were seen.
Timeline half_way() {
  Timeline timeline;
  timeline.rate = 100;
  timeline.live = 500;
  timeline.end = 1000;
  timeline.frames = 300;
  timeline.bytes = 4'000'000;
  timeline.room = 256'000'000;
  return timeline;
}

/// The x at a share (0 to 1) of the track.
float place(Driver& driver, float share) {
  float first = -1, last = -1;
  for (float x = 280; x < 1020; x += 4) {
    driver.move({x, bar_y});
    driver.draw();
    if (driver.panel.hovered() != "Timeline") continue;
    if (first < 0) first = x;
    last = x;
  }
  REQUIRE(first >= 0);
  return first + share * (last - first);
}

}  // namespace

TEST_CASE("without a timeline there is no bar") {
  Driver driver;
  CHECK_FALSE(driver.panel.covers(640, bar_y));
  driver.panel.set_timeline(half_way());
  driver.draw();
  CHECK(driver.panel.covers(640, bar_y));
}

TEST_CASE("dragging the bar seeks past frames at once and later ticks on release") {
  Driver driver;
  driver.panel.set_timeline(half_way());
  const float past = place(driver, 0.3f), ahead = place(driver, 0.8f);
  driver.move({past, bar_y});
  driver.draw();
  driver.hold(true);
  auto actions = driver.draw();
  REQUIRE(actions.seek_to);
  CHECK(*actions.seek_to == doctest::Approx(300).epsilon(0.03));
  driver.move({past - 40, bar_y});
  actions = driver.draw();
  REQUIRE(actions.seek_to);
  CHECK(*actions.seek_to < 290);
  driver.move({ahead, bar_y});
  CHECK_FALSE(driver.draw().seek_to);
  driver.hold(false);
  actions = driver.draw();
  REQUIRE(actions.seek_to);
  CHECK(*actions.seek_to == doctest::Approx(800).epsilon(0.03));
  CHECK_FALSE(driver.draw().seek_to);
}

TEST_CASE("while a past frame is shown the bar has the buttons Resume and Live") {
  Driver driver;
  Timeline timeline = half_way();
  timeline.shown = 200;
  driver.panel.set_timeline(timeline);
  const auto press = [&](const char* name) {
    for (float x = 900; x < 1020; x += 4) {
      driver.move({x, bar_y});
      driver.draw();
      if (driver.panel.hovered() == name) return driver.click().requests;
    }
    return std::vector<Request>();
  };
  CHECK(press("Resume") == std::vector{Request::resume});
  CHECK(press("Live") == std::vector{Request::live});
  driver.panel.perform(Action::release);
  CHECK(driver.draw().requests == std::vector{Request::live});
  driver.panel.set_timeline(half_way());
  driver.panel.perform(Action::release);
  CHECK(driver.draw().requests == std::vector{Request::release});
}

TEST_CASE("a click shows the frame that the tooltip tells, and the track stays where it is") {
  Driver driver;
  Timeline timeline = half_way();
  timeline.moment_at = [](long tick) { return panel::TimelineMoment{tick / 40 * 40, 0.1}; };  // frames 40 ticks apart
  driver.panel.set_timeline(timeline);
  const float here = place(driver, 0.33f);
  driver.move({here, bar_y});
  const auto actions = driver.click();
  REQUIRE(actions.seek_to);
  CHECK(*actions.seek_to == 320);
  timeline.shown = 320;
  driver.panel.set_timeline(timeline);
  CHECK(place(driver, 0.33f) == here);
}

TEST_CASE("the whole knob at the end of the track takes the mouse") {
  Driver driver;
  Timeline timeline = half_way();
  timeline.live = timeline.end;
  driver.panel.set_timeline(timeline);
  int wide = 0;  // pixels
  for (float x = 780; x < 1020; ++x) {
    driver.move({x, bar_y});
    driver.draw();
    if (driver.panel.hovered() != "Timeline") continue;
    const auto actions = driver.click();
    wide += actions.seek_to && *actions.seek_to == timeline.end;
  }
  CHECK(wide >= 6);  // of a knob 14 wide the half beyond the track
}

TEST_CASE("Esc, End and a button of the bar end fast-forwarding") {
  Driver driver;
  Timeline timeline = half_way();
  timeline.fast_forward_target = 800;
  driver.panel.set_timeline(timeline);
  driver.panel.perform(Action::release);
  CHECK(driver.draw().requests == std::vector{Request::live});
  float x = 860;
  for (; x < 1020; x += 4) {
    driver.move({x, bar_y});
    driver.draw();
    if (driver.panel.hovered() == "Stop here") break;
  }
  CHECK(driver.click().requests == std::vector{Request::live});
}

TEST_CASE("the track is long enough to be used in a narrow image with large text") {
  Driver driver(small_scene(), 800, 500, 1.44f);
  driver.panel.set_timeline(half_way());
  driver.draw();
  int longest = 0;  // pixels
  for (float y = 400; y < 500; y += 4) {
    int here = 0;
    for (float x = 400; x < 800; x += 4) {
      driver.move({x, y});
      driver.draw();
      if (driver.panel.hovered() == "Timeline") here += 4;
    }
    longest = std::max(longest, here);
  }
  CHECK(longest > 200);
}

TEST_CASE("keys seek frames, the start and live, resume, and record a video") {
  Driver driver;
  for (const auto& [action, request] :
       {std::pair(Action::seek_previous, Request::previous_frame), std::pair(Action::seek_next, Request::next_frame),
        std::pair(Action::seek_start, Request::first_frame), std::pair(Action::seek_live, Request::live),
        std::pair(Action::resume, Request::resume), std::pair(Action::record_video, Request::record_video)}) {
    driver.panel.perform(action);
    CHECK(driver.draw().requests == std::vector{request});
  }
}

}  // namespace heml::timeline_test
