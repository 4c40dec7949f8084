#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <engine/mesh/files.hpp>
#include <engine/scenario/samples.hpp>
#include <heml/mesh/generate.hpp>
#include <heml/mesh/read.hpp>
#include <heml/mesh/write.hpp>
#include <heml/scenario/adapt.hpp>
#include <heml/scenario/load_mesh.hpp>
#include <heml/scenario/recorder.hpp>
#include <heml/scenario/replay.hpp>
#include <heml/scenario/text_file.hpp>
#include <heml/world/finer_setup.hpp>

namespace heml::adapt_test {
namespace {

/// A bar fixed at x = 0 by node numbers, sagging and pulled at its other end.
Scene sagging(const std::string& patch = "{}") {
  Json scene = Json::parse(test::scene_with(R"({
    "mesh": {"box": {"size": [0.2, 0.05, 0.05], "cells": [4, 1, 1]}},
    "gravity": [0, -1, 0],
    "loads": [{"box": [[0.2, -1, -1], [0.2, 1, 1]], "traction": [10, 0, 0]}]})"));
  scene["boundary"] = Json::parse(R"([{"nodes": [0, 5, 10, 15], "fix": true}])");
  scene.merge_patch(Json::parse(patch));
  return parse_scene(scene.dump(), "folder/scene.json");
}

std::string refused(const Scene& scene, const std::optional<double>& time = {}) {
  return refusal([&] { adapt(scene, load_setup(scene), RefineGoal{0.3, 500}, time); });
}

/// At equilibrium: Π, and the estimate of a body of linear elements.
struct Equilibrium {
  double potential;
  std::optional<ErrorEstimate> estimate;
};

/// A body held at x = 0 and moved at its other end.
Equilibrium equilibrium(const char* box, const char* end, double poisson, const char* gravity, const char* element) {
  Json scene = Json::parse(fmt::format(R"({{"schema_version": 1, "mesh": {{"box": {}}}, "gravity": {},
    "materials": [{{"law": "neo_hookean", "young": 1e4, "poisson": {}, "density": 1000}}],
    "boundary": [{{"box": [[-1e-6, -1, -1], [1e-6, 1, 1]], "fix": true}}],
    "solver": {{"integrator": "static", "element": "{}"}}}})",
                                       box, gravity, poisson, element));
  if (*end) scene["boundary"].push_back(Json::parse(end));
  const auto world = load_world(parse_scene(scene.dump(), "folder/scene.json"));
  world->load_to(1);
  REQUIRE_FALSE(world->halt());
  const Energies energies = world->energies();
  return {energies.elastic + energies.potential, world->error_estimate()};
}

}  // namespace

TEST_CASE("the estimate is 0.9 to 1.3 of what a body of linear elements errs by, bent, pressed, sheared and twisted") {
  struct Case {
    std::string name;
    const char *box, *end;
    double poisson;
    const char* gravity;
  };
  const char *cube = R"({"size": [0.1, 0.1, 0.1], "cells": [6, 6, 6]})", *none = "[0, 0, 0]";
  const char* shorter = R"({"box": [[0.0999, -1, -1], [0.1001, 1, 1]], "translate": [-0.02, 0, 0]})";
  for (const Case& c :
       {Case{"bent", R"({"size": [0.2, 0.05, 0.05], "cells": [16, 4, 4]})", "", 0.3, "[0, -2, 0]"},
        Case{"pressed", cube, shorter, 0.3, none}, Case{"pressed, nearly incompressible", cube, shorter, 0.45, none},
        Case{"sheared", cube, R"({"box": [[0.0999, -1, -1], [0.1001, 1, 1]], "translate": [0, 0.03, 0]})", 0.3, none},
        Case{"stretched", cube, R"({"box": [[0.0999, -1, -1], [0.1001, 1, 1]], "translate": [0.03, 0, 0]})", 0.3, none},
        Case{"twisted", R"({"size": [0.15, 0.05, 0.05], "cells": [12, 4, 4]})",
             R"({"box": [[0.1499, -1, -1], [0.1501, 1, 1]],
                 "rotate": {"axis": [1, 0, 0], "origin": [0, 0.025, 0.025], "degrees": 60}})",
             0.3, none}}) {
    CAPTURE(c.name);
    const Equilibrium linear = equilibrium(c.box, c.end, c.poisson, c.gravity, "p1"),
                      quadratic = equilibrium(c.box, c.end, c.poisson, c.gravity, "p2");
    REQUIRE(linear.estimate);
    // ‖u − u_h‖² = 2 (Π_h − Π), Π of quadratic elements: their own error makes it at most a tenth too small
    // (against extrapolated meshes).
    const double effectivity = std::sqrt(linear.estimate->squared / (2 * (linear.potential - quadratic.potential)));
    CAPTURE(effectivity);
    CHECK(effectivity > 0.9);
    CHECK(effectivity < 1.3);
  }
}

