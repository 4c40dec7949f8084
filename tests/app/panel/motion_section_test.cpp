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
