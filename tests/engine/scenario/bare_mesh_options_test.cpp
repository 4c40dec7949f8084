#include <doctest/doctest.h>

#include <engine/mesh/files.hpp>
#include <heml/mesh/generate.hpp>
#include <heml/mesh/write.hpp>
#include <heml/scenario/body_shape.hpp>
#include <heml/scenario/presets.hpp>
#include <heml/scenario/scene.hpp>
#include <heml/scenario/selection.hpp>

namespace heml::bare_mesh_options_test {

namespace {

Scene scene_of(const TetMesh& mesh, const BareMeshOptions& options) {
  const TemporaryFolder folder;
  write_tet_mesh(folder / "body.msh", mesh);
  return read_scene(folder / "body.msh", options);  // the mesh has been read
}

std::string text_about(const Scene& scene, const std::string& about) {
  for (const BareMeshChoices::Text& text : scene.chosen->texts)
    if (text.about == about) return text.text;
  return "";
}

/// The coordinate of a point along an axis of the file.
double along(const std::string& axis, const Vec3& x) { return (axis.size() == 2 ? -1 : 1) * x[axis.back() - 'x']; }

}  // namespace

TEST_CASE("a unit that is given scales the body by its factor") {
  const TetMesh mesh = make_box(Vec3(15, 10, 10), {3, 2, 2});
  CHECK(scene_of(mesh, {}).mesh.scale == 0.01);
  BareMeshOptions options;
  for (const LengthUnit& unit : plausible_units(15)) {
    options.unit = unit;
    const Scene scene = scene_of(mesh, options);
    CHECK(scene.mesh.scale == unit.scale);
    CHECK(scene.chosen->unit == unit.name);
    CHECK(scene.chosen->length == 15 * unit.scale);
    CHECK(text_about(scene, "unit").find("as chosen") != std::string::npos);
    const auto [low, high] = bounds_of(load_setup(scene).mesh.nodes);
    CHECK((high - low).maxCoeff() == doctest::Approx(15 * unit.scale).epsilon(1e-12));
  }
}

TEST_CASE("units are offered in which the body has a plausible size") {
  const auto names = [](double length) {
    std::vector<std::string> all;
    for (const LengthUnit& unit : plausible_units(length)) all.push_back(unit.name);
    return all;
  };
  CHECK(names(0.15) == std::vector<std::string>{"metres", "decimetres", "centimetres", "inches", ""});
  CHECK(names(150) == std::vector<std::string>{"centimetres", "millimetres", ""});
  CHECK(names(1e7) == std::vector<std::string>{""});
  CHECK(plausible_units(1e7).back().scale == doctest::Approx(2e-8).epsilon(1e-12));
}

TEST_CASE("the axis that is given points up, and the lowest part along it carries the body") {
  const TetMesh mesh = make_box(Vec3(0.1, 0.12, 0.14), {3, 3, 3}, Vec3(0.01, 0.02, 0.03));
  BareMeshOptions options;
  for (const UpAxis axis : up_axes) {
    options.up = axis;
    const Scene scene = scene_of(mesh, options);
    const std::string name = info_of(axis).name;
    CAPTURE(name);
    CHECK(scene.chosen->up == axis);
    CHECK(text_about(scene, "up").starts_with(name + " points up, as chosen"));
    CHECK(scene.gravity == Vec3(0, -9.81, 0));
    const WorldSetup setup = load_setup(scene);
    double lowest = 1, error = 0;
    for (std::size_t k = 0; k < mesh.nodes.size(); ++k) {
      lowest = std::min(lowest, along(name, mesh.nodes[k]));
      error = std::max(error, std::abs(setup.mesh.nodes[k].y() - along(name, mesh.nodes[k])));
    }
    CHECK(error < 1e-12);
    for (const Tet& tet : setup.mesh.tets) {  // turned, not mirrored
      const auto& x = setup.mesh.nodes;
      REQUIRE(signed_volume(x[tet[0]], x[tet[1]], x[tet[2]], x[tet[3]]) > 0);
    }
    REQUIRE(setup.boundary.size() == 1);
    CHECK(setup.boundary[0].nodes.size() == 49);  // a layer of quadratic elements
    for (const int node : setup.boundary[0].nodes) CHECK(setup.mesh.nodes[node].y() == doctest::Approx(lowest));
  }
}

TEST_CASE("supports that are given hold the body where they say") {
  const TetMesh mesh = make_box(Vec3(0.1, 0.1, 0.1), {3, 3, 3});
  BareMeshOptions options;
  for (const bool top : {false, true}) {
    options.supports = top ? SupportKind::top : SupportKind::underside;
    const Scene scene = scene_of(mesh, options);
    CHECK(scene.chosen->supports == options.supports);
    CHECK(text_about(scene, "supports").ends_with(", as chosen"));
    CHECK(scene.tables.empty());
    const WorldSetup setup = load_setup(scene);
    REQUIRE(setup.boundary.size() == 1);
    CHECK(setup.boundary[0].nodes.size() == 49);  // a layer of quadratic elements
    for (const int node : setup.boundary[0].nodes) CHECK(setup.mesh.nodes[node].y() == doctest::Approx(top ? 0.1 : 0));
  }
}

TEST_CASE("a body on a table is held nowhere and stays on it") {
  BareMeshOptions options;
  options.supports = SupportKind::table;
  const Scene scene = scene_of(make_box(Vec3(0.1, 0.06, 0.1), {4, 3, 4}, Vec3(0, 0.5, 0)), options);
  CHECK(scene.boundary.empty());
  REQUIRE(scene.tables.size() == 1);
  CHECK(scene.tables[0].point.y() == 0.5);
  CHECK(scene.chosen->young == 1e4);
  CHECK(scene.chosen->stretch <= 1.2);
  const auto world = load_world(scene);
  while (world->time() < 1 && !world->halt()) world->tick();
  REQUIRE(!world->halt());
  const auto [low, high] = bounds_of(world->positions());
  CHECK(low.y() > 0.4999);
  CHECK(low.y() < 0.5005);
  CHECK(high.y() > 0.55);
  CHECK(std::abs(low.x()) < 0.01);
}

TEST_CASE("a tissue that is given is the preset's, and the method is chosen for it") {
  const TetMesh mesh = make_box(Vec3(0.1, 0.1, 0.1), {4, 4, 4});
  const Scene guessed = scene_of(mesh, {});
  for (const Preset& preset : presets()) {
    CAPTURE(preset.name);
    BareMeshOptions options;
    options.tissue = preset.name;
    const Scene scene = scene_of(mesh, options);
    REQUIRE(scene.materials.size() == 1);
    CHECK(preset_of(scene.materials[0].material) == &preset);
    CHECK(scene.materials[0].material.density == 1000);
    CHECK(text_about(scene, "tissue").starts_with(preset.title + ", as chosen"));
    CHECK(scene.chosen->load <= 0.7);
    const SmallStrainModuli rest = small_strain_moduli(scene.materials[0].material);
    CHECK(scene.chosen->young / (2 * (1 + scene.chosen->poisson)) == doctest::Approx(rest.shear).epsilon(1e-9));
    CHECK(parse_scene(scene_text(scene), "saved.json").materials[0].material == scene.materials[0].material);
  }
  CHECK(preset_of(guessed.materials[0].material) == nullptr);
}

TEST_CASE("a tissue that there is not is refused by its name") {
  BareMeshOptions options;
  options.tissue = "cheese";
  const std::string problem = refusal([&] { scene_of(make_box(Vec3(1, 1, 1), {1, 1, 1}), options); });
  CHECK(problem.find("cheese") != std::string::npos);
}

TEST_CASE("what is given as it would be guessed makes the same scene") {
  const TemporaryFolder folder;
  write_tet_mesh(folder / "body.msh", make_box(Vec3(15, 10, 10), {3, 2, 2}));
  const Scene guessed = scene_around(folder / "body.msh");
  const BareMeshChoices& chosen = *guessed.chosen;
  CHECK(chosen.given == BareMeshOptions());
  const BareMeshOptions options{LengthUnit{chosen.unit, chosen.scale}, chosen.up, chosen.supports};
  const Scene given = scene_around(folder / "body.msh", options);
  CHECK(given.chosen->given == options);
  CHECK(scene_text(given) == scene_text(guessed));
}

TEST_CASE("what was given is in the saved scene") {
  const TemporaryFolder folder;
  write_tet_mesh(folder / "body.msh", make_box(Vec3(15, 10, 10), {3, 2, 2}));
  const BareMeshOptions options{LengthUnit{"millimetres", 0.001}, UpAxis::minus_x, SupportKind::table};
  const Scene given = scene_around(folder / "body.msh", options);
  const Scene read = parse_scene(scene_text(given), folder / "saved.json");
  const auto before = load_setup(given), after = load_setup(read);
  CHECK(before.mesh.nodes == after.mesh.nodes);
  CHECK(after.boundary.empty());
  REQUIRE(after.tables.size() == 1);
  CHECK(after.tables[0].point == before.tables[0].point);
  CHECK(after.tables[0].friction == before.tables[0].friction);
  CHECK_FALSE(read.chosen);
}

}  // namespace heml::bare_mesh_options_test
