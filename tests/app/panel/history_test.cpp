#include <doctest/doctest.h>

#include <app/panel/history.hpp>

namespace heml::history_test {

using panel::History;

namespace {
Frame at(double time, double kinetic = 0) {
  Frame frame;
  frame.time = time;
  frame.energies.kinetic = kinetic;
  return frame;
}
}  // namespace

TEST_CASE("history keeps the last seconds and no more points than a plot can show") {
  History history;
  for (int k = 0; k <= 30000; ++k) history.add(at(0.001 * k, k));
  const auto& readings = history.readings();
  CHECK(readings.size() <= 241);
  CHECK(readings.size() > 200);
  CHECK(readings.front().time >= readings.back().time - History::span);
  CHECK(readings.back().time > 30 - History::span / 100);
  for (std::size_t i = 1; i < readings.size(); ++i) CHECK(readings[i].time > readings[i - 1].time);
}

TEST_CASE("history starts afresh after a reset") {
  History history;
  history.add(at(1, 5));
  history.add(at(2, 6));
  history.add(at(0, 7));
  REQUIRE(history.readings().size() == 1);
  CHECK(history.readings().front().energies.kinetic == 7);
}

TEST_CASE("the force of a person's hands is that of the hand that pulls most, clamps apart") {
  CHECK_FALSE(panel::force_of_hands({}));
  const auto of = [](int hand, double newtons) { return GraspState{.hand = hand, .force = Vec3(0, newtons, 0)}; };
  CHECK_FALSE(panel::force_of_hands({of(1, 9)}));
  CHECK(panel::force_of_hands({of(0, 2), of(1, 9), of(14, 3), of(15, 1)}) == 3);
  CHECK(panel::force_of_hands({of(0, 2)}) == 2);
}

TEST_CASE("history records no force of an inactive tool") {
  History history;
  Frame frame = at(1);
  history.add(frame);
  CHECK(history.readings().back().force == 0);
  frame.time = 2;
  frame.tools.push_back(GraspState{.force = Vec3(3, 4, 0)});
  history.add(frame);
  CHECK(history.readings().back().force == 5);
}

TEST_CASE("history ignores frames of an earlier tick") {
  History history;
  Frame now = at(2), before = at(1);
  now.tick = 200;
  before.tick = 100;
  history.add(now);
  history.add(before);
  CHECK(history.readings().size() == 1);
  CHECK(history.readings().back().time == 2);
}

}  // namespace heml::history_test
