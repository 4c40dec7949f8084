#include "app/window/scissors.hpp"

#include <doctest/doctest.h>

#include "sheet.hpp"

namespace heml::scissors_test {

using namespace heml::window;

namespace {

/// A square sheet in z = 0 that faces the camera at +z.
struct Bench : test::Sheet {
  std::optional<render::SectionPlane> section;
  Scissors scissors{controller};
  panel::ToolSettings tool;
  std::vector<Command> commands;

  Bench() {
    tool.jaw_length = 0.03;
    tool.jaw_opening = 0.02;
    tool.jaw_direction = 90;
  }
  render::Vec2f pixel(const Vec3f& point) const { return controller.pixel(point); }
  Scissors::Scene scene() const { return {frame, surface_mesh, section}; }
  void press(const Vec3f& point) {
    const auto hit = render::pick(frame, surface_mesh, controller.ray(pixel(point)));
    REQUIRE(hit);
    scissors.press(*hit, pixel(point), tool, scene());
  }
  void drag(const Vec3f& point) { scissors.drag(pixel(point), scene(), commands); }
  void release() { scissors.release(scene(), commands); }

  /// Where a piece begins (0) or ends (1) on the sheet.
  Vec3 on_sheet(std::size_t piece, std::size_t blade) const {
    const auto& [upper, lower] = std::get<CutTissue>(commands.at(piece)).sweep.blades.at(blade);
    return upper + upper.z() / (upper.z() - lower.z()) * (lower - upper);
  }
};

}  // namespace

TEST_CASE("a click closes the scissors once: a cut from the pointer along the jaw line, as deep as they open") {
  Bench bench;
  for (const auto& [degrees, along] : {std::pair(90.0, Vec3(0, 1, 0)), std::pair(180.0, Vec3(-1, 0, 0))}) {
    bench.commands.clear();
    bench.tool.jaw_direction = degrees;
    bench.press({0.02f, -0.01f, 0});
    CHECK(bench.commands.empty());
    bench.release();
    REQUIRE(bench.commands.size() == 1);
    CHECK_FALSE(std::get<CutTissue>(bench.commands[0]).continues_stroke);
    CHECK((bench.on_sheet(0, 0) - Vec3(0.02, -0.01, 0)).norm() < 1e-5);
    CHECK((bench.on_sheet(0, 1) - Vec3(0.02, -0.01, 0) - 0.03 * along).norm() < 1e-5);
    for (const auto& [upper, lower] : std::get<CutTissue>(bench.commands[0]).sweep.blades) {
      CHECK(upper.z() > 0.001);
      CHECK(lower.z() < -0.018);
      CHECK(lower.z() > -0.0201);
    }
  }
}

TEST_CASE("a drag snips on in pieces of the jaws' length that join, in one stroke, and letting go cuts the rest") {
  Bench bench;
  bench.press({-0.05f, 0, 0});
  bench.drag({-0.03f, 0, 0});
  CHECK(bench.commands.empty());  // not yet a jaw's length
  bench.drag({-0.015f, 0, 0});
  CHECK(bench.commands.size() == 1);
  bench.drag({0.05f, 0, 0});  // one fast movement: two pieces
  REQUIRE(bench.commands.size() == 3);
  bench.release();
  REQUIRE(bench.commands.size() == 4);
  for (std::size_t k = 0; k < 4; ++k) {
    CHECK((bench.on_sheet(k, 0) - Vec3(-0.05 + 0.03 * static_cast<double>(k), 0, 0)).norm() < 2e-4);
    CHECK(std::get<CutTissue>(bench.commands[k]).continues_stroke == (k > 0));
    if (k > 0)
      CHECK(std::get<CutTissue>(bench.commands[k - 1]).sweep.blades[1] ==
            std::get<CutTissue>(bench.commands[k]).sweep.blades[0]);
  }
  CHECK((bench.on_sheet(3, 1) - Vec3(0.05, 0, 0)).norm() < 2e-4);
  bench.commands.clear();
  bench.press({0, 0.05f, 0});
  bench.release();
  CHECK_FALSE(std::get<CutTissue>(bench.commands.at(0)).continues_stroke);  // the next press: another stroke
}

TEST_CASE("a drag off the body cuts through its edge, and movements without end are bounded") {
  Bench bench;
  bench.press({0.09f, 0, 0});
  bench.drag({0.13f, 0, 0});
  REQUIRE(bench.commands.size() == 1);
  CHECK(bench.on_sheet(0, 1).x() > 0.11);
  bench.tool.jaw_length = 1e-7;
  bench.press({0, 0, 0});
  bench.commands.clear();
  bench.drag({0.05f, 0, 0});
  CHECK(bench.commands.size() <= 100);
}

TEST_CASE("the drawn jaws point along the jaw line, along a drag once there is one, and close on its way") {
  Bench bench;
  const auto hit = render::pick(bench.frame, bench.surface_mesh, bench.controller.ray(bench.pixel({0, 0, 0})));
  const render::Scissors open = bench.scissors.over(*hit, bench.tool);
  CHECK((open.to - open.from - Vec3f(0, 0.03f, 0)).norm() < 1e-6f);
  CHECK(open.closed == 0);
  bench.press({0, 0, 0});
  CHECK(bench.scissors.drawing(bench.frame, bench.surface_mesh).scissors->closed == 0);
  bench.drag({0.015f, 0, 0});
  render::StrokeDrawing half = bench.scissors.drawing(bench.frame, bench.surface_mesh);
  CHECK((half.scissors->to - half.scissors->from - Vec3f(0.03f, 0, 0)).norm() < 1e-5f);
  CHECK(half.scissors->closed == doctest::Approx(0.5).epsilon(0.01));
  CHECK(half.line.empty());
  bench.drag({0.04f, 0, 0});
  CHECK(bench.scissors.drawing(bench.frame, bench.surface_mesh).line.size() == 1);
}

}  // namespace heml::scissors_test
