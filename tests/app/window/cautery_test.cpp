#include "app/window/cautery.hpp"

#include <doctest/doctest.h>

#include "sheet.hpp"

namespace heml::cautery_test {

using namespace heml::window;

namespace {

/// A square sheet in z = 0 that faces the camera at +z.
struct Bench : test::Sheet {
  Cautery cautery{controller};
  panel::ToolSettings tool;
  std::vector<Command> commands;

  Bench() {
    tool.burn_radius = 0.01;
    tool.burn_depth = 0.02;
    tool.shrink = 0.3;
  }
  std::optional<render::Hit> hit(const Vec3f& point) const {
    return render::pick(frame, surface_mesh, controller.ray(controller.pixel(point)));
  }
  void press(const Vec3f& point) {
    REQUIRE(hit(point));
    cautery.press(*hit(point), controller.pixel(point), tool, commands);
  }
  void drag(const Vec3f& point) { cautery.drag(controller.pixel(point), hit(point), commands); }
  const CauterizeTissue& burn(std::size_t k) const { return std::get<CauterizeTissue>(commands.at(k)); }

  /// Where an electrode meets the sheet.
  Vec3 on_sheet(std::size_t k, std::size_t blade) const {
    const auto& [upper, lower] = burn(k).sweep.blades.at(blade);
    if (upper.z() == lower.z()) return upper;
    return upper + upper.z() / (upper.z() - lower.z()) * (lower - upper);
  }
};

}  // namespace

TEST_CASE("a press burns a spot with the settings of the tool, as deep as the electrode reaches") {
  Bench bench;
  bench.press({0.02f, -0.01f, 0});
  REQUIRE(bench.commands.size() == 1);
  const CauterizeTissue& spot = bench.burn(0);
  CHECK_FALSE(spot.continues_stroke);
  CHECK(spot.heat.radius == 0.01);
  CHECK(spot.heat.shrink == 0.3);
  REQUIRE(spot.sweep.blades.size() == 1);
  CHECK((bench.on_sheet(0, 0) - Vec3(0.02, -0.01, 0)).norm() < 1e-5);
  const auto& [upper, lower] = spot.sweep.blades[0];
  CHECK(upper.z() > 0);
  CHECK((lower - bench.on_sheet(0, 0)).norm() == doctest::Approx(0.02).epsilon(1e-3));
}

TEST_CASE("a drag goes on from where it last burnt, one stroke, and each press begins another") {
  Bench bench;
  bench.press({-0.05f, 0, 0});
  for (const float x : {-0.02f, 0.01f, 0.04f}) bench.drag({x, 0, 0});
  REQUIRE(bench.commands.size() == 4);
  for (std::size_t k = 1; k < 4; ++k) {
    CHECK(bench.burn(k).continues_stroke);
    REQUIRE(bench.burn(k).sweep.blades.size() == 2);
    CHECK(bench.burn(k).sweep.blades[0] == bench.burn(k - 1).sweep.blades.back());
  }
  CHECK((bench.on_sheet(3, 1) - Vec3(0.04, 0, 0)).norm() < 1e-5);
  bench.press({0, 0, 0});
  CHECK_FALSE(bench.burn(4).continues_stroke);
}

TEST_CASE("a tremble of the mouse burns nothing more, and neither does its way beside the tissue") {
  Bench bench;
  bench.press({0.05f, 0, 0});
  bench.drag({0.0501f, 0, 0});
  CHECK(bench.commands.size() == 1);
  bench.drag({0.3f, 0, 0});
  bench.drag({0.3f, 0.05f, 0});
  CHECK(bench.commands.size() == 1);
  bench.drag({0.05f, 0.05f, 0});  // back on the sheet: a spot, not a line from where it left
  REQUIRE(bench.commands.size() == 2);
  CHECK(bench.burn(1).sweep.blades.size() == 1);
  CHECK(bench.burn(1).continues_stroke);
  bench.drag({0.0f, 0.05f, 0});
  CHECK(bench.burn(2).sweep.blades.size() == 2);
}

TEST_CASE("without depth the electrode is its tip on the skin") {
  Bench bench;
  bench.tool.burn_depth = 0;
  bench.press({0.02f, 0.01f, 0});
  bench.drag({0.05f, 0.01f, 0});
  for (std::size_t k = 0; k < 2; ++k)
    for (const auto& [upper, lower] : bench.burn(k).sweep.blades) {
      CHECK(upper == lower);
      CHECK(std::abs(upper.z()) < 1e-6);
    }
  REQUIRE(bench.cautery.drawing().electrode);
  CHECK((bench.cautery.drawing().electrode->tip - Vec3f(0.05f, 0.01f, 0)).norm() < 1e-5f);
}

}  // namespace heml::cautery_test
