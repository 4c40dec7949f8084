#include <imgui_internal.h>

#include <algorithm>
#include <heml/scenario/presets.hpp>

#include "driver.hpp"

namespace heml::panel_test {

using namespace heml::test;
using panel::Action;
using panel::Request;

namespace {
panel::PanelActions after(Driver& driver, Action action) {
  driver.panel.perform(action);
  return driver.draw();
}
}  // namespace

TEST_CASE("the play key pauses a running body and lets a paused one run") {
  Driver driver;
  CHECK(after(driver, Action::toggle_play).requests == std::vector{Request::pause});
  driver.frame.paused = true;
  CHECK(after(driver, Action::toggle_play).requests == std::vector{Request::play});
  CHECK(after(driver, Action::step).requests == std::vector{Request::step});
  CHECK(driver.draw().requests.empty());
}

TEST_CASE("the reset key sends a reset") {
  Driver driver;
  const auto actions = after(driver, Action::reset);
  REQUIRE(actions.commands.size() == 1);
  CHECK(std::holds_alternative<Reset>(actions.commands.front()));
}

TEST_CASE("buttons do what their keys do") {
  Driver driver(small_scene(), 1280, 900);
  CHECK(driver.click("Pause", 38).requests == std::vector{Request::pause});
  CHECK(driver.click("Step", 75).requests == std::vector{Request::step});
  const auto undo = driver.click("Undo", 112), redo = driver.click("Redo", 149);
  REQUIRE((undo.commands.size() == 1 && redo.commands.size() == 1));
  CHECK(std::get<StepHistory>(undo.commands.front()).by == -1);
  CHECK(std::get<StepHistory>(redo.commands.front()).by == 1);
  const auto reset = driver.click("Reset", 186);
  REQUIRE(reset.commands.size() == 1);
  CHECK(std::holds_alternative<Reset>(reset.commands.front()));
}

TEST_CASE("a scene is written with the tissue, the motion and the colours that are shown") {
  Scene scene = small_scene();
  Driver driver(scene);
  Material other = scene.materials[1].material;
  other.density = 1234;
  driver.panel.sync(SetMaterial{2, other});
  driver.panel.sync(SetGravity{Vec3(0, 0, 3)});
  driver.panel.sync(SetDamping{7});
  driver.panel.sync(SetIntegrator{Integrator::tr_bdf2});
  after(driver, Action::show_stretch);
  after(driver, Action::wireframe);
  driver.panel.write_into(scene);
  CHECK(scene.materials.size() == 2);
  CHECK(scene.materials[1].material.density == 1234);
  CHECK(scene.materials[0].material.density == 1000);
  CHECK((scene.gravity - Vec3(0, 0, 3)).norm() < 1e-15);
  CHECK(scene.solver.damping == 7);
  CHECK(scene.solver.integrator == Integrator::tr_bdf2);
  CHECK(scene.view.field == Field::stretch);
  CHECK(scene.view.wireframe);
}

TEST_CASE("the list of actions goes where it is clicked, and restored settings are shown") {
  Scene scene = small_scene();
  Driver driver(scene, 1280, 1600);
  driver.click("Actions");
  auto list = std::make_shared<UndoList>();
  list->past = {"grasp", "cut", "pin"};
  list->future = {"material", "reset"};
  driver.frame.undo_list = list;
  driver.draw();
  const auto steps = [](const panel::PanelActions& actions) {
    std::vector<int> by;
    for (const Command& command : actions.commands) by.push_back(std::get<StepHistory>(command).by);
    return by;
  };
  CHECK(steps(driver.click("2. cut", 60)) == std::vector{-1, -1});
  CHECK(steps(driver.click("5. reset (undone)", 60)) == std::vector{1, 1});
  auto stepped = std::make_shared<UndoList>(*list);
  stepped->steps = 1;
  stepped->settings = {SetDamping{7}, SetGravity{Vec3(0, 0, 3)}};
  driver.frame.undo_list = stepped;
  driver.panel.update(driver.frame, 0.1f);
  driver.panel.write_into(scene);
  CHECK(scene.solver.damping == 7);
  CHECK((scene.gravity - Vec3(0, 0, 3)).norm() < 1e-15);
}

TEST_CASE("colour keys and the colour choice ask for fields") {
  Driver driver;
  CHECK(after(driver, Action::show_von_mises).show == Field::von_mises);
  CHECK(after(driver, Action::show_tissue).show == Field::none);
  CHECK(driver.choose("Colours", "Stretch").show == Field::stretch);
}

TEST_CASE("the wireframe key and its box change how the body is drawn") {
  Driver driver;
  after(driver, Action::wireframe);
  CHECK(driver.panel.drawing().wireframe);
  driver.click("Wireframe", 40);
  CHECK_FALSE(driver.panel.drawing().wireframe);
}

TEST_CASE("the colour range follows the frame's values") {
  Driver driver;
  driver.frame.field = Field::displacement;
  driver.frame.values = {0, 0.01f, 0.02f, 0.04f};
  driver.draw();
  REQUIRE(driver.panel.drawing().range);
  CHECK(driver.panel.drawing().range->high == doctest::Approx(0.04f));
}

TEST_CASE("gravity, damping and the integrator are sent when changed") {
  Driver driver;
  const auto drag = [&](const char* label) {
    const ImVec2 at = driver.find(label);
    driver.hold(true);
    driver.draw();
    driver.move({at.x + 10, at.y});
    const auto actions = driver.draw();
    driver.hold(false);
    driver.draw();
    return actions;
  };
  const auto gravity = drag("Gravity");
  REQUIRE(gravity.commands.size() == 1);
  const Vec3 g = std::get<SetGravity>(gravity.commands.front()).gravity;
  CHECK(g.x() == 0);
  CHECK(g.y() < -9.81);
  CHECK(g.z() == 0);
  const auto damping = drag("Damping");
  REQUIRE(damping.commands.size() == 1);
  CHECK(std::get<SetDamping>(damping.commands.front()).damping > 0);
  const auto integrator = driver.choose("Integrator", "Symplectic Euler");
  REQUIRE(integrator.commands.size() == 1);
  CHECK(std::get<SetIntegrator>(integrator.commands.front()).integrator == Integrator::symplectic_euler);
  const auto direction = driver.choose("Direction", "right (+x)");
  REQUIRE(direction.commands.size() == 1);
  CHECK(std::get<SetGravity>(direction.commands.front()).gravity.x() == doctest::Approx(g.norm()));
}

TEST_CASE("a typed number is set by Enter alone, Esc keeps the old one, one beyond the range is cut with a notice") {
  Driver driver;
  ImGuiIO& io = ImGui::GetIO();
  io.KeyMap[ImGuiKey_Enter] = 1, io.KeyMap[ImGuiKey_Escape] = 2;
  const auto type = [&](const char* digits, int last_key) {
    driver.find("Damping");
    io.KeyCtrl = true, io.KeyMods = ImGuiKeyModFlags_Ctrl;
    driver.click();
    io.KeyCtrl = false, io.KeyMods = 0;
    driver.draw();
    for (const char* digit = digits; *digit; ++digit) {
      io.AddInputCharacter(static_cast<unsigned>(*digit));
      CHECK(driver.draw().commands.empty());  // not at each keystroke
    }
    io.KeysDown[last_key] = true;
    panel::PanelActions actions = driver.draw();
    io.KeysDown[last_key] = false;
    driver.draw();
    return actions;
  };
  const auto set = type("12.5", 1);
  REQUIRE(set.commands.size() == 1);
  CHECK(std::get<SetDamping>(set.commands.front()).damping == 12.5);
  CHECK(type("3", 2).commands.empty());
  const auto again = type("4", 1);
  REQUIRE(again.commands.size() == 1);
  CHECK(std::get<SetDamping>(again.commands.front()).damping == 4);
  CHECK_FALSE(driver.panel.animating());
  const auto beyond = type("500", 1);
  REQUIRE(beyond.commands.size() == 1);
  CHECK(std::get<SetDamping>(beyond.commands.front()).damping == 20);
  CHECK(driver.panel.animating());  // a notice of it
  CHECK(type("1e999", 1).commands.empty());  // the end of the range already
}

TEST_CASE("a gravity along no axis keeps its direction") {
  Scene scene = small_scene();
  scene.gravity = Vec3(3, -4, 0);
  Driver driver(scene);
  const ImVec2 at = driver.find("Gravity");
  driver.hold(true);
  driver.draw();
  driver.move({at.x + 15, at.y});
  const auto actions = driver.draw();
  REQUIRE(actions.commands.size() == 1);
  const Vec3 g = std::get<SetGravity>(actions.commands.front()).gravity;
  CHECK(g.x() / g.norm() == doctest::Approx(0.6));
  CHECK(g.y() / g.norm() == doctest::Approx(-0.8));
}

TEST_CASE("a fixed range of colours stays when the values grow, until another field is shown") {
  Scene scene = small_scene();
  Driver driver(scene, 1280, 900);
  after(driver, Action::show_von_mises);
  driver.frame.field = Field::von_mises;
  driver.frame.values = {0, 1000, 2000, 500};
  driver.draw();
  driver.click("Fixed range", 30);
  driver.frame.values = {0, 9000, 2000, 500};
  for (int k = 0; k < 60; ++k) driver.draw();
  REQUIRE(driver.panel.drawing().range);
  CHECK(*driver.panel.drawing().range == render::Range{0, 2000});
  driver.find("Highest");
  driver.panel.write_into(scene);
  REQUIRE(scene.view.range);
  CHECK((*scene.view.range)[1] == 2000);
  after(driver, Action::show_stretch);
  CHECK_FALSE(driver.panel.view().fixed_range());
}

TEST_CASE("the first click on a view saves it and the next restores it") {
  Driver driver(small_scene(), 1280, 1000);
  CHECK(driver.click("2", 215).save_view == 1u);
  driver.panel.view().set_saved(1, true);
  const auto again = driver.click("2", 215);
  CHECK(again.view == 1u);
  CHECK_FALSE(again.save_view);
  CHECK(after(driver, Action::save_view_4).save_view == 3u);
  CHECK(after(driver, Action::view_1).view == 0u);
}

TEST_CASE("R resets the state, Shift+R the whole scene, as one command") {
  Driver driver;
  driver.panel.sync(SetDamping{7});
  const auto state = after(driver, Action::reset).commands, scene = after(driver, Action::reset_all).commands;
  REQUIRE(state.size() == 1);
  CHECK_FALSE(std::get<Reset>(state[0]).scene);
  REQUIRE(scene.size() == 1);
  CHECK(std::get<Reset>(scene[0]).scene);
}

TEST_CASE("regions that are made while it runs are shown, with their material, until they are taken back") {
  Driver driver;
  long version = 0;
  const auto with = [&](std::vector<int> numbers, std::map<int, std::string> names,
                        std::vector<RegionMaterial> materials) {
    driver.frame.regions = std::make_shared<const Regions>(
        Regions{++version, std::move(numbers), std::move(names), {}, std::move(materials)});
    driver.draw();
    Scene scene;
    driver.panel.write_into(scene);
    return scene.materials;
  };
  Scene scene;
  driver.panel.write_into(scene);
  const RegionMaterial whole = scene.materials.at(0);
  RegionMaterial part = whole;
  part.region = 1;
  part.material.density = 1234;
  const auto two = with({0, 1}, {{1, "lesion"}}, {whole, part});
  REQUIRE(two.size() == 2);
  CHECK(two[1].material.density == 1234);
  driver.find("Region");  // of the section Material: the new one is chosen
  driver.choose("Law", "Ogden");
  driver.panel.write_into(scene);
  CHECK(scene.materials[0].material == whole.material);
  CHECK(scene.materials[1].material.law == "ogden");
  CHECK(with({0}, {}, {whole}).size() == 1);
}

TEST_CASE("Esc closes an open choice and nothing else") {
  Driver driver;
  driver.click("Law");
  CHECK(driver.panel.covers(640, 500));
  CHECK(after(driver, Action::release).requests.empty());
  driver.draw();
  CHECK_FALSE(driver.panel.covers(640, 500));
  CHECK(after(driver, Action::release).requests == std::vector{Request::release});
}

TEST_CASE("sections that are closed by hand and hints that are switched off stay so in another panel") {
  panel::Preferences kept;
  {
    Driver driver;
    driver.click("Motion", 60);
    driver.click("Hints", 40);
    kept = driver.panel.preferences();
  }
  CHECK(kept.sections == std::map<std::string, bool>{{"Motion", false}});
  CHECK_FALSE(kept.hints);
  Driver driver;
  driver.panel.set_preferences(kept);
  CHECK(driver.panel.preferences() == kept);
  for (float y = 4; y < 760; y += 4) {
    driver.move({200, y});
    driver.draw();
    CHECK(driver.panel.hovered() != "Gravity");
  }
}

TEST_CASE("what was chosen of look and drawing stays so in another panel") {
  panel::Preferences kept;
  {
    Driver driver(small_scene(), 1280, 1000);
    driver.click("Ground", 40);
    driver.click("Full resolution", 200);
    driver.click("Window", 60);
    driver.click("Light theme", 60);
    driver.click("Text size", 200);
    driver.click("125 %");
    kept = driver.panel.preferences();
  }
  CHECK_FALSE(kept.ground);
  CHECK_FALSE(kept.full_resolution);
  CHECK(kept.look == panel::Look{1.25, panel::Theme::light});
  Driver driver;
  driver.panel.set_preferences(kept);
  CHECK(driver.panel.preferences() == kept);
  CHECK_FALSE(driver.panel.drawing().ground);
  CHECK(driver.panel.drawing().resolution < 1);
}

TEST_CASE("every row of the panel is in a picture of 1280x720 without scrolling") {
  Driver driver(small_scene(), 1280, 720);
  for (const char* label : {"Law", "Gravity", "Rate", "Grasp radius", "Colours", "Wireframe", "Hints", "Front"})
    driver.find(label, 40);
  driver.find("Orthographic", 170);
  driver.find("4", 250);  // a view
}

TEST_CASE("what was saved offers its folder to be opened") {
  Driver driver;
  driver.panel.notify("Saved /home/me/picture.png", "/home/me");
  for (int k = 0; k < 3; ++k) driver.draw();
  bool found = false;
  for (float y = 640; y < 756 && !found; y += 5)
    for (float x = 460; x < 800 && !found; x += 15) {
      driver.move({x, y});
      driver.draw();
      found = driver.panel.hovered() == "Open folder";
    }
  REQUIRE(found);
  driver.hold(true);
  auto actions = driver.draw();
  driver.hold(false);
  actions = driver.draw();
  CHECK(actions.open_folder == std::filesystem::path("/home/me"));
  CHECK_FALSE(driver.draw().open_folder);
}

TEST_CASE("the panel draws error and slowdown plots next to their values") {
  Driver driver;
  driver.frame.mesh_error = 0.1;
  driver.frame.time_error = TimeError{1e-4, 2e-4};
  driver.frame.surface_mesh = std::make_shared<const SurfaceMesh>(small_surface());
  for (int k = 0; k < 30; ++k) {
    driver.frame.time += 0.1;
    driver.frame.tick += 100;
    driver.draw();
  }
  driver.find("Slowdown", 1180);
  driver.find("Body volume", 1180);
  SurfaceMesh part = small_surface();
  part.hidden = {2};
  driver.frame.surface_mesh = std::make_shared<const SurfaceMesh>(part);
  driver.find("Shown regions", 1180);
}

TEST_CASE("devices that move a hand have rows, and what a SpaceMouse moves is chosen there and remembered") {
  Driver driver;
  driver.panel.set_devices({{"Gamepad", "Pad of a maker", {"left stick moves", "A grasps"}},
                            {"SpaceMouse", "Read from spacenavd", {"cap moves"}, true}});
  driver.find("Gamepad");
  CHECK_FALSE(driver.panel.device_moves_view());
  driver.choose("SpaceMouse", "moves view");
  CHECK(driver.panel.device_moves_view());
  CHECK(driver.panel.preferences().device_moves_view);
  Driver next;
  next.panel.set_preferences(driver.panel.preferences());
  CHECK(next.panel.device_moves_view());
}

TEST_CASE("the grasp radius is a setting of the panel") {
  Driver driver;
  const double before = driver.panel.tool().radius;
  CHECK(before > 0);
  const ImVec2 at = driver.find("Grasp radius");
  driver.hold(true);
  driver.draw();
  driver.move({at.x + 40, at.y});
  CHECK(driver.draw().commands.empty());
  CHECK(driver.panel.tool().radius > before);
}

TEST_CASE("Del requests the removal of tissue and the panel shows the number of removed elements") {
  Driver driver;
  driver.panel.perform(panel::Action::remove);
  CHECK(driver.draw().requests == std::vector{panel::Request::remove});
  driver.find("Grasp radius");
  driver.frame.elements = 7;
  driver.frame.removed = 3;
  driver.find("Removed", 1180);
}

TEST_CASE("the stretch monitor follows a new surface mesh") {
  Scene scene = small_scene();
  scene.materials = {{std::nullopt, find_preset("brain_ogden_swine")->material}};
  Driver driver(scene);
  driver.frame.stretches.assign(4, 2);
  driver.draw();
  CHECK(driver.panel.drawing().hatched.size() == 4);
  SurfaceMesh smaller = small_surface();
  smaller.version = 1;
  smaller.nodes.pop_back();
  smaller.rest.pop_back();
  smaller.triangles = {{0, 2, 1}};
  smaller.regions = {0};
  driver.frame.surface_mesh = std::make_shared<const SurfaceMesh>(smaller);
  driver.frame.positions = smaller.rest;
  driver.frame.stretches.assign(3, 2);
  driver.draw();
  CHECK(driver.panel.drawing().hatched.size() == 3);
}

TEST_CASE("a stopped body shows a banner with a reset button") {
  Driver driver;
  CHECK_FALSE(driver.panel.covers(640, 40));
  driver.frame.halted = "element 7 left the range of its law";
  for (int k = 0; k < 3; ++k) driver.draw();
  CHECK(driver.panel.covers(640, 40));
  bool found = false;
  for (float y = 10; y < 140 && !found; y += 4)
    for (float x = 420; x < 640 && !found; x += 12) {
      driver.move({x, y});
      driver.draw();
      found = driver.panel.hovered() == "Reset (R)";
    }
  REQUIRE(found);
  const auto actions = driver.click();
  REQUIRE(actions.commands.size() == 1);
  CHECK(std::holds_alternative<Reset>(actions.commands.front()));
}

TEST_CASE("in a window with no room beside the panel the banner has the whole width") {
  for (const float width : {240.0f, 320.0f, 400.0f}) {
    CAPTURE(width);
    Driver driver(small_scene(), width, 480, 0.72f);
    driver.frame.halted = "element 7 left the range of its law";
    for (int k = 0; k < 3; ++k) driver.draw();
    const ImGuiWindow* banner = ImGui::FindWindowByName("banner");
    REQUIRE(banner);
    CHECK(banner->Pos.x >= 0);
    CHECK(banner->Pos.x + banner->Size.x <= width);
    CHECK(banner->Size.x > 0.6f * width);
    CHECK(banner->ContentSize.y + 2 * banner->WindowPadding.y <= banner->Size.y + 1);  // down to the button
  }
}

TEST_CASE("a banner appears once the engine has been late for a second") {
  Driver driver(small_scene(), 800, 600);  // too narrow for a column at the right, where it stands else
  driver.frame.pace.keeping_up = false;
  driver.frame.pace.slowdown = 2.5;
  for (int k = 0; k < 10; ++k) driver.draw();
  CHECK_FALSE(driver.panel.covers(500, 40));
  for (int k = 0; k < 90; ++k) driver.draw();
  CHECK(driver.panel.covers(500, 40));
  driver.frame.pace.keeping_up = true;
  for (int k = 0; k < 3; ++k) driver.draw();
  CHECK_FALSE(driver.panel.covers(500, 40));
}

TEST_CASE("what was found on opening is a section until it is dismissed") {
  Driver driver;
  driver.panel.set_findings({"read in centimetres: scaled by 0.01", "634 slivers"});
  driver.click("Dismiss", 40);
  driver.away();
  driver.draw();
  for (float y = 4; y < 760; y += 4) {
    driver.move({40, y});
    driver.draw();
    CHECK(driver.panel.hovered() != "Dismiss");
  }
}

TEST_CASE("the error of a file that cannot be opened stays until Esc") {
  Driver driver;
  driver.panel.show_error("Could not be opened", "liver.obj: line 3: no number");
  for (int k = 0; k < 300; ++k) driver.draw();
  CHECK(driver.panel.covers(640, 30));
  after(driver, Action::release);
  for (int k = 0; k < 2; ++k) driver.draw();
  CHECK_FALSE(driver.panel.covers(640, 30));
}

TEST_CASE("a notice disappears by itself") {
  Driver driver;
  driver.panel.notify("Saved picture.png");
  driver.draw();
  CHECK(driver.panel.animating());
  for (int k = 0; k < 400; ++k) driver.draw();
  CHECK_FALSE(driver.panel.animating());
}

TEST_CASE("the panel covers its columns alone and nothing when hidden") {
  Driver driver;
  CHECK(driver.panel.covers(100, 100));
  CHECK(driver.panel.covers(1200, 100));
  CHECK_FALSE(driver.panel.covers(640, 360));
  after(driver, Action::hide);
  driver.draw();
  CHECK_FALSE(driver.panel.covers(100, 100));
  CHECK(driver.panel.insets({1280, 720}) == panel::Insets{});
}

TEST_CASE("an open choice captures the mouse") {
  Driver driver;
  driver.click("Law");
  CHECK(driver.panel.covers(640, 360));
  driver.away();
  driver.click();
  CHECK_FALSE(driver.panel.covers(640, 360));
}

TEST_CASE("in a small image the body keeps most of the width and the panel scrolls to every section") {
  Driver driver(small_scene(), 640, 360, 0.72f);
  const panel::Insets insets = driver.panel.insets({640, 360});
  CHECK(insets.right == 0);
  CHECK(insets.left < 0.36f * 640);
  driver.move({100, 250});
  for (int k = 0; k < 60; ++k) {
    ImGui::GetIO().MouseWheel = -1;
    driver.draw();
  }
  driver.find("Wireframe", 30);
  CHECK(driver.panel.hovered() == "Wireframe");
}

TEST_CASE("the help page opens and closes with its key and with Esc") {
  Driver driver;
  after(driver, Action::help);
  for (int k = 0; k < 3; ++k) driver.draw();
  CHECK(driver.panel.covers(640, 360));
  after(driver, Action::release);
  driver.draw();
  CHECK_FALSE(driver.panel.covers(640, 360));
}

TEST_CASE("numbers that are not finite do not break the panel") {
  Driver driver;
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  driver.frame.energies = {nan, infinity, -infinity};
  driver.frame.min_J = nan;
  driver.frame.tools.push_back(GraspState{.force = Vec3(nan, 0, 0)});
  driver.frame.field = Field::stretch;
  driver.frame.values = {std::numeric_limits<float>::quiet_NaN(), 1, 1, 1};
  for (int k = 0; k < 20; ++k) {
    driver.frame.time += 0.1;
    driver.draw();
  }
  CHECK(driver.draw().commands.empty());
}

TEST_CASE("the font has every letter that laws and units need") {
  Driver driver;
  std::string text = "λμνκγαρ·×²³°−–…";
  for (const LawInfo& law : laws()) {
    text += law.title;
    for (const ParameterInfo& info : law.parameters)
      text += std::string(info.symbol) + std::string(info.unit) + std::string(info.meaning);
  }
  const char* at = text.c_str();
  while (*at) {
    unsigned code = static_cast<unsigned char>(*at++);
    const int more = code >= 0xe0 ? 2 : code >= 0xc0 ? 1 : 0;
    if (more) code &= more == 2 ? 0x0f : 0x1f;
    for (int k = 0; k < more; ++k) code = code << 6 | (static_cast<unsigned char>(*at++) & 0x3f);
    CAPTURE(code);
    CHECK(panel::font(panel::Font::text)->FindGlyphNoFallback(static_cast<ImWchar>(code)));
  }
}

}  // namespace heml::panel_test
