#include <doctest/doctest.h>

#include <app/window/frame_history.hpp>

namespace heml::seen_frames_test {

using window::FrameHistory;

namespace {
Frame at(long tick, long commands = 0) {
  Frame frame;
  frame.tick = tick;
  frame.commands = commands;
  frame.positions.resize(100);
  return frame;
}
}  // namespace

TEST_CASE("what was seen is found again by its tick") {
  FrameHistory seen;
  for (const long tick : {3l, 5l, 9l}) seen.add(at(tick));
  REQUIRE(seen.frames().size() == 3);
  CHECK(seen.place_of(0) == 0);
  CHECK(seen.place_of(3) == 0);
  CHECK(seen.place_of(8) == 1);
  CHECK(seen.place_of(1000) == 2);
}

TEST_CASE("a frame of the same tick replaces the last, one of the past is not taken") {
  FrameHistory seen;
  seen.add(at(4));
  seen.add(at(7, 1));
  seen.add(at(7, 2));
  seen.add(at(5));
  REQUIRE(seen.frames().size() == 2);
  CHECK(seen.frames().back().commands == 2);
}

TEST_CASE("the room is never exceeded, and the whole session stays") {
  constexpr std::size_t room = 100'000;
  FrameHistory seen(room);
  for (long tick = 0; tick < 20'000; ++tick) {
    seen.add(at(tick));
    CHECK_MESSAGE(seen.bytes() <= room, tick);
  }
  CHECK(seen.bytes() > room / 4);
  const auto& frames = seen.frames();
  CHECK(frames.front().tick == 0);
  const long gap = 20'000 / std::ssize(frames);
  CHECK(frames.back().tick > 20'000 - 3 * gap);
  for (std::size_t k = 1; k < frames.size(); ++k) CHECK(frames[k].tick - frames[k - 1].tick <= 3 * gap);
}

TEST_CASE("what is later than a moment can be forgotten") {
  FrameHistory seen;
  for (long tick = 0; tick < 10; ++tick) seen.add(at(tick));
  const std::size_t before = seen.bytes();
  seen.cut_after(4);
  CHECK(seen.frames().size() == 5);
  CHECK(seen.frames().back().tick == 4);
  CHECK(seen.bytes() == before / 2);
}

TEST_CASE("frames of one version share the newest skins, what is beside too where it is of the same way") {
  const auto surface_mesh = [](long version) {
    auto made = std::make_shared<SurfaceMesh>();
    made->version = version;
    return made;
  };
  const auto with = [&](long tick, long version, const char* variant) {
    Frame frame = at(tick), comparisons = at(tick);
    comparisons.surface_mesh = surface_mesh(version);
    comparisons.variant = variant;
    frame.surface_mesh = surface_mesh(version);
    frame.comparisons = {comparisons};
    return frame;
  };
  FrameHistory seen;
  for (const Frame& frame : {with(1, 0, "ogden"), with(2, 1, "ogden"), with(3, 1, "stvk")}) seen.add(frame);
  const Frame newest = with(9, 1, "ogden");
  seen.share(newest);
  const auto& frames = seen.frames();
  CHECK(frames[0].surface_mesh != newest.surface_mesh);
  CHECK(frames[0].comparisons[0].surface_mesh != newest.comparisons[0].surface_mesh);
  for (const std::size_t k : {1, 2}) CHECK(frames[k].surface_mesh == newest.surface_mesh);
  CHECK(frames[1].comparisons[0].surface_mesh == newest.comparisons[0].surface_mesh);
  CHECK(frames[2].comparisons[0].surface_mesh != newest.comparisons[0].surface_mesh);
}

}  // namespace heml::seen_frames_test
