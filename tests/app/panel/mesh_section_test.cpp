#include <heml/scenario/presets.hpp>

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
  chosen.read_tets = chosen.tets = 2048;
  chosen.young = 1e4;
  chosen.texts = {{"unit", "read in centimetres"}, {"up", "z points up"}, {"supports", "rests"}};
  return scene;
}

constexpr float back = 258;  // of the buttons at the ends of rows, pixels

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
  CHECK_FALSE(driver.choose("Supports", "underside fixed").mesh_options);
}

TEST_CASE("a choice keeps the earlier ones, and a button at its end goes back to the guess") {
  BareMeshOptions given{LengthUnit{"millimetres", 0.001}, UpAxis::x, SupportKind::top};
  given.tets = 500;
  Driver driver(mesh_scene(given));
  BareMeshOptions wanted = given;
  wanted.supports = SupportKind::underside;
  CHECK(driver.choose("Supports", "underside fixed").mesh_options == wanted);
  const auto without = [&](auto BareMeshOptions::*option) {
    BareMeshOptions rest = given;
    (rest.*option).reset();
    return rest;
  };
  CHECK(driver.click("Unit as guessed", back).mesh_options == without(&BareMeshOptions::unit));
  CHECK(driver.click("Up as guessed", back).mesh_options == without(&BareMeshOptions::up));
  CHECK(driver.click("Supports as guessed", back).mesh_options == without(&BareMeshOptions::supports));
  CHECK(driver.click("Tetrahedra as guessed", back).mesh_options == without(&BareMeshOptions::tets));
  Driver other(mesh_scene());
  CHECK_FALSE(has_row(other, "Up as guessed", back));
}

TEST_CASE("a length that is typed scales the body to it") {
  const auto typed = [](const char* text) {
    Driver driver(mesh_scene());
    driver.click("Length");
    ImGui::GetIO().AddInputCharactersUTF8(text);
    CHECK_FALSE(driver.draw().mesh_options);  // not at each keystroke
    driver.away();
    return driver.click().mesh_options;
  };
  const auto options = typed("30");
  REQUIRE(options);
  CHECK(options->unit->name == "");
  CHECK(options->unit->scale == doctest::Approx(0.02).epsilon(1e-12));  // 15 of the file are 30 cm
  CHECK(typed("99999")->unit->scale == doctest::Approx(2.0 / 15).epsilon(1e-12));
  CHECK(typed("0")->unit->scale == doctest::Approx(0.001 / 15).epsilon(1e-12));
  CHECK_FALSE(typed("15"));
  CHECK_FALSE(typed(""));
}

TEST_CASE("a body that was scaled to a length says so in place of the unit") {
  BareMeshOptions given;
  given.unit = LengthUnit{"", 0.02};
  Driver driver(mesh_scene(given));
  CHECK_FALSE(driver.choose("Unit", "by its length").mesh_options);
  CHECK(driver.choose("Unit", "centimetres, 0.15 m").mesh_options->unit == LengthUnit{"centimetres", 0.01});
}

TEST_CASE("another tissue opens the mesh again with the preset") {
  Driver driver(mesh_scene());
  CHECK(driver.choose("Tissue", find_preset("spleen_pig")->title).mesh_options->tissue == "spleen_pig");
  CHECK_FALSE(driver.choose("Tissue", "soft, 10.0 kPa").mesh_options);
  Scene scene = mesh_scene();
  scene.chosen->given.tissue = "spleen_pig";
  scene.materials = {{std::nullopt, find_preset("spleen_pig")->material}};
  Driver given(scene);
  CHECK_FALSE(given.choose("Tissue", find_preset("spleen_pig")->title).mesh_options);
  CHECK(given.click("Tissue as guessed", back).mesh_options == BareMeshOptions());
}