TEST_CASE("a mesh is refined until its estimate is as asked for, and the error falls with every mesh") {
  const Scene scene = sagging();
  std::size_t told = 0;
  std::vector<std::size_t> begun;
  const auto tell = [&](const AdaptedMesh& mesh) {
    ++told;
    CHECK(begun.size() == told);
    CHECK(begun.back() == mesh.tets);
    CHECK(mesh.error > 0);
  };
  const Adaptation adapted = adapt(scene, load_setup(scene), RefineGoal{0.4, 5000}, {},
                                   {tell, [&](std::size_t tets) { begun.push_back(tets); }});
  CHECK(adapted.reached);
  CHECK_FALSE(adapted.stagnated);
  CHECK(why_not_reached(adapted, {0.4, 5000}).empty());
  REQUIRE(adapted.meshes.size() > 3);
  CHECK(told == adapted.meshes.size());
  for (std::size_t k = 1; k < adapted.meshes.size(); ++k) {
    CHECK(adapted.meshes[k].tets > adapted.meshes[k - 1].tets);
    CHECK(adapted.meshes[k].potential < adapted.meshes[k - 1].potential);  // nested spaces: Π decreases
  }
  CHECK(adapted.meshes.back().error <= 0.4);
  CHECK(adapted.meshes[adapted.meshes.size() - 2].error > 0.4);
  CHECK(adapted.meshes.back().tets == adapted.setup.mesh.tets.size());
}

