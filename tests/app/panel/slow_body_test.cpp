#include <app/panel/slow_body.hpp>

#include "driver.hpp"

namespace heml::slow_body_test {

using namespace heml::test;

namespace {

Frame slow_frame(std::size_t tets, double rate, double tick) {
  Frame frame;
  frame.elements = tets;
  frame.pace.rate = rate;
  frame.pace.p50 = tick;
  frame.pace.slowdown = 3;
  frame.pace.keeping_up = false;
  return frame;
}

Scene explicit_scene() {
  Scene scene = small_scene();
  scene.solver.integrator = Integrator::verlet;
  return scene;
}

/// The panel of a body of 4000 tetrahedra that has been slow for over a second.
void make_slow(Driver& driver) {
  driver.frame.elements = 4000;
  driver.frame.pace = slow_frame(4000, 1000, 3e-3).pace;
  for (int k = 0; k < 100; ++k) driver.draw();
}

}  // namespace

TEST_CASE("an explicit body that is slow is offered backward Euler, with what that costs") {
  const auto cure = panel::cure_for(slow_frame(4000, 1000, 3e-3), Integrator::verlet, 0);
  REQUIRE(cure);
  CHECK(cure->button == "Use backward Euler at 60 Hz: real time");
  CHECK(cure->cost.find("47 %") != std::string::npos);  // lost_in_a_period(2, 60)
  const std::vector<Command> commands = cure->commands();
  REQUIRE(commands.size() == 3);
  CHECK(std::get<SetIntegrator>(commands[0]).integrator == Integrator::backward_euler);
  CHECK(std::get<SetRate>(commands[1]).rate == 60);
  CHECK(std::get<SetBudget>(commands[2]).iterations == 1);
}

TEST_CASE("an implicit body that is slow is offered fewer iterations or a lower rate, by what it measured") {
  const auto solved = panel::cure_for(slow_frame(4000, 100, 0.03), Integrator::backward_euler, 0);
  REQUIRE(solved);
  CHECK(solved->method.rate == 60);
  const auto lower = panel::cure_for(slow_frame(4000, 60, 0.03), Integrator::backward_euler, 1);
  REQUIRE(lower);
  CHECK(lower->method.rate == 20);
  CHECK(lower->button == "Use backward Euler at 20 Hz: real time");
  const auto nearer = panel::cure_for(slow_frame(4000, 60, 0.3), Integrator::backward_euler, 1);
  REQUIRE(nearer);
  CHECK(nearer->button == "Use backward Euler at 10 Hz: 3.0× slower than real time");
  CHECK_FALSE(panel::cure_for(slow_frame(4000, 10, 0.3), Integrator::backward_euler, 1));
}

TEST_CASE("an implicit body that keeps its steps is told what fewer iterations cost") {
  const auto fewer = panel::cure_for(slow_frame(4000, 60, 0.03), Integrator::backward_euler, 0);
  REQUIRE(fewer);
  CHECK(fewer->method.rate == 60);
  CHECK(fewer->button == "Use 1 iteration a step: real time");
  CHECK(fewer->cost.find("wobble") == std::string::npos);
}

TEST_CASE("the banner of a slow body stands off the body and its button sends the cure") {
  Driver driver(explicit_scene());
  make_slow(driver);
  CHECK_FALSE(driver.panel.covers(640, 40));
  CHECK_FALSE(driver.panel.covers(640, 380));
  driver.find("Use backward Euler at 60 Hz: real time", 1100);
  const auto actions = driver.click();
  REQUIRE(actions.commands.size() == 3);
  CHECK(std::get<SetRate>(actions.commands[1]).rate == 60);
  Scene scene = explicit_scene();
  driver.panel.write_into(scene);
  CHECK(scene.solver.integrator == Integrator::backward_euler);
  CHECK(scene.solver.rate == 60);
  CHECK(scene.solver.budget->iterations == 1);
}

TEST_CASE("the banner of a slow body can be dismissed and stays so") {
  Driver driver(explicit_scene());
  make_slow(driver);
  driver.click("Dismiss", 1080);
  driver.away();
  for (int k = 0; k < 100; ++k) driver.draw();
  for (float y = 4; y < 760; y += 8) {
    driver.move({1080, y});
    driver.draw();
    CHECK(driver.panel.hovered() != "Dismiss");
  }
}

}  // namespace heml::slow_body_test
