#include "driver.hpp"

namespace heml::motion_section_test {

using namespace heml::test;

TEST_CASE("another kind of integrator comes with the rate that suits it") {
  Driver driver(small_scene(), 1280, 1000);
  const auto actions = driver.choose("Integrator", info_of(Integrator::backward_euler).title);
  REQUIRE(actions.commands.size() == 2);
  CHECK(std::get<SetIntegrator>(actions.commands[0]).integrator == Integrator::backward_euler);
  CHECK(std::get<SetRate>(actions.commands[1]).rate == 60);
  const auto same_kind = driver.choose("Integrator", info_of(Integrator::bdf2).title);
  CHECK(same_kind.commands.size() == 1);
  const auto back = driver.choose("Integrator", info_of(Integrator::verlet).title);
  REQUIRE(back.commands.size() == 2);
  CHECK(std::get<SetRate>(back.commands[1]).rate == 1000);
}

TEST_CASE("rate and budget are chosen and written into a saved scene, and follow commands") {
  Scene scene = small_scene();
  scene.solver.integrator = Integrator::backward_euler;
  scene.solver.step = 0.002;
  Driver driver(scene, 1280, 1000);
  Scene unchanged = scene;
  driver.panel.write_into(unchanged);
  CHECK(unchanged.solver.step == 0.002);
  CHECK_FALSE(unchanged.solver.budget);
  const auto rate = driver.choose("Rate", "30 Hz, 33.3 ms");
  REQUIRE(rate.commands.size() == 1);
  CHECK(std::get<SetRate>(rate.commands[0]).rate == 30);
  const auto budget = driver.choose("Budget", "2 iterations");
  REQUIRE(budget.commands.size() == 1);
  CHECK(std::get<SetBudget>(budget.commands[0]).iterations == 2);
  driver.panel.sync(SetBudget{3});
  driver.panel.write_into(scene);
  CHECK_FALSE(scene.solver.step);
  CHECK(scene.solver.rate == 30);
  CHECK(scene.solver.budget->iterations == 3);
}

TEST_CASE("gravity is typed by components") {
  Driver driver;
  CHECK(driver.choose("Direction", "x, y, z").commands.empty());
  driver.find("Gravity x, y, z", 130);
  driver.click();
  ImGui::GetIO().AddInputCharactersUTF8("2.5");
  CHECK(driver.draw().commands.empty());  // not at each keystroke
  driver.away();
  const auto commands = driver.click().commands;
  REQUIRE(commands.size() == 1);
  CHECK(std::get<SetGravity>(commands[0]).gravity.isApprox(Vec3(2.5, -9.81, 0)));
}

TEST_CASE("numbers are typed with a decimal comma and an exponent") {
  const auto typed = [](const char* text) {
    Driver driver;
    driver.choose("Direction", "x, y, z");
    driver.find("Gravity x, y, z", 130);
    driver.click();
    ImGui::GetIO().AddInputCharactersUTF8(text);
    driver.draw();
    driver.away();
    const auto commands = driver.click().commands;
    REQUIRE(commands.size() == 1);
    return std::get<SetGravity>(commands[0]).gravity.x();
  };
  CHECK(typed("2,5") == doctest::Approx(2.5));
  CHECK(typed("-2,5e-1") == doctest::Approx(-0.25));
  CHECK(typed("5000") == doctest::Approx(1000));  // the limit
  CHECK(typed("-1e999") == doctest::Approx(-1000));
}

TEST_CASE("a slider takes a typed decimal comma") {
  Driver driver;
  driver.find("Damping");
  ImGui::GetIO().KeyCtrl = true;
  ImGui::GetIO().KeyMods = ImGuiKeyModFlags_Ctrl;
  driver.click();
  ImGui::GetIO().KeyCtrl = false;
  ImGui::GetIO().KeyMods = 0;
  ImGui::GetIO().AddInputCharactersUTF8("2,5");
  driver.draw();
  driver.away();
  const auto commands = driver.click().commands;
  REQUIRE(commands.size() == 1);
  CHECK(std::get<SetDamping>(commands[0]).damping == doctest::Approx(2.5));
}

TEST_CASE("settings stay those of the live body while a past frame is shown") {
  Driver driver;
  panel::Timeline timeline;
  timeline.rate = timeline.live = timeline.end = 100;
  timeline.shown = 50;
  UndoList past;
  past.steps = 1;
  past.settings = {SetDamping{7}};
  driver.frame.undo_list = std::make_shared<UndoList>(past);
  driver.panel.set_timeline(timeline);
  driver.draw();
  Scene saved = small_scene();
  driver.panel.write_into(saved);
  CHECK(saved.solver.damping == small_scene().solver.damping);
  timeline.shown.reset();
  driver.panel.set_timeline(timeline);
  driver.draw();
  driver.panel.write_into(saved);
  CHECK(saved.solver.damping == 7);
}

TEST_CASE("the arrow of gravity is offered where gravity is typed") {
  Driver driver;
  CHECK_FALSE(driver.panel.motion().has_arrow());
  CHECK(driver.panel.motion().gravity().isApprox(Vec3(0, -9.81, 0)));
  driver.choose("Direction", "x, y, z");
  CHECK(driver.click("Arrow in the image", 30).commands.empty());
  CHECK(driver.panel.motion().has_arrow());
  driver.choose("Direction", "up (+y)");
  CHECK_FALSE(driver.panel.motion().has_arrow());
}

}  // namespace heml::motion_section_test