TEST_CASE("a mesh of quadratic elements is refined likewise, and supports and loads hold the middles between their nodes") {
  for (const char* element : {"p2", "p2_pressure"}) {
    CAPTURE(element);
    const Scene scene = sagging(R"({"materials": [{"law": "neo_hookean_iso", "K1": 2e3, "kappa": 4e3}],
                                    "solver": {"element": ")" + std::string(element) + "\"}}");
    const Adaptation adapted = adapt(scene, load_setup(scene), RefineGoal{0.12, 5000}, {});
    CHECK(adapted.reached);
    REQUIRE(adapted.meshes.size() > 2);
    for (std::size_t k = 1; k < adapted.meshes.size(); ++k) {
      CHECK(adapted.meshes[k].tets > adapted.meshes[k - 1].tets);
      CHECK(adapted.meshes[k].potential < adapted.meshes[k - 1].potential);  // nested spaces: Π decreases
      CHECK(adapted.meshes[k].nodes > adapted.meshes[k].tets);
    }
    const WorldSetup& setup = adapted.setup;
    REQUIRE(setup.midedges.size() == setup.mesh.tets.size());
    CHECK(has_straight_edges(setup));
    const auto at_x = [&](double x) {
      return std::count_if(setup.mesh.nodes.begin(), setup.mesh.nodes.end(), [x](const Vec3& X) { return X.x() == x; });
    };
    CHECK(std::ssize(setup.boundary[0].nodes) == at_x(0));
    CHECK(std::ssize(setup.loads[0].nodes) == at_x(0.2));
    const AdaptedScene written = adapted_scene(scene, adapted, "finer.msh");
    CHECK(written.mesh.nodes.size() == setup.mesh.nodes.size() - count_nodes(setup.midedges));
    for (const int n : written.scene.boundary[0].where.nodes)
      CHECK(static_cast<std::size_t>(n) < written.mesh.nodes.size());
    const int limit = static_cast<int>(setup.mesh.tets.size()) - 1;
    const Adaptation limited = adapt(scene, load_setup(scene), RefineGoal{0.01, limit}, {});
    CHECK(!limited.reached);
    CHECK(limited.setup.midedges.size() == limited.setup.mesh.tets.size());
  }
}

TEST_CASE("a mesh of curved elements is not refined, and the message names what to do") {
  const Scene scene = sagging(R"({"solver": {"element": "p2"}})");
  WorldSetup setup = load_setup(scene);
  setup.mesh.nodes.back() += Vec3(1e-3, 0, 0);
  const std::string said = refusal([&] { adapt(scene, setup, RefineGoal{0.3, 500}, {}); });
  CHECK(says(said, "mesh.refine: divides straight edges"));
  CHECK(says(said, "four-node tetrahedra"));
}

TEST_CASE("no more tetrahedra are made than are allowed, and that is told") {
  const Scene scene = sagging();
  const Adaptation adapted = adapt(scene, load_setup(scene), RefineGoal{0.01, 300}, {});
  CHECK(!adapted.reached);
  CHECK_FALSE(adapted.stagnated);
  CHECK(says(why_not_reached(adapted, {0.01, 300}), "1 % would need more than 300 tetrahedra"));
  CHECK(adapted.setup.mesh.tets.size() <= 300);
  CHECK(adapted.setup.mesh.tets.size() > 100);
}

TEST_CASE("refinement about a body's only node of support ends, since its error does not fall, and that is told") {
  const Scene scene = sagging(R"({"boundary": [{"nodes": [0], "fix": true}], "loads": []})");
  const Adaptation adapted = adapt(scene, load_setup(scene), RefineGoal{0.1, 50000}, {});
  CHECK(!adapted.reached);
  CHECK(adapted.stagnated);
  CHECK(adapted.meshes.size() < 25);
  CHECK(says(why_not_reached(adapted, {0.1, 50000}), {"the error has hardly fallen", "single nodes"}));
}

TEST_CASE("a finer mesh constrains the midpoints between constrained nodes") {
  const Scene scene = sagging();
  const Adaptation adapted = adapt(scene, load_setup(scene), RefineGoal{0.4, 5000}, {});
  const std::vector<int>& constrained = adapted.setup.boundary[0].nodes;
  const std::vector<Vec3>& nodes = adapted.setup.mesh.nodes;
  const auto at_the_wall = std::count_if(nodes.begin(), nodes.end(), [](const Vec3& x) { return x.x() == 0; });
  CHECK(at_the_wall > 4);
  CHECK(static_cast<std::ptrdiff_t>(constrained.size()) == at_the_wall);
  for (const int n : constrained) CHECK(nodes[static_cast<std::size_t>(n)].x() == 0);
}

TEST_CASE("a scene that asks for it is refined as it is loaded, and written and read back asks the same") {
  const Scene scene = sagging(R"({"mesh": {"refine": {"error": 0.4, "tets": 5000}}})");
  const WorldSetup setup = load_setup(scene);
  CHECK(setup.mesh.tets.size() > 3 * 20);
  const Scene again = parse_scene(scene_text(scene), "folder/scene.json");
  REQUIRE(again.mesh.refine);
  CHECK(again.mesh.refine->error == 0.4);
  CHECK(again.mesh.refine->tets == 5000);
  CHECK(says(refusal([] { sagging(R"({"mesh": {"refine": {"error": 2}}})"); }), "mesh.refine.error: is 2"));
  CHECK(says(refusal([] { sagging(R"({"mesh": {"refine": {"at": 2}}})"); }), "mesh.refine.at: unknown key"));
}

TEST_CASE("a recorded session on a refined mesh replays to the bit, though it removes elements by their new numbers") {
  const TemporaryFolder folder;
  const Scene scene = sagging(R"({"mesh": {"refine": {"error": 0.4, "tets": 5000}}})");
  {
    const auto world = load_world(scene);
    Recorder recorder(folder / "session.jsonl", scene, *world, 2);
    const Command removal = RemoveElements{{{100}, {}, {}, {}}};
    REQUIRE(world->apply(removal).ok());
    recorder.command(*world, removal);
    for (int k = 0; k < 4; ++k) {
      world->tick();
      recorder.ticked(*world);
    }
    recorder.end(*world);
  }
  const Scene recording = read_scene(folder / "session.jsonl");
  const auto world = load_world(recording);
  CHECK(!replay(recording, *world).difference);
}

TEST_CASE("the refined scene, written with its mesh and fields, moves as the refined world does") {
  const TemporaryFolder folder;
  TetMesh mesh = make_box(Vec3(0.2, 0.05, 0.05), {4, 1, 1});
  mesh.fields = {{"other", 1, std::vector<double>(20, 7)}, {"E", 1, {}}};
  for (int t = 0; t < 20; ++t) mesh.fields[1].values.push_back(1e4 + 100 * t);
  write_tet_mesh(folder / "bar.vtu", mesh);
  Json text = Json::parse(scene_text(sagging()));
  text["mesh"] = {{"file", "bar.vtu"}, {"translate", {0.1, 0, 0}}};
  text["materials"] = Json::parse(R"([{"law": "stvk", "young": {"field": "E"}, "poisson": 0.3}])");
  text["loads"] = Json::array();
  const Scene scene = parse_scene(text.dump(), folder / "scene.json");

  const Adaptation adapted = adapt(scene, load_setup(scene), RefineGoal{0.4, 400}, 0.05);
  const AdaptedScene written = adapted_scene(scene, adapted, folder / "fine.vtu");
  write_tet_mesh(folder / "fine.vtu", written.mesh);
  const Scene read = parse_scene(scene_text(written.scene), folder / "fine.json");
  CHECK(written.mesh.fields.size() == 2);
  const auto fine = load_world(read), direct = make_world(adapted.setup);
  CHECK(mesh_fingerprint(fine->setup().mesh) == mesh_fingerprint(direct->setup().mesh));
  for (int k = 0; k < 5; ++k) fine->tick(), direct->tick();
  CHECK(fine->state_hash() == direct->state_hash());
}

TEST_CASE("a scene that refines its mesh, written with that mesh, has its numbers, regions and motion") {
  const TemporaryFolder folder;
  const Scene scene = sagging(R"({"mesh": {"refine": {"error": 0.4, "tets": 5000}},
    "regions": [{"tets": [3, 4, 5], "name": "hard", "number": 1}],
    "materials": [{"law": "neo_hookean", "young": 1e4, "poisson": 0.3},
                  {"region": 1, "law": "stvk", "young": 5e4, "poisson": 0.3}]})");
  const AdaptedScene written = refined_scene(scene, folder / "fine.vtu");
  write_tet_mesh(folder / "fine.vtu", written.mesh);
  const auto fine = load_world(parse_scene(scene_text(written.scene), folder / "fine.json"));
  const auto direct = load_world(scene);
  CHECK(mesh_fingerprint(fine->setup().mesh) == mesh_fingerprint(direct->setup().mesh));
  CHECK(fine->setup().mesh.regions == direct->setup().mesh.regions);
  CHECK(fine->setup().mesh.region_names == direct->setup().mesh.region_names);
  CHECK(fine->setup().boundary[0].nodes == direct->setup().boundary[0].nodes);
  for (int k = 0; k < 5; ++k) fine->tick(), direct->tick();
  CHECK(fine->state_hash() == direct->state_hash());
}