TEST_CASE("coarser, finer and better meshes are offered about the number of the file") {
  Driver driver(mesh_scene());
  const std::string gap = "\u00a0";  // grouped digits
  CHECK(driver.choose("Tetrahedra", "510, coarser").mesh_options->tets == 510);
  CHECK(driver.choose("Tetrahedra", "4" + gap + "100, finer").mesh_options->tets == 4100);
  CHECK(driver.choose("Tetrahedra", "2" + gap + "048, better shapes").mesh_options->tets == 2048);
  CHECK_FALSE(driver.choose("Tetrahedra", "2" + gap + "048").mesh_options);
}

TEST_CASE("the numbers that are offered stay about the file's own after a choice") {
  BareMeshOptions given;
  given.tets = 510;
  Scene scene = mesh_scene(given);
  scene.chosen->read_tets = scene.chosen->tets = 500;  // a surface, filled as asked
  Driver driver(scene);
  panel::MeshOpenings openings;
  openings.adopt("a.obj", {}, 2048);
  openings.adopt("a.obj", given);
  driver.panel.mesh().set_openings(openings);
  const std::string gap = "\u00a0";  // grouped digits
  CHECK(driver.choose("Tetrahedra", "4" + gap + "100, finer").mesh_options->tets == 4100);
  CHECK(driver.choose("Tetrahedra", "2" + gap + "048, finer").mesh_options->tets == 2048);
}

TEST_CASE("what was found is listed with counts") {
  Scene scene = mesh_scene();
  scene.chosen->findings = {{4, "holes", "closed", true}, {634, "slivers", "kept", false}};
  Driver driver(scene);
  CHECK(has_row(driver, "4 holes"));
  CHECK(has_row(driver, "634 slivers"));
  CHECK_FALSE(has_row(driver, "Found"));
  Driver good(mesh_scene());
  CHECK(has_row(good, "Found"));
}

TEST_CASE("a button keeps the mesh as a scene, and the file is told") {
  Driver driver(mesh_scene());
  CHECK(driver.click("Keep as scene", 40).requests == std::vector{panel::Request::save});
  CHECK_FALSE(has_row(driver, "Kept"));
  driver.panel.mesh().set_kept("/tmp/heml-small.json");
  CHECK(has_row(driver, "Kept"));
}

TEST_CASE("the section is closed by its button and opened by its title, and a scene file has none") {
  Driver driver(mesh_scene());
  driver.panel.set_findings({"read in centimetres"});
  driver.draw();
  CHECK(has_row(driver, "This mesh"));
  CHECK(driver.panel.mesh().is_open());
  driver.click("Close", 140);
  CHECK_FALSE(driver.panel.mesh().is_open());
  CHECK_FALSE(has_row(driver, "Up"));
  driver.click("This mesh");
  CHECK(driver.panel.mesh().is_open());
  CHECK(has_row(driver, "Up"));
  CHECK(driver.panel.preferences().sections.empty());  // of this file alone
  Driver other;
  other.panel.set_findings({"a warning"});
  other.draw();
  CHECK(has_row(other, "As opened"));
  CHECK_FALSE(has_row(other, "This mesh"));
  CHECK_FALSE(has_row(other, "Up"));
}

TEST_CASE("undo opens the mesh as before") {
  Driver driver(mesh_scene(), 1280, 1600);
  panel::MeshOpenings openings;
  BareMeshOptions turned;
  turned.up = UpAxis::x;
  openings.adopt("a", turned);
  openings.adopt("a", {});
  driver.panel.mesh().set_openings(openings);
  driver.panel.perform(panel::Action::undo);
  CHECK(driver.draw().mesh_options == turned);
  driver.click("Actions");
  CHECK(driver.click("up: as guessed", 60).mesh_options == turned);
}

TEST_CASE("a scan's header names its unit") {
  Scene scene = mesh_scene();
  scene.mesh.labels = "labels.nii";
  Driver driver(scene);
  CHECK(has_row(driver, "Up"));
  CHECK_FALSE(has_row(driver, "Unit"));
}

}  // namespace heml::mesh_section_test
