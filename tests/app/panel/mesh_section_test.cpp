#include "driver.hpp"

namespace heml::mesh_section_test {

using namespace heml::test;

namespace {

/// As scene_around() makes it of a mesh 15 long.
Scene mesh_scene(const BareMeshOptions& given = {}) {
  Scene scene = small_scene();
  BareMeshChoices& chosen = scene.chosen.emplace();
  chosen.given = given;
  chosen.unit = given.unit ? given.unit->name : "centimetres";
  chosen.scale = given.unit ? given.unit->scale : 0.01;
  chosen.length = 15 * chosen.scale;
  chosen.up = given.up.value_or(UpAxis::z);
  chosen.supports = given.supports.value_or(SupportKind::underside);
  chosen.texts = {{"unit", "read in centimetres"}, {"up", "z points up"}, {"supports", "rests"}};
  return scene;
}

bool has_row(Driver& driver, const std::string& label, float x = 200) {
  for (float y = 2; y < 700; y += 4) {
    driver.move({x, y});
    driver.draw();
    if (driver.panel.hovered() == label) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("what was guessed of a bare mesh is changed with one choice each") {
  Driver driver(mesh_scene());
  CHECK(driver.choose("Unit", "inches, 0.381 m").mesh_options == BareMeshOptions{LengthUnit{"inches", 0.0254}, {}, {}});
  CHECK(driver.choose("Up", "-x").mesh_options == BareMeshOptions{{}, UpAxis::minus_x, {}});
  CHECK(driver.choose("Supports", "on a table").mesh_options == BareMeshOptions{{}, {}, SupportKind::table});
}

TEST_CASE("the choice that is shown changes nothing") {
  Driver driver(mesh_scene());
  CHECK_FALSE(driver.choose("Unit", "centimetres").mesh_options);
  CHECK_FALSE(driver.choose("Up", "z").mesh_options);
  CHECK_FALSE(driver.choose("Supports", "underside held").mesh_options);
}

TEST_CASE("a choice keeps the earlier ones, and each goes back to the guess by itself") {
  const BareMeshOptions given{LengthUnit{"millimetres", 0.001}, UpAxis::x, SupportKind::top};
  Driver driver(mesh_scene(given));
  BareMeshOptions wanted = given;
  wanted.supports = SupportKind::underside;
  CHECK(driver.choose("Supports", "underside held").mesh_options == wanted);
  wanted.supports.reset();
  CHECK(driver.choose("Supports", "as guessed").mesh_options == wanted);
  CHECK(driver.choose("Up", "as guessed").mesh_options == BareMeshOptions{given.unit, {}, given.supports});
  CHECK(driver.choose("Unit", "as guessed").mesh_options == BareMeshOptions{{}, given.up, given.supports});
}

TEST_CASE("the choices stay when the text is dismissed, and a scene file has none") {
  Driver driver(mesh_scene());
  driver.panel.set_findings({"read in centimetres"});
  driver.draw();
  CHECK(has_row(driver, "This mesh"));
  driver.click("Dismiss", 40);
  CHECK_FALSE(has_row(driver, "Dismiss", 40));
  CHECK(has_row(driver, "Up"));
  Driver other;
  other.panel.set_findings({"a warning"});
  other.draw();
  CHECK(has_row(other, "As opened"));
  CHECK_FALSE(has_row(other, "This mesh"));
  CHECK_FALSE(has_row(other, "Up"));
}

TEST_CASE("a scan's header names its unit") {
  Scene scene = mesh_scene();
  scene.mesh.labels = "labels.nii";
  Driver driver(scene);
  CHECK(has_row(driver, "Up"));
  CHECK_FALSE(has_row(driver, "Unit"));
}

}  // namespace heml::mesh_section_test