TEST_CASE("what cannot be refined is refused with what would do") {
  CHECK(says(refused(sagging(R"({"gravity": [0, 0, 0], "loads": []})")), "nothing deforms the body"));
  CHECK(says(refused(sagging(R"({"gravity": [0, 0, 0], "loads": []})")), "heml refine SCENE --at SECONDS"));
  CHECK(says(refused(sagging(), 5), "ends at 0.1 s"));
  Scene springs = sagging();
  springs.materials[0].material = Material();
  springs.materials[0].material.law = "mass_spring";
  springs.materials[0].material.parameters = {1000};
  CHECK(says(refused(springs), "springs have no stress"));
  Scene removing = sagging();
  removing.events.push_back({1, RemoveElements{{{3}, {}, {}, {}}}});
  CHECK(says(refusal([&] {
                     adapted_scene(removing, adapt(removing, load_setup(removing), RefineGoal{0.9, 500}, {}), "m.vtu");
                   }),
                   "step 1 removes tetrahedra by numbers"));
  Scene tagging = sagging();
  tagging.events.push_back({2, TagRegion{{{}, {{3}, {}, {}, {}}, "hard", {}}, {}}});
  CHECK(says(refusal([&] {
                     adapted_scene(tagging, adapt(tagging, load_setup(tagging), RefineGoal{0.9, 500}, {}), "m.vtu");
                   }),
                   "step 2 tags tetrahedra by numbers"));
}

TEST_CASE("events of a scene that refines its mesh keep their numbers, which are of that mesh") {
  Scene scene = sagging(R"({"mesh": {"refine": {"error": 0.9, "tets": 500}}})");
  scene.events.push_back({1, RemoveElements{{{3}, {}, {}, {}}}});
  const AdaptedScene written = refined_scene(scene, "m.vtu");
  REQUIRE(written.scene.events.size() == 1);
  CHECK(std::get<RemoveElements>(written.scene.events[0].command).which.tets == std::vector<int>{3});
}

}  // namespace heml::adapt_test
