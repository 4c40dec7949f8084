#include <doctest/doctest.h>

#include <app/window/mouse_tool.hpp>

#include "sheet.hpp"

namespace heml::mouse_tool_test {

using namespace heml::window;

namespace {

/// A square of two triangles that faces the camera at +z; node 3 is constrained.
struct Sheet : test::Sheet {
  MouseTool mouse_tool{controller};
  std::vector<Command> commands;
  panel::ToolSettings tool{panel::Tool::grasper, 0.01, 0.02};

  void move(const render::Vec2f& at) { mouse_tool.move(at, frame, surface_mesh, commands); }

  Sheet() { surface_mesh.constrained = {3}; }
  render::Vec2f pixel(const Vec3f& point) const { return controller.camera().pixel(point, size); }
  /// Whether the tool cannot act there.
  bool press(MouseButton button, const render::Vec2f& at, bool shift = false) {
    return !mouse_tool.press(button, at, shift, frame, surface_mesh, tool, commands).ok();
  }
};

}  // namespace

TEST_CASE("the left button grasps the nearest node and moves it in the plane that faces the camera") {
  Sheet sheet;
  const Vec3f point(0.08f, -0.09f, 0);
  CHECK_FALSE(sheet.press(MouseButton::left, sheet.pixel(point)));
  REQUIRE(sheet.commands.size() == 1);
  const Grasp grasp = std::get<Grasp>(sheet.commands[0]);
  CHECK(grasp.node == 21);
  CHECK(grasp.radius == 0.01);
  CHECK(sheet.mouse_tool.interaction() == MouseTool::Interaction::grasping);

  const Vec3f pulled = point + Vec3f(0.03f, 0.02f, 0);
  sheet.move(sheet.pixel(pulled));
  REQUIRE(sheet.commands.size() == 2);
  const Vec3 target = std::get<MoveTool>(sheet.commands[1]).target;
  // The node moves as far as the point under the mouse: no jump when it is grasped off its centre.
  CHECK((target - Vec3(0.13, -0.08, 0)).norm() < 1e-5);

  sheet.mouse_tool.release(MouseButton::left, sheet.frame, sheet.surface_mesh, sheet.commands);
  REQUIRE(sheet.commands.size() == 3);
  CHECK(std::holds_alternative<Release>(sheet.commands[2]));
  CHECK(sheet.mouse_tool.interaction() == MouseTool::Interaction::none);
}

TEST_CASE("a right drag turns about the tissue under the mouse, a drag beside it about the middle") {
  Sheet sheet;
  const Vec3f point(0.08f, -0.07f, 0);
  const render::Vec2f at = sheet.pixel(point);
  sheet.press(MouseButton::right, at);
  REQUIRE(sheet.mouse_tool.pivot());
  CHECK((*sheet.mouse_tool.pivot() - point).norm() < 1e-4f);
  CHECK((sheet.pixel(point) - at).norm() < 0.05f);  // no jump
  sheet.move(at + render::Vec2f(60, 25));
  CHECK((sheet.pixel(point) - at).norm() < 0.05f);
  CHECK((sheet.pixel(-point) - at).norm() > 20);
  sheet.mouse_tool.release(MouseButton::right, sheet.frame, sheet.surface_mesh, sheet.commands);
  CHECK_FALSE(sheet.mouse_tool.pivot());
  CHECK(sheet.commands.empty());

  sheet.press(MouseButton::right, {3, 3});
  CHECK_FALSE(sheet.mouse_tool.pivot());
  CHECK(sheet.mouse_tool.interaction() == MouseTool::Interaction::orbiting);
}

TEST_CASE("the hold stays at the point of the tissue that was pressed, and its hand is where the mouse is") {
  Sheet sheet;
  CHECK_FALSE(sheet.mouse_tool.hold());
  const Vec3f point(0.05f, -0.06f, 0), pulled(0.09f, 0.02f, 0);
  sheet.press(MouseButton::left, sheet.pixel(point));
  REQUIRE(sheet.mouse_tool.hold());
  CHECK((sheet.mouse_tool.hold()->hand - point).norm() < 1e-5f);
  sheet.move(sheet.pixel(pulled));
  for (Vec3f& x : sheet.frame.positions) x.z() += 0.01f;
  const render::Hold hold = *sheet.mouse_tool.hold();
  CHECK((hold.hand - pulled).norm() < 1e-5f);
  CHECK((hold.at.among(*render::corners_of(hold.at, sheet.frame, sheet.surface_mesh)) - point - Vec3f(0, 0, 0.01f))
            .norm() < 1e-5f);
  sheet.mouse_tool.release(MouseButton::left, sheet.frame, sheet.surface_mesh, sheet.commands);
  CHECK_FALSE(sheet.mouse_tool.hold());
}

TEST_CASE("a grasp is left as a clamp, taken up again by a press on it, and removed") {
  Sheet sheet;
  const Vec3f point(0.08f, -0.09f, 0);
  CHECK_FALSE(sheet.mouse_tool.leave_clamp(sheet.frame, sheet.commands).ok());  // nothing is held
  sheet.press(MouseButton::left, sheet.pixel(point));
  sheet.move(sheet.pixel({0.09f, -0.05f, 0}));
  sheet.commands.clear();
  sheet.frame.tools = {GraspState{.hand = 1, .node = 20}};
  CHECK(sheet.mouse_tool.leave_clamp(sheet.frame, sheet.commands).ok());
  REQUIRE(sheet.commands.size() == 1);
  const Grasp left = std::get<Grasp>(sheet.commands[0]);
  CHECK(left.node == 21);
  CHECK(left.radius == 0.01);
  CHECK(left.hand == 2);
  sheet.commands.clear();
  sheet.mouse_tool.release(MouseButton::left, sheet.frame, sheet.surface_mesh, sheet.commands);
  CHECK(sheet.commands.empty());  // the hand is free already
  sheet.frame.tools = {GraspState{.node = 20},
                       GraspState{.hand = 2, .node = 21, .radius = 0.01, .target = Vec3(0.1, -0.1, 0.02)},
                       PinState{.node = 22, .nodes = {22}}};

  const render::Vec2f on_clamp = sheet.pixel(sheet.frame.positions[1]) + render::Vec2f(2, -2);
  CHECK_FALSE(
      sheet.mouse_tool.remove_clamp(sheet.pixel({-0.05f, 0, 0}), sheet.frame, sheet.surface_mesh, sheet.commands));
  CHECK(sheet.mouse_tool.remove_clamp(on_clamp, sheet.frame, sheet.surface_mesh, sheet.commands));
  CHECK(std::get<Release>(sheet.commands.at(0)).hand == 2);

  sheet.commands.clear();
  CHECK_FALSE(sheet.press(MouseButton::left, on_clamp));
  REQUIRE(sheet.commands.size() == 1);
  const Grasp taken = std::get<Grasp>(sheet.commands[0]);
  CHECK(taken.node == 21);
  CHECK(taken.radius == 0.01);  // that of the clamp
  CHECK(taken.hand == 0);
  CHECK(sheet.mouse_tool.interaction() == MouseTool::Interaction::grasping);
  sheet.move(on_clamp + render::Vec2f(0, -30));
  const Vec3 target = std::get<MoveTool>(sheet.commands.at(1)).target;
  CHECK(target.x() == doctest::Approx(0.1).epsilon(1e-3));  // it moves from where it was, not from the mouse
  CHECK(target.y() > -0.1);
  CHECK(target.z() == doctest::Approx(0.02).epsilon(1e-3));
}

TEST_CASE("when every hand but a person's holds something, no clamp can be left") {
  Sheet sheet;
  sheet.press(MouseButton::left, sheet.pixel({0.08f, -0.09f, 0}));
  for (int hand = 1; hand < first_device_hand; ++hand)
    sheet.frame.tools.emplace_back(GraspState{.hand = hand, .node = 20});
  sheet.commands.clear();
  CHECK_FALSE(sheet.mouse_tool.leave_clamp(sheet.frame, sheet.commands).ok());
  CHECK(sheet.commands.empty());
  CHECK(sheet.mouse_tool.interaction() == MouseTool::Interaction::grasping);
}

TEST_CASE("a scalpel cuts along the line of sight and each press begins a stroke") {
  Sheet sheet;
  sheet.tool.tool = panel::Tool::scalpel;
  for (int stroke = 0; stroke < 2; ++stroke) {
    sheet.commands.clear();
    CHECK_FALSE(sheet.press(MouseButton::left, sheet.pixel({-0.05f, 0, 0})));
    CHECK(sheet.mouse_tool.interaction() == MouseTool::Interaction::cutting);
    CHECK(sheet.commands.empty());
    sheet.move(sheet.pixel({-0.0499f, 0, 0}));  // less than a stroke
    CHECK(sheet.commands.empty());
    sheet.move(sheet.pixel({0.02f, 0.01f, 0}));
    sheet.move(sheet.pixel({0.06f, 0.01f, 0}));
    REQUIRE(sheet.commands.size() == 2);
    const CutTissue first = std::get<CutTissue>(sheet.commands[0]), next = std::get<CutTissue>(sheet.commands[1]);
    CHECK_FALSE(first.continues_stroke);
    CHECK(next.continues_stroke);
    CHECK(first.sweep.blades[1] == next.sweep.blades[0]);  // no gap
    const auto& [tip, end] = first.sweep.blades[0];
    CHECK(tip.z() > 0);  // towards the camera
    CHECK(end.z() < -0.018);
    const double at_surface = tip.z() / (tip.z() - end.z());
    CHECK((tip + at_surface * (end - tip) - Vec3(-0.05, 0, 0)).norm() < 1e-5);
    sheet.mouse_tool.release(MouseButton::left, sheet.frame, sheet.surface_mesh, sheet.commands);
    CHECK(sheet.commands.size() == 2);
    CHECK(sheet.mouse_tool.interaction() == MouseTool::Interaction::none);
  }
}

TEST_CASE("a stroke that begins beside the body cuts from there once it meets tissue") {
  Sheet sheet;
  sheet.tool.tool = panel::Tool::scalpel;
  const Vec3f eye = sheet.controller.camera().eye();
  CHECK_FALSE(sheet.press(MouseButton::left, sheet.pixel({-0.15f, 0, 0})));
  CHECK(sheet.mouse_tool.interaction() == MouseTool::Interaction::cutting);
  sheet.move(sheet.pixel({-0.12f, 0, 0}));
  CHECK(sheet.commands.empty());
  CHECK(sheet.mouse_tool.is_beside_body());
  CHECK_FALSE(sheet.mouse_tool.stroke(sheet.frame, sheet.surface_mesh).blade);
  sheet.move(sheet.pixel({-0.05f, 0, 0}));
  CHECK_FALSE(sheet.mouse_tool.is_beside_body());
  REQUIRE(sheet.commands.size() == 1);
  const CutTissue entry = std::get<CutTissue>(sheet.commands[0]);
  CHECK_FALSE(entry.continues_stroke);
  const auto& [tip, end] = entry.sweep.blades[0];
  const double at_surface = tip.z() / (tip.z() - end.z());
  CHECK((tip + at_surface * (end - tip) - Vec3(-0.12, 0, 0)).norm() < 1e-5);
  CHECK(end.z() < -0.018);
  sheet.move(sheet.pixel({0.15f, 0, 0}));  // and out on the other side
  REQUIRE(sheet.commands.size() == 2);
  const CutTissue exit = std::get<CutTissue>(sheet.commands[1]);
  CHECK(exit.continues_stroke);
  CHECK(exit.sweep.blades[1][0].x() > 0.1);
  CHECK((sheet.controller.camera().eye() - eye).norm() == 0);
}

TEST_CASE("a stroke that meets no tissue cuts nothing, and the next begins where it is pressed") {
  Sheet sheet;
  sheet.tool.tool = panel::Tool::scalpel;
  sheet.press(MouseButton::left, sheet.pixel({-0.15f, 0.13f, 0}));
  sheet.move(sheet.pixel({0.15f, 0.13f, 0}));
  sheet.mouse_tool.release(MouseButton::left, sheet.frame, sheet.surface_mesh, sheet.commands);
  CHECK(sheet.commands.empty());
  sheet.press(MouseButton::left, sheet.pixel({0, 0, 0}));
  sheet.move(sheet.pixel({0.05f, 0, 0}));
  REQUIRE(sheet.commands.size() == 1);
  const auto& [tip, end] = std::get<CutTissue>(sheet.commands[0]).sweep.blades[0];
  CHECK((tip + tip.z() / (tip.z() - end.z()) * (end - tip)).norm() < 1e-5);
}

TEST_CASE("a press on a constrained node grasps its free neighbour") {
  Sheet sheet;
  CHECK_FALSE(sheet.press(MouseButton::left, sheet.pixel({-0.09f, 0.09f, 0})));
  REQUIRE(sheet.commands.size() == 1);
  CHECK(std::get<Grasp>(sheet.commands[0]).node != 23);
}

TEST_CASE("a press where all nodes are constrained grasps nothing and is reported") {
  Sheet sheet;
  sheet.surface_mesh.constrained = {0, 1, 2, 3};
  CHECK(sheet.press(MouseButton::left, sheet.pixel({0, 0.01f, 0})));
  CHECK(sheet.commands.empty());
  CHECK(sheet.mouse_tool.interaction() == MouseTool::Interaction::none);
}

TEST_CASE("a press on a pin grasps the nearest free tissue within the radius, or says why it grasps nothing") {
  Sheet sheet;
  const Vec3f point(0.09f, -0.09f, 0);
  sheet.frame.tools = {PinState{.node = 21, .nodes = {21, 22}}};
  CHECK_FALSE(sheet.press(MouseButton::left, sheet.pixel(point)));
  REQUIRE(sheet.commands.size() == 1);
  CHECK(std::get<Grasp>(sheet.commands[0]).node == 20);  // the free corner of the triangle
  sheet.mouse_tool.cancel(sheet.commands);
  sheet.commands.clear();

  sheet.frame.tools = {PinState{.node = 21, .nodes = {20, 21, 22}}};
  const Status pressed = sheet.mouse_tool.press(MouseButton::left, sheet.pixel(point), false, sheet.frame,
                                                sheet.surface_mesh, sheet.tool, sheet.commands);
  CHECK(pressed.message().find("pinned") != std::string::npos);
  CHECK(sheet.commands.empty());
  CHECK(sheet.mouse_tool.interaction() == MouseTool::Interaction::none);

  sheet.surface_mesh.constrained.clear();  // node 23 is free, and 0.2 √2 from node 21
  sheet.tool.radius = 0.3;
  CHECK_FALSE(sheet.press(MouseButton::left, sheet.pixel(point)));
  REQUIRE(sheet.commands.size() == 1);
  CHECK(std::get<Grasp>(sheet.commands[0]).node == 23);
}

TEST_CASE("grasps and pins leave hidden regions out") {
  Sheet sheet;
  sheet.surface_mesh.hidden = {3, 5};
  sheet.press(MouseButton::left, sheet.pixel({0.08f, -0.09f, 0}));
  CHECK(std::get<Grasp>(sheet.commands.at(0)).hidden == std::vector{3, 5});
  CHECK(sheet.mouse_tool.leave_clamp(sheet.frame, sheet.commands).ok());
  CHECK(std::get<Grasp>(sheet.commands.at(1)).hidden == std::vector{3, 5});
  sheet.tool.tool = panel::Tool::pin;
  sheet.press(MouseButton::left, sheet.pixel({0.08f, -0.09f, 0}));
  CHECK(std::get<PinTissue>(sheet.commands.at(2)).hidden == std::vector{3, 5});
}

TEST_CASE("buttons off the body orbit and pan the camera and send nothing") {
  Sheet sheet;
  const render::Vec2f beside(5, 5);
  struct Case {
    MouseButton button;
    bool shift;
    MouseTool::Interaction interaction;
  };
  for (const auto& [button, shift, interaction] : {Case{MouseButton::left, false, MouseTool::Interaction::orbiting},
                                                   Case{MouseButton::right, false, MouseTool::Interaction::orbiting},
                                                   Case{MouseButton::middle, false, MouseTool::Interaction::panning},
                                                   Case{MouseButton::right, true, MouseTool::Interaction::panning}}) {
    const Vec3f eye = sheet.controller.camera().eye();
    sheet.press(button, beside, shift);
    CHECK(sheet.mouse_tool.interaction() == interaction);
    sheet.move({25, 15});
    CHECK((sheet.controller.camera().eye() - eye).norm() > 1e-3f);
    sheet.mouse_tool.release(button, sheet.frame, sheet.surface_mesh, sheet.commands);
    CHECK(sheet.mouse_tool.interaction() == MouseTool::Interaction::none);
  }
  CHECK(sheet.commands.empty());
}

TEST_CASE("the right button on the body orbits the camera") {
  Sheet sheet;
  sheet.press(MouseButton::right, sheet.pixel({0, 0, 0}));
  CHECK(sheet.mouse_tool.interaction() == MouseTool::Interaction::orbiting);
  CHECK(sheet.commands.empty());
}

TEST_CASE("another button does not end a grasp, and a resting mouse sends nothing") {
  Sheet sheet;
  const render::Vec2f at = sheet.pixel({0.08f, -0.09f, 0});
  sheet.press(MouseButton::left, at);
  sheet.press(MouseButton::middle, at);
  sheet.mouse_tool.release(MouseButton::middle, sheet.frame, sheet.surface_mesh, sheet.commands);
  CHECK(sheet.mouse_tool.interaction() == MouseTool::Interaction::grasping);
  sheet.move(at);
  CHECK(sheet.commands.size() == 1);
}

TEST_CASE("a press sets a pin and a press on a pin removes it") {
  Sheet sheet;
  sheet.tool.tool = panel::Tool::pin;
  const render::Vec2f at = sheet.pixel(Vec3f(0.08f, -0.09f, 0));
  CHECK_FALSE(sheet.press(MouseButton::left, at));
  REQUIRE(sheet.commands.size() == 1);
  CHECK(std::get<PinTissue>(sheet.commands[0]).node == 21);
  CHECK(std::get<PinTissue>(sheet.commands[0]).radius == 0.01);
  CHECK(sheet.mouse_tool.interaction() == MouseTool::Interaction::none);
  sheet.frame.tools.push_back(PinState{.node = 20, .nodes = {20, 21}});
  sheet.press(MouseButton::left, at);
  REQUIRE(sheet.commands.size() == 2);
  CHECK(std::get<Unpin>(sheet.commands[1]).node == 21);
}

TEST_CASE("a probe moves in along the line of sight, deeper by the wheel, and withdraws on release") {
  Sheet sheet;
  sheet.tool.tool = panel::Tool::probe;
  sheet.tool.probe_radius = 0.005;
  sheet.tool.indentation = 0.01;
  sheet.tool.shaft = 0.1;
  sheet.tool.friction = 0.4;
  const render::Vec2f middle = sheet.pixel(Vec3f::Zero());
  CHECK_FALSE(sheet.mouse_tool.wheel(1, sheet.commands));
  sheet.press(MouseButton::left, middle);
  REQUIRE(sheet.commands.size() == 1);
  const auto pressed = std::get<MoveProbe>(sheet.commands[0]);
  REQUIRE(pressed.path.size() == 2);
  CHECK(pressed.path[0].z() > 0.005);                            // above the surface
  CHECK((pressed.path[1] - Vec3(0, 0, -0.005)).norm() <= 1e-5);  // the lowest point 10 mm below
  CHECK(pressed.shaft.z() == doctest::Approx(0.1).epsilon(1e-3));
  CHECK(pressed.friction == 0.4);
  sheet.move(sheet.pixel(Vec3f(0.02f, 0, 0)));
  REQUIRE(sheet.commands.size() == 2);
  const auto moved = std::get<MoveProbe>(sheet.commands[1]);
  REQUIRE(moved.path.size() == 1);
  CHECK(moved.path[0].x() == doctest::Approx(0.02).epsilon(0.02));
  CHECK(sheet.mouse_tool.wheel(2, sheet.commands));
  CHECK(std::get<MoveProbe>(sheet.commands[2]).path[0].z() < moved.path[0].z() - 5e-4);
  sheet.mouse_tool.release(MouseButton::left, sheet.frame, sheet.surface_mesh, sheet.commands);
  CHECK(std::holds_alternative<WithdrawProbe>(sheet.commands.back()));
}

TEST_CASE("cautery burns from the press on, without end at the body's edge, and shows its electrode meanwhile") {
  Sheet sheet;
  sheet.tool.tool = panel::Tool::cautery;
  sheet.tool.burn_radius = 0.01;
  sheet.tool.burn_depth = 0;
  sheet.press(MouseButton::left, sheet.pixel(Vec3f(-0.05f, 0, 0)));
  REQUIRE(sheet.commands.size() == 1);
  CHECK(sheet.mouse_tool.interaction() == panel::Interaction::burning);
  CHECK(sheet.mouse_tool.acts());
  CHECK(sheet.mouse_tool.stroke(sheet.frame, sheet.surface_mesh).electrode);
  sheet.move(sheet.pixel(Vec3f(0.02f, 0, 0)));
  REQUIRE(sheet.commands.size() == 2);
  CHECK(std::get<CauterizeTissue>(sheet.commands[1]).continues_stroke);
  sheet.mouse_tool.release(MouseButton::left, sheet.frame, sheet.surface_mesh, sheet.commands);
  CHECK(sheet.commands.size() == 2);
  CHECK_FALSE(sheet.mouse_tool.stroke(sheet.frame, sheet.surface_mesh).electrode);
}

TEST_CASE("a suture takes two presses, one per end") {
  Sheet sheet;
  sheet.tool.tool = panel::Tool::suture;
  sheet.press(MouseButton::left, sheet.pixel(Vec3f(0.08f, -0.09f, 0)));
  CHECK(sheet.commands.empty());
  CHECK(sheet.mouse_tool.first_end() == 21);
  sheet.press(MouseButton::left, sheet.pixel(Vec3f(0.08f, 0.09f, 0)));
  REQUIRE(sheet.commands.size() == 1);
  CHECK(std::get<SutureTissue>(sheet.commands[0]).nodes == std::array<int, 2>{21, 22});
  CHECK_FALSE(sheet.mouse_tool.first_end());
}

}  // namespace heml::mouse_tool_test
