#include <doctest/doctest.h>

#include <algorithm>
#include <engine/mesh/files.hpp>
#include <heml/mesh/generate.hpp>
#include <heml/mesh/write.hpp>
#include <heml/scenario/bare_mesh.hpp>
#include <numeric>

namespace heml::bare_mesh_test {

namespace {

Scene scene_of(const TetMesh& mesh, const char* name) {
  const TemporaryFolder folder;
  write_tet_mesh(folder / name, mesh);
  return scene_around(folder / name);  // the mesh has been read
}

/// Largest principal stretch at a node in equilibrium.
double stretch_at_rest(WorldSetup setup) {
  const bool quadratic = setup.solver.quadratic;
  setup.solver = SolverSettings();
  setup.solver.quadratic = quadratic;
  setup.solver.integrator = Integrator::static_equilibrium;
  setup.solver.continuation = true;
  const auto world = make_world(std::move(setup));
  world->load_to(1);
  REQUIRE(!world->halt());
  std::vector<int> nodes(world->setup().mesh.nodes.size());
  std::iota(nodes.begin(), nodes.end(), 0);
  std::vector<float> stretches;
  world->write_field(Field::stretch, nodes, stretches);
  return *std::max_element(stretches.begin(), stretches.end());
}

}  // namespace

TEST_CASE("a trial run comes to the stretch of the body in equilibrium") {
  const Scene scene = scene_of(make_box(Vec3(0.1, 0.12, 0.1), {3, 4, 3}), "block.msh");
  const WorldSetup setup = load_setup(scene);
  CHECK(setup.solver.quadratic);
  CHECK(try_tissue(setup).stretch == doctest::Approx(stretch_at_rest(setup)).epsilon(0.02));  // gravity leans
  CHECK(try_tissue(setup).stretch == scene.chosen->stretch);
}

TEST_CASE("tissue is soft where that holds the body, else as stiff as it takes") {
  const Scene block = scene_of(make_box(Vec3(0.1, 0.1, 0.1), {3, 3, 3}), "block.msh");
  CHECK(block.chosen->young == 1e4);
  const Scene column = scene_of(make_box(Vec3(0.3, 1.5, 0.3), {2, 10, 2}), "column.msh");
  CHECK(column.chosen->young > 1e4);
  for (const Scene* scene : {&block, &column}) {
    CHECK(scene->chosen->stretch <= 1.5);
    CHECK(stretch_at_rest(load_setup(*scene)) <= 1.55);
  }
}

TEST_CASE("a sliver does not decide what a body costs") {
  TetMesh mesh = make_box(Vec3(0.1, 0.1, 0.1), {5, 5, 5});
  const Scene good = scene_of(mesh, "good.msh");
  CHECK(good.solver.integrator == Integrator::verlet);
  const Tet& tet = mesh.tets[200];  // one corner almost in the plane of the others
  const Vec3 middle = (mesh.nodes[tet[0]] + mesh.nodes[tet[1]] + mesh.nodes[tet[2]]) / 3;
  mesh.nodes[tet[3]] += 0.9999 * (middle - mesh.nodes[tet[3]]);
  bool valid = true;
  for (const Tet& t : mesh.tets)
    valid &= signed_volume(mesh.nodes[t[0]], mesh.nodes[t[1]], mesh.nodes[t[2]], mesh.nodes[t[3]]) > 0;
  REQUIRE(valid);
  const Scene bad = scene_of(mesh, "bad.msh");
  CHECK(bad.solver.integrator == Integrator::backward_euler);
  CHECK(bad.solver.rate == 60);
  CHECK(bad.solver.budget->linear > 0);
  CHECK(bad.chosen->load <= 0.7);
}

TEST_CASE("all that was chosen is told") {
  const Scene scene = scene_of(make_box(Vec3(15, 10, 10), {3, 3, 3}), "cm.msh");
  std::vector<std::string> about;
  for (const BareMeshChoices::Text& text : scene.chosen->texts) about.push_back(text.about);
  CHECK(about == std::vector<std::string>{"unit", "up", "supports", "element", "tissue", "method"});
  CHECK(scene.chosen->unit == "centimetres");
  CHECK(scene.chosen->length == doctest::Approx(0.15));
  CHECK(scene.chosen->texts[0].text.find("centimetres") != std::string::npos);
}

}  // namespace heml::bare_mesh_test
