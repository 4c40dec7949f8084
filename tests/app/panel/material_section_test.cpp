#include "driver.hpp"

using namespace heml;
using namespace heml::test;

TEST_CASE("dragging a slider sends the material with the new value, once a frame") {
  Driver driver;
  const ImVec2 at = driver.find("Young's E");
  driver.hold(true);
  driver.draw();
  driver.draw();
  driver.move({at.x + 30, at.y});
  const auto first = driver.draw();
  REQUIRE(first.commands.size() == 1);
  const auto* set = std::get_if<SetMaterial>(&first.commands.front());
  REQUIRE(set);
  CHECK_FALSE(set->region);
  CHECK(set->material.law == "neo_hookean");
  CHECK(set->material.density == 1000);
  const Engineering now = engineering_from({set->material.parameters[0], set->material.parameters[1]});
  CHECK(now.young > 1e4);
  CHECK(now.poisson == doctest::Approx(0.3).epsilon(1e-9));
  CHECK(driver.draw().commands.empty());  // the mouse rests: nothing changes
  driver.move({at.x + 35, at.y});
  const auto second = driver.draw();
  REQUIRE(second.commands.size() == 1);
  const auto& parameters = std::get<SetMaterial>(second.commands.front()).material.parameters;
  CHECK(engineering_from({parameters[0], parameters[1]}).young > now.young);
}

TEST_CASE("a panel that nobody touches asks for nothing") {
  Driver driver;
  for (int k = 0; k < 30; ++k) {
    driver.frame.tick += 16;
    driver.frame.time += 0.016;
    const auto actions = driver.draw();
    CHECK(actions.commands.empty());
    CHECK(actions.requests.empty());
    CHECK_FALSE(actions.show);
  }
}

TEST_CASE("switching the law keeps the moduli and the density") {
  Driver driver;
  const auto actions = driver.choose("Law", "Saint Venant-Kirchhoff");
  REQUIRE(actions.commands.size() == 1);
  const Material material = std::get<SetMaterial>(actions.commands.front()).material;
  const Lame lame = lame_from(1e4, 0.3);
  CHECK(material.law == "stvk");
  REQUIRE(material.parameters.size() == 2);
  CHECK(material.parameters[0] == doctest::Approx(lame.lambda).epsilon(1e-12));
  CHECK(material.parameters[1] == doctest::Approx(lame.mu).epsilon(1e-12));
  CHECK(material.density == 1000);
  CHECK_FALSE(material_problem(material));
}

TEST_CASE("choosing the law that is there sends nothing") {
  Driver driver;
  CHECK(driver.choose("Law", "Neo-Hookean").commands.empty());
}

TEST_CASE("a Lamé parameter is changed alone") {
  Driver driver;
  CHECK(driver.choose("Given as", "λ and μ").commands.empty());
  const ImVec2 at = driver.find("μ");
  driver.hold(true);
  driver.draw();
  driver.move({at.x - 25, at.y});
  const auto actions = driver.draw();
  REQUIRE(actions.commands.size() == 1);
  const auto& parameters = std::get<SetMaterial>(actions.commands.front()).material.parameters;
  CHECK(parameters[0] == lame_from(1e4, 0.3).lambda);
  CHECK(parameters[1] < lame_from(1e4, 0.3).mu);
}

TEST_CASE("a region's material is changed for that region") {
  Driver driver;
  CHECK(driver.choose("Part", "Region 2").commands.empty());
  const ImVec2 at = driver.find("Density");
  driver.hold(true);
  driver.draw();
  driver.move({at.x + 20, at.y});
  const auto actions = driver.draw();
  REQUIRE(actions.commands.size() == 1);
  const auto& set = std::get<SetMaterial>(actions.commands.front());
  CHECK(set.region == 2);
  CHECK(set.material.law == "stvk");
  CHECK(set.material.density > 1100);
}

TEST_CASE("what a script changed is what the panel goes on from") {
  Driver driver;
  driver.panel.follow(SetMaterial{std::nullopt, {"stvk", {3e4, 2e4}, 1200}});
  const ImVec2 at = driver.find("Density");
  driver.hold(true);
  driver.draw();
  driver.move({at.x + 20, at.y});
  const auto actions = driver.draw();
  REQUIRE(actions.commands.size() == 1);
  const Material material = std::get<SetMaterial>(actions.commands.front()).material;
  CHECK(material.law == "stvk");
  CHECK(material.parameters == std::vector<double>{3e4, 2e4});
  CHECK(material.density > 1200);
}

TEST_CASE("a slider typed into takes the number in the unit shown") {
  Driver driver;
  driver.find("Young's E");
  ImGuiIO& io = ImGui::GetIO();
  io.KeyCtrl = true;
  driver.click();
  io.KeyCtrl = false;
  for (const char c : std::string("25")) io.AddInputCharacter(static_cast<unsigned>(c));
  auto actions = driver.draw();
  io.KeyMap[ImGuiKey_Enter] = 13;
  io.KeysDown[13] = true;
  const auto after = driver.draw();
  actions.commands.insert(actions.commands.end(), after.commands.begin(), after.commands.end());
  REQUIRE(!actions.commands.empty());
  const auto& parameters = std::get<SetMaterial>(actions.commands.back()).material.parameters;
  CHECK(engineering_from({parameters[0], parameters[1]}).young == doctest::Approx(25e3));
}
