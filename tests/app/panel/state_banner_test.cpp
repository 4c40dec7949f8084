#include "app/panel/state_banner.hpp"

#include <doctest/doctest.h>

namespace heml::state_banner_test {

using panel::BannerPress;
using panel::StateBanner;

namespace {

/// A recovery that began at a tick and goes on.
Frame recovering(long tick, double min_J) {
  Frame frame;
  frame.recovery.emplace();
  frame.recovery->tick = tick;
  frame.recovery->message = "element 3 was flat or inside out";
  frame.min_J = min_J;
  return frame;
}

/// Shows it for so much simulated and wall time, s, while its lowest J changes by so much a second.
void show(StateBanner& banner, Frame& frame, double seconds, double change = 0) {
  constexpr double interval = 0.05;
  for (double t = 0; t < seconds; t += interval) {
    frame.time += interval;
    frame.min_J += interval * change;
    banner.update(frame, static_cast<float>(interval));
  }
}

std::string title(StateBanner& banner, const Frame& frame) {
  const auto shown = banner.choose(frame, Integrator::verlet, 0, std::nullopt);
  return shown ? shown->title : "";
}

}  // namespace

TEST_CASE("the banner says that tissue recovers while it does, and that it has for a while") {
  StateBanner banner;
  Frame frame = recovering(10, -0.9);
  show(banner, frame, 5, 0.1);
  CHECK(title(banner, frame) == "Recovering the tissue");
  frame.recovery->ended.emplace();
  show(banner, frame, 1);
  CHECK(title(banner, frame) == "Tissue recovered");
  show(banner, frame, 10);
  CHECK(title(banner, frame).empty());
}

TEST_CASE("the banner says that tissue stays inverted where nothing recovers any more, until it is dismissed") {
  StateBanner banner;
  Frame frame = recovering(10, -1);
  show(banner, frame, 1);
  CHECK(title(banner, frame) == "Recovering the tissue");
  show(banner, frame, 5);
  CHECK(title(banner, frame) == "Tissue stays inverted");
  CHECK(banner.shows_recovery());
  banner.take(BannerPress::close, frame);
  CHECK_FALSE(banner.shows_recovery());
  show(banner, frame, 5);
  CHECK(title(banner, frame).empty());

  Frame next = recovering(5000, -0.5);
  next.time = frame.time;
  show(banner, next, 1, 0.1);
  CHECK(title(banner, next) == "Recovering the tissue");
  next.min_J = 0.1;
  show(banner, next, 5);
  CHECK(title(banner, next) == "Tissue stays nearly flat");
}

TEST_CASE("a body is not called slow while it is fast-forwarded") {
  StateBanner banner;
  Frame frame;
  frame.pace.keeping_up = false;
  frame.pace.slowdown = 3;
  frame.fast_forward_target = 1000;
  show(banner, frame, 5);
  CHECK(title(banner, frame).empty());
  frame.fast_forward_target = 0;
  show(banner, frame, 5);
  CHECK(title(banner, frame) == "3.0× slower than real time");
}

}  // namespace heml::state_banner_test
