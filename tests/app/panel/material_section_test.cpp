#include <heml/scenario/presets.hpp>

#include "driver.hpp"

namespace heml::material_section_test {

using namespace heml::test;

namespace {

Material material_of(const panel::PanelActions& actions) {
  REQUIRE(actions.commands.size() == 1);
  return std::get<SetMaterial>(actions.commands.front()).material;
}

/// The small scene with one material everywhere.
Scene scene_of(const Material& material) {
  Scene scene = small_scene();
  scene.materials = {{std::nullopt, material}};
  return scene;
}

/// Drags a slider by pixels to the right.
panel::PanelActions drag(Driver& driver, const std::string& label, float pixels) {
  const ImVec2 at = driver.find(label);
  driver.hold(true);
  driver.draw();
  driver.draw();
  driver.move({at.x + pixels, at.y});
  const auto actions = driver.draw();
  driver.hold(false);
  driver.draw();
  return actions;
}

}  // namespace

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
  const EngineeringConstants now = engineering_constants({set->material.parameters[0], set->material.parameters[1]});
  CHECK(now.young > 1e4);
  CHECK(now.poisson == doctest::Approx(0.3).epsilon(1e-9));
  CHECK(driver.draw().commands.empty());  // the mouse rests: nothing changes
  driver.move({at.x + 35, at.y});
  const auto second = driver.draw();
  REQUIRE(second.commands.size() == 1);
  const auto& parameters = std::get<SetMaterial>(second.commands.front()).material.parameters;
  CHECK(engineering_constants({parameters[0], parameters[1]}).young > now.young);
}

TEST_CASE("a panel without input returns no commands") {
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
  const LameParameters lame = lame_parameters(1e4, 0.3);
  CHECK(material.law == "stvk");
  REQUIRE(material.parameters.size() == 2);
  CHECK(material.parameters[0] == doctest::Approx(lame.lambda).epsilon(1e-12));
  CHECK(material.parameters[1] == doctest::Approx(lame.mu).epsilon(1e-12));
  CHECK(material.density == 1000);
  CHECK_FALSE(material_problem(material));
}

TEST_CASE("selecting the current law sends nothing") {
  Driver driver;
  CHECK(driver.choose("Law", "Neo-Hookean").commands.empty());
}

TEST_CASE("a Lamé parameter is changed alone") {
  Driver driver;
  CHECK(driver.choose("Parameters", "λ and μ").commands.empty());
  const ImVec2 at = driver.find("μ");
  driver.hold(true);
  driver.draw();
  driver.move({at.x - 50, at.y});
  const auto actions = driver.draw();
  REQUIRE(actions.commands.size() == 1);
  const auto& parameters = std::get<SetMaterial>(actions.commands.front()).material.parameters;
  CHECK(parameters[0] == lame_parameters(1e4, 0.3).lambda);
  CHECK(parameters[1] < lame_parameters(1e4, 0.3).mu);
}

TEST_CASE("a region's material is changed for that region") {
  Driver driver;
  CHECK(driver.choose("Region", "Region 2").commands.empty());
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

TEST_CASE("the one region without a material of its own has its name, and several together have one") {
  {
    Driver driver(small_scene(), 1280, 760, 1, {{1, "liver"}}, {1, 2});
    driver.choose("Region", "Region 2");
    driver.choose("Region", "liver");
  }
  {
    Driver driver(small_scene(), 1280, 760, 1, {}, {1, 2});
    driver.choose("Region", "Region 2");
    driver.choose("Region", "Region 1");
  }
  Driver driver(small_scene(), 1280, 760, 1, {}, {1, 2, 3});
  driver.choose("Region", "Region 2");
  driver.choose("Region", "Other regions");
}

TEST_CASE("the panel edits the material that a script has set") {
  Driver driver;
  driver.panel.sync(SetMaterial{std::nullopt, {"stvk", {3e4, 2e4}, 1200}});
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
  CHECK(engineering_constants({parameters[0], parameters[1]}).young == doctest::Approx(25e3));
}

TEST_CASE("a tissue preset sets law and parameters and keeps the density") {
  Driver driver;
  const Preset& preset = *find_preset("liver_human");
  const Material material = material_of(driver.choose("Tissue", preset.title));
  CHECK(material.law == preset.material.law);
  CHECK(material.parameters == preset.material.parameters);
  CHECK(material.density == 1000);
  driver.find("Source");  // with its source
  CHECK(driver.choose("Tissue", preset.title).commands.empty());
}

TEST_CASE("a tissue preset with fibres keeps the current fibre direction") {
  Material fibres = find_preset("myocardium_hgo")->material;
  fibres.fibre = Vec3::UnitZ();
  fibres.parameters[0] = 40;
  Driver driver(scene_of(fibres));
  const Material material = material_of(driver.choose("Tissue", find_preset("myocardium_hgo")->title));
  CHECK(material.fibre == Vec3::UnitZ());
  CHECK(material.parameters == find_preset("myocardium_hgo")->material.parameters);
}

TEST_CASE("terms of a sum have sliders of their own and can be added without changing the law") {
  Driver driver(scene_of(find_preset("brain_ogden")->material));
  const Material one = material_of(drag(driver, "α1", 4));
  CHECK(one.parameters[1] != -19);
  CHECK(one.parameters[1] < 0);
  const Material two = material_of(driver.click("Add term", 80));
  REQUIRE(two.parameters.size() == 5);
  CHECK(two.parameters[0] == two.parameters[1]);
  CHECK(two.parameters[2] == two.parameters[3]);
  CHECK(small_strain_moduli(two).shear == doctest::Approx(small_strain_moduli(one).shear).epsilon(1e-12));
  CHECK(small_strain_moduli(two).bulk == small_strain_moduli(one).bulk);
  driver.find("μ2");
  CHECK(material_of(driver.click("Remove term")).parameters.size() == 3);
  CHECK(driver.click("Remove term").commands.empty());  // the last one stays
}

TEST_CASE("the azimuth slider turns the fibre") {
  Driver driver(scene_of(find_preset("myocardium_hgo")->material));
  const Material turned = material_of(drag(driver, "Fibre azimuth", 20));
  CHECK(turned.fibre.norm() == doctest::Approx(1));
  CHECK(turned.fibre.y() == doctest::Approx(0));
  CHECK(std::abs(turned.fibre.x() - 1) > 1e-3);
}

TEST_CASE("a parameter from a mesh field has no slider") {
  Material material;
  material.law = "neo_hookean";
  material.parameters = {4e3, 1e3};
  material.fields = {{1, "stiffness"}};
  Driver driver(scene_of(material));
  CHECK(drag(driver, "λ", 20).commands.size() == 1);
  CHECK(drag(driver, "μ", 20).commands.empty());
}

TEST_CASE("every law can be chosen and drawn") {
  for (const LawInfo& law : laws()) {
    CAPTURE(law.name);
    Driver driver;
    if (law.name == "neo_hookean") continue;
    const Material material = material_of(driver.choose("Law", std::string(law.title)));
    CHECK(material.law == law.name);
    driver.draw();
    if (law.is_continuum) driver.find("Shear modulus at rest");
  }
}

}  // namespace heml::material_section_test
