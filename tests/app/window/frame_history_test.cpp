#include <doctest/doctest.h>

#include <app/window/frame_history.hpp>
#include <heml/scenario/skin.hpp>

namespace heml::frame_history_test {

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

TEST_CASE("frames are found by their tick") {
  FrameHistory history;
  for (const long tick : {3l, 5l, 9l}) history.add(at(tick));
  REQUIRE(history.frames().size() == 3);
  CHECK(history.index_at(0) == 0);
  CHECK(history.index_at(3) == 0);
  CHECK(history.index_at(8) == 1);
  CHECK(history.index_at(1000) == 2);
}

TEST_CASE("a frame of the same tick replaces the last and an earlier one is ignored") {
  FrameHistory history;
  history.add(at(4));
  history.add(at(7, 1));
  history.add(at(7, 2));
  history.add(at(5));
  REQUIRE(history.frames().size() == 2);
  CHECK(history.frames().back().commands == 2);
}

TEST_CASE("the memory limit is kept and the whole session stays covered") {
  constexpr std::size_t room = 100'000;
  FrameHistory history(room);
  for (long tick = 0; tick < 20'000; ++tick) {
    history.add(at(tick));
    CHECK_MESSAGE(history.bytes() <= room, tick);
  }
  CHECK(history.bytes() > room / 4);
  const auto& frames = history.frames();
  CHECK(frames.front().tick == 0);
  const long gap = 20'000 / std::ssize(frames);
  CHECK(frames.back().tick > 20'000 - 3 * gap);
  for (std::size_t k = 1; k < frames.size(); ++k) CHECK(frames[k].tick - frames[k - 1].tick <= 3 * gap);
}

TEST_CASE("skins of cut bodies count once each, and are dropped with the frames that have them") {
  constexpr std::size_t room = 1'000'000;
  FrameHistory history(room);
  std::vector<std::weak_ptr<const Skin>> skins;
  for (long tick = 0; tick < 400; ++tick) {
    Frame frame = at(tick);
    if (tick % 4 == 0) {  // a cut every fourth tick
      Skin skin;
      skin.surface.mesh.nodes.resize(1000);
      skin.anchors.resize(1000);
      frame.skin = std::make_shared<const Skin>(std::move(skin));
      skins.push_back(frame.skin);
    } else {
      frame.skin = history.frames().back().skin;
    }
    history.add(frame);
    CHECK(history.bytes() <= room);
  }
  const auto left = std::count_if(skins.begin(), skins.end(), [](const auto& skin) { return !skin.expired(); });
  CHECK(left >= 4);
  CHECK(left * 1000 * static_cast<long>(sizeof(Vec3) + sizeof(SkinAnchor)) <= static_cast<long>(room));
  history.cut_after(-1);
  CHECK(history.bytes() == 0);
}

TEST_CASE("frames after a tick are dropped") {
  FrameHistory history;
  for (long tick = 0; tick < 10; ++tick) history.add(at(tick));
  const std::size_t before = history.bytes();
  history.cut_after(4);
  CHECK(history.frames().size() == 5);
  CHECK(history.frames().back().tick == 4);
  CHECK(history.bytes() == before / 2);
}

TEST_CASE("frames of one version share the newest surface mesh, and comparison runs of one variant too") {
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
  FrameHistory history;
  for (const Frame& frame : {with(1, 0, "ogden"), with(2, 1, "ogden"), with(3, 1, "stvk")}) history.add(frame);
  const Frame newest = with(9, 1, "ogden");
  history.share(newest);
  const auto& frames = history.frames();
  CHECK(frames[0].surface_mesh != newest.surface_mesh);
  CHECK(frames[0].comparisons[0].surface_mesh != newest.comparisons[0].surface_mesh);
  for (const std::size_t k : {1, 2}) CHECK(frames[k].surface_mesh == newest.surface_mesh);
  CHECK(frames[1].comparisons[0].surface_mesh == newest.comparisons[0].surface_mesh);
  CHECK(frames[2].comparisons[0].surface_mesh != newest.comparisons[0].surface_mesh);
}

}  // namespace heml::frame_history_test
