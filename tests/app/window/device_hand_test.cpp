#include <doctest/doctest.h>

#include <app/window/device_hand.hpp>
#include <app/window/mouse_tool.hpp>

#include "sheet.hpp"

namespace heml::device_hand_test {

using namespace heml::window;

namespace {

constexpr float picture = 1.0f / 60;  // s

/// A square of two triangles that faces the camera at +z; node 3 is constrained.
struct Sheet : test::Sheet {
  DeviceHand hand{first_device_hand, controller};
  std::vector<Command> commands;
  std::optional<render::SectionPlane> section;
  std::string problem;
  double radius = 0.02;
  bool moves_view = false;

  Sheet() { surface_mesh.constrained = {3}; }
  DeviceHand::Scene scene() const { return {frame, surface_mesh, section, radius}; }
  void play(const HandState& state, float seconds = picture, int pictures = 1) {
    for (int k = 0; k < pictures; ++k) {
      hand.adopt(state);
      problem = hand.act(seconds, moves_view, scene(), commands).message();
    }
  }
  /// A button goes down and up.
  void press(HandState state) {
    play(state);
    play({});
  }
  void grasp() { press({.grasp = true}); }
  void clamp() { press({.clamp = true}); }
  Vec3f tip() const { return hand.hold() ? hand.hold()->hand : *hand.free_tip(); }
  /// Moves the tips there, by small steps of full deflection or less.
  void go_to(const Vec3f& place) {
    for (int k = 0; k < 3000; ++k) {
      const Vec3f way = place - tip();
      if (way.norm() < 1e-4f) return;
      const auto axis = [](float along) { return std::clamp(20 * along, -1.0f, 1.0f); };
      play({.move = {axis(way.x()), axis(way.y()), axis(way.z())}});
    }
    FAIL("it does not get there");
  }
  /// Shows the grasp in the frame, as the session does after some ticks.
  void show(const Grasp& grasp, const Vec3& target) {
    frame.tools.emplace_back(
        GraspState{.hand = grasp.hand, .serial = 1, .node = grasp.node, .radius = grasp.radius, .target = target});
  }
};

template <class C>
const C& only(const std::vector<Command>& commands) {
  REQUIRE(commands.size() == 1);
  REQUIRE(std::holds_alternative<C>(commands[0]));
  return std::get<C>(commands[0]);
}

}  // namespace

TEST_CASE("a device's hand appears before the tissue when the device moves, not before") {
  Sheet sheet;
  CHECK_FALSE(sheet.hand.adopt({}));
  sheet.play({}, picture, 10);
  CHECK_FALSE(sheet.hand.is_shown());
  CHECK_FALSE(sheet.hand.free_tip());
  CHECK(sheet.hand.adopt({.move = {0.1f, 0, 0}}));
  sheet.play({.move = {0.1f, 0, 0}});
  REQUIRE(sheet.hand.free_tip());
  CHECK(std::abs(sheet.tip().x()) < 0.01f);
  CHECK(sheet.tip().z() > 0.005f);
  CHECK(sheet.hand.adopt({}));  // what ends is drawn too
  CHECK_FALSE(sheet.hand.adopt({}));
  CHECK(sheet.commands.empty());
}

TEST_CASE("a device's hand crosses the body in about two seconds, however long pictures take") {
  for (const int pictures : {12, 60, 144}) {  // in a second
    CAPTURE(pictures);
    const float seconds = 1 / static_cast<float>(pictures);
    Sheet sheet;
    sheet.play({.move = {0, 0.5f, 0}}, 0);
    const Vec3f before = sheet.tip();
    sheet.play({.move = {1, 0, 0}}, seconds, pictures);
    const Vec3f way = sheet.tip() - before;
    CHECK(way.x() > 0.08f);  // half of 0.2 m, and the air round the body
    CHECK(way.x() < 0.2f);
    CHECK(std::abs(way.y()) < 1e-5f);
    CHECK(std::abs(way.z()) < 1e-5f);
    Sheet other;
    other.play({.move = {0, 0.5f, 0}}, 0);
    other.play({.move = {1, 0, 0}}, 1.0f / 30, 30);
    CHECK(sheet.tip().x() == doctest::Approx(static_cast<double>(other.tip().x())).epsilon(1e-4));
  }
}

TEST_CASE("a device's hand moves slower where the view is nearer, and no further than a tenth of a second at once") {
  Sheet far, near;
  near.controller.zoom(10);
  for (Sheet* each : {&far, &near}) each->play({.move = {0.5f, 0, 0}}, 0);
  const Vec3f start = far.tip(), begun = near.tip();
  for (Sheet* each : {&far, &near}) each->play({.move = {1, 0, 0}}, 0.05f);
  CHECK((near.tip() - begun).norm() < 0.5f * (far.tip() - start).norm());
  Sheet stalled;
  stalled.play({.move = {0.5f, 0, 0}}, 0);
  stalled.play({.move = {1, 0, 0}}, 20);
  CHECK((stalled.tip() - start).norm() == doctest::Approx(2 * static_cast<double>((far.tip() - start).norm())));
}

TEST_CASE("a device's hand stays in view, and within reach in depth") {
  Sheet sheet;
  for (const Vec3f& way : {Vec3f(1, 0, 0), Vec3f(-1, 0, 0), Vec3f(0, 1, 0), Vec3f(0, -1, 0)}) {
    sheet.play({.move = way}, 0.1f, 200);
    const render::Vec2f at = sheet.controller.pixel(sheet.tip());
    CHECK(at.x() > -0.5f);
    CHECK(at.x() < 640.5f);
    CHECK(at.y() > -0.5f);
    CHECK(at.y() < 360.5f);
  }
  sheet.play({.move = {0, 0, 1}}, 0.1f, 200);
  CHECK(sheet.tip().z() > 0.1f);
  CHECK(sheet.tip().z() < 0.9f * sheet.controller.camera().eye().z());
  sheet.play({.move = {0, 0, -1}}, 0.1f, 200);
  CHECK(sheet.tip().z() < -0.1f);
  CHECK(sheet.tip().z() > -1);
}

TEST_CASE("a device's hand grasps the tissue at its tips, pulls it, and lets go") {
  Sheet sheet;
  sheet.play({.move = {0.1f, 0, 0}});
  sheet.go_to({0.08f, -0.07f, 0.01f});
  CHECK(sheet.commands.empty());
  REQUIRE(sheet.hand.in_reach(sheet.scene()));
  CHECK((sheet.hand.in_reach(sheet.scene())->point - Vec3f(0.08f, -0.07f, 0)).norm() < 2e-4f);
  sheet.grasp();
  const Grasp grasp = only<Grasp>(sheet.commands);
  CHECK(grasp.node == 21);
  CHECK(grasp.radius == 0.02);
  CHECK(grasp.hand == first_device_hand);
  CHECK(sheet.hand.holds());
  CHECK_FALSE(sheet.hand.free_tip());
  CHECK(std::abs(sheet.tip().z()) < 1e-6f);  // the tips have closed on it
  CHECK(sheet.hand.hold()->number == first_device_hand);

  sheet.commands.clear();
  sheet.play({});
  CHECK(sheet.commands.empty());  // a hand that rests sends nothing
  const Vec3f before = sheet.tip();
  sheet.play({.move = {0, 0, 1}});
  const MoveTool move = only<MoveTool>(sheet.commands);
  CHECK(move.hand == first_device_hand);
  // The node goes as far as the tips: no jump where it was grasped beside it.
  CHECK((move.target - Vec3(0.1, -0.1, 0) - (sheet.tip() - before).cast<double>()).norm() < 1e-6);
  CHECK(sheet.tip().z() > 0);

  sheet.commands.clear();
  sheet.grasp();
  CHECK(only<Release>(sheet.commands).hand == first_device_hand);
  CHECK_FALSE(sheet.hand.holds());
  CHECK(sheet.hand.free_tip());
}

TEST_CASE("a button that went down and up between two pictures counts once, and one that stays down too") {
  Sheet sheet;
  sheet.play({.move = {0.1f, 0, 0}});
  sheet.go_to({0.05f, 0, 0.005f});
  sheet.hand.adopt({.grasp = true});
  sheet.hand.adopt({});
  sheet.play({});
  only<Grasp>(sheet.commands);
  sheet.commands.clear();
  sheet.play({.grasp = true}, picture, 20);
  only<Release>(sheet.commands);
}

TEST_CASE("a device's hand says why it grasps nothing") {
  Sheet sheet;
  sheet.play({.move = {0.1f, 0, 0}});
  sheet.go_to({0.05f, 0, 0.1f});
  CHECK_FALSE(sheet.hand.in_reach(sheet.scene()));
  sheet.play({.grasp = true});
  CHECK(sheet.problem.find("No tissue is in reach") != std::string::npos);
  sheet.play({});
  sheet.go_to({-0.099f, 0.099f, 0.001f});
  sheet.surface_mesh.constrained = {0, 1, 2, 3};
  sheet.play({.grasp = true});
  CHECK(sheet.problem.find("constrained") != std::string::npos);
  sheet.play({.clamp = true});
  CHECK(sheet.problem.find("Grasp tissue first") != std::string::npos);
  CHECK(sheet.commands.empty());
  CHECK_FALSE(sheet.hand.holds());
}

TEST_CASE("a device's hand reaches nothing beyond the section plane") {
  Sheet sheet;
  sheet.play({.move = {0.1f, 0, 0}});
  sheet.go_to({0.05f, 0, 0.005f});
  CHECK(sheet.hand.in_reach(sheet.scene()));
  sheet.section = render::SectionPlane{};
  sheet.section->normal = {1, 0, 0};
  sheet.section->offset = 0;
  CHECK_FALSE(sheet.hand.in_reach(sheet.scene()));
}

TEST_CASE("a device's hand leaves a clamp, and takes it up again from where it pulls") {
  Sheet sheet;
  sheet.play({.move = {0.1f, 0, 0}});
  sheet.go_to({0.08f, -0.07f, 0.01f});
  sheet.grasp();
  const Grasp grasp = only<Grasp>(sheet.commands);
  sheet.show(grasp, {0.1, -0.1, 0});
  sheet.commands.clear();
  sheet.clamp();
  const Grasp left = only<Grasp>(sheet.commands);
  CHECK(left.node == grasp.node);
  CHECK(left.radius == grasp.radius);
  CHECK(left.hand == 1);
  CHECK_FALSE(sheet.hand.holds());

  sheet.frame.tools.clear();
  sheet.show(left, {0.13, -0.1, 0.02});
  for (const Vec3f& place : {Vec3f(0.095f, -0.095f, 0.005f), Vec3f(0.13f, -0.1f, 0.02f)}) {  // tissue, tool
    sheet.commands.clear();
    sheet.go_to(place);
    sheet.grasp();
    CHECK(only<Grasp>(sheet.commands).hand == first_device_hand);
    CHECK(only<Grasp>(sheet.commands).node == 21);
    sheet.commands.clear();
    sheet.play({.move = {0, 1, 0}});
    const Vec3 target = only<MoveTool>(sheet.commands).target;
    CHECK(target.x() == doctest::Approx(0.13));
    CHECK(target.y() > -0.1);
    CHECK(target.y() < -0.09);
    CHECK(target.z() == doctest::Approx(0.02));
    sheet.grasp();
  }
}

TEST_CASE("a device's hand that has just left a clamp takes it up again where it is, also far from where it took hold") {
  Sheet sheet;
  sheet.play({.move = {0.1f, 0, 0}});
  sheet.go_to({0.03f, -0.02f, 0.01f});  // further from node 21 than a grasp reaches
  sheet.grasp();
  REQUIRE(only<Grasp>(sheet.commands).node == 21);
  sheet.show(only<Grasp>(sheet.commands), {0.1, -0.1, 0});
  for (int k = 0; k < 10; ++k) sheet.play({.move = {0, 0, 1}});
  const Vec3 target = std::get<MoveTool>(sheet.commands.back()).target;
  sheet.commands.clear();
  sheet.clamp();
  const Grasp left = only<Grasp>(sheet.commands);
  sheet.frame.tools.clear();
  sheet.show(left, target);
  sheet.commands.clear();
  sheet.grasp();
  CHECK(only<Grasp>(sheet.commands).hand == first_device_hand);
  CHECK(only<Grasp>(sheet.commands).node == 21);
}

TEST_CASE("a device that goes leaves a clamp of what it held, or lets go where there is no hand for one") {
  for (const bool is_full : {false, true}) {
    Sheet sheet;
    sheet.play({.move = {0.1f, 0, 0}});
    CHECK(sheet.hand.unplug(sheet.frame, sheet.commands).empty());
    CHECK_FALSE(sheet.hand.is_shown());
    sheet.play({.move = {0.1f, 0, 0}});
    sheet.go_to({0.08f, -0.07f, 0.01f});
    sheet.grasp();
    sheet.commands.clear();
    for (int hand = 1; is_full && hand < first_device_hand; ++hand)
      sheet.frame.tools.emplace_back(GraspState{.hand = hand, .node = 20});
    const std::string said = sheet.hand.unplug(sheet.frame, sheet.commands);
    if (is_full) {
      CHECK(said.find("let go") != std::string::npos);
      CHECK(only<Release>(sheet.commands).hand == first_device_hand);
    } else {
      CHECK(said.find("clamp") != std::string::npos);
      CHECK(only<Grasp>(sheet.commands).hand == 1);
    }
    CHECK_FALSE(sheet.hand.is_shown());
    CHECK_FALSE(sheet.hand.holds());
  }
}

TEST_CASE("what a device's hand held is gone when a frame no longer shows it, or the grasp was refused") {
  for (const bool is_refused : {false, true}) {
    Sheet sheet;
    sheet.play({.move = {0.1f, 0, 0}});
    sheet.go_to({0.08f, -0.07f, 0.01f});
    sheet.grasp();
    const Grasp grasp = only<Grasp>(sheet.commands);
    sheet.commands.clear();
    sheet.play({}, picture, 5);  // the engine has not come to it
    CHECK(sheet.hand.holds());
    if (is_refused) {
      ++sheet.frame.refusals;
    } else {
      sheet.show(grasp, {0.1, -0.1, 0});
      sheet.play({});
      CHECK(sheet.hand.holds());
      sheet.frame.tools.clear();
    }
    sheet.play({});
    CHECK_FALSE(sheet.hand.holds());
    CHECK(sheet.hand.free_tip());
    CHECK(sheet.commands.size() == (is_refused ? 1 : 0));  // a release, in case another command was refused
  }
}

TEST_CASE("mouse and device hold at the same time, and neither takes the other's tissue out of its hand") {
  Sheet sheet;
  MouseTool mouse{sheet.controller};
  panel::ToolSettings tool{panel::Tool::grasper, 0.02};
  const auto press = [&](const Vec3f& point) {
    return mouse.press(MouseButton::left, sheet.controller.pixel(point), false, sheet.frame, sheet.surface_mesh, tool,
                       sheet.commands);
  };
  CHECK(press({0.08f, 0.09f, 0}).ok());
  sheet.show(only<Grasp>(sheet.commands), {0.1, 0.1, 0});
  sheet.commands.clear();

  sheet.play({.move = {0.1f, 0, 0}});
  sheet.go_to({0.09f, 0.08f, 0.01f});
  sheet.play({.grasp = true});
  CHECK(sheet.problem.find("other hand") != std::string::npos);
  CHECK(sheet.commands.empty());
  sheet.play({});
  sheet.go_to({0.08f, -0.07f, 0.01f});
  sheet.grasp();
  sheet.show(only<Grasp>(sheet.commands), {0.1, -0.1, 0});
  sheet.commands.clear();

  mouse.move(sheet.controller.pixel({0.05f, 0.05f, 0}), sheet.frame, sheet.surface_mesh, sheet.commands);
  sheet.play({.move = {-1, 0, 0}});
  REQUIRE(sheet.commands.size() == 2);
  CHECK(std::get<MoveTool>(sheet.commands[0]).hand == 0);
  CHECK(std::get<MoveTool>(sheet.commands[1]).hand == first_device_hand);
  sheet.commands.clear();
  mouse.release(MouseButton::left, sheet.frame, sheet.surface_mesh, sheet.commands);
  CHECK(only<Release>(sheet.commands).hand == 0);
  CHECK(sheet.hand.holds());
  CHECK_FALSE(press({0.09f, -0.08f, 0}).ok());
}

TEST_CASE("a device turns the view, and moves it where it is set to: then its hand hides, unless it holds something") {
  Sheet sheet;
  sheet.play({.move = {0.1f, 0, 0}});
  const Vec3f before = sheet.tip(), eye = sheet.controller.camera().eye();
  sheet.play({.turn_right = 1}, 0.1f, 10);
  CHECK(sheet.controller.camera().backward().x() == doctest::Approx(-1).epsilon(1e-3));  // a quarter turn in a second
  CHECK(sheet.tip() == before);
  sheet.play({.turn_right = -1}, 0.1f, 10);
  CHECK((sheet.controller.camera().eye() - eye).norm() < 1e-4f);
  sheet.moves_view = true;
  const render::Vec2f at = sheet.controller.pixel(Vec3f(0, 0, 0));
  sheet.play({.move = {1, 0, 0}}, 0.1f, 10);
  CHECK((sheet.controller.pixel(Vec3f(0, 0, 0)) - at - render::Vec2f(180, 0)).norm() < 1);
  CHECK_FALSE(sheet.hand.is_shown());
  CHECK(sheet.hand.has_moved());
  const float distance = (sheet.controller.camera().eye() - sheet.controller.camera().target()).norm();
  sheet.play({.move = {0, 0, 1}}, 0.1f, 5);
  CHECK((sheet.controller.camera().eye() - sheet.controller.camera().target()).norm() < 0.9f * distance);
  sheet.grasp();
  CHECK(sheet.commands.empty());

  Sheet holding;
  holding.play({.move = {0.1f, 0, 0}});
  holding.go_to({0.08f, -0.07f, 0.01f});
  holding.grasp();
  holding.moves_view = true;
  holding.commands.clear();
  const Vec3f held = holding.tip();
  holding.play({.move = {1, 0, 0}});
  CHECK(holding.tip() == held);
  CHECK(holding.commands.empty());
  holding.grasp();
  CHECK(only<Release>(holding.commands).hand == first_device_hand);
}

}  // namespace heml::device_hand_test
