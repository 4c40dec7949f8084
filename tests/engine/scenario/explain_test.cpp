#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <engine/mesh/files.hpp>
#include <engine/scenario/samples.hpp>
#include <heml/mesh/generate.hpp>
#include <heml/mesh/write.hpp>
#include <heml/scenario/explain.hpp>
#include <heml/scenario/measure_features.hpp>

namespace heml::explain_test {
namespace {

Explanation explained(const std::string& patch) { return explain(test::small_scene_with(patch)); }

std::vector<std::string> terms(const Explanation& of) {
  std::vector<std::string> names;
  for (const TermFacts& term : of.materials.at(0).terms) names.push_back(term.name);
  return names;
}

bool leaves_out(const Explanation& of, const std::string& feature) {
  return std::any_of(of.omitted_features.begin(), of.omitted_features.end(),
                     [&](const OmittedFeature& left) { return left.feature == feature; });
}

const Advice* advice_about(const Explanation& of, const std::string& about) {
  const auto found =
      std::find_if(of.advice.begin(), of.advice.end(), [&](const Advice& advice) { return advice.about == about; });
  return found == of.advice.end() ? nullptr : &*found;
}

std::size_t all_bytes(const Explanation& of) {
  std::size_t sum = 0;
  for (const MemoryFacts& memory : of.world.memory) sum += memory.bytes;
  return sum;
}

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("regions are told with name, elements and volume, also those without a material of their own") {
  // A cube of 5 tetrahedra, the one in its middle a third of it.
  const Explanation of = explained(R"({"mesh": {"box": {"size": [0.3, 0.3, 0.3], "cells": [1, 1, 1]}},
    "boundary": [], "regions": [{"tets": [0], "name": "core", "number": 7}]})");
  REQUIRE(of.regions.size() == 2);
  CHECK(of.regions[0].number == 0);
  CHECK(of.regions[0].name.empty());
  CHECK(of.regions[0].tets == 4);
  CHECK(of.regions[0].volume == doctest::Approx(0.018).epsilon(1e-12));
  CHECK(of.regions[1].number == 7);
  CHECK(of.regions[1].name == "core");
  CHECK(of.regions[1].tets == 1);
  CHECK(of.regions[1].volume == doctest::Approx(0.009).epsilon(1e-12));
}

TEST_CASE("an explicit scene is explained: body, kernel, steps, no solver") {
  const Explanation of = explained(R"({"solver": {"threads": 1}})");
  CHECK(of.world.nodes == 12);
  CHECK(of.world.tets == 10);
  CHECK(of.world.live_tets == 10);
  CHECK(of.world.constrained_nodes == 4);
  CHECK(of.world.threads == 1);
  REQUIRE(of.materials.size() == 1);
  CHECK(of.materials[0].kernel.law == "stvk");
  CHECK(of.materials[0].kernel.elements == 10);
  CHECK(of.materials[0].kernel.bytes_per_tet > 7 * 8);  // rest-shape constants
  CHECK(of.materials[0].poisson == doctest::Approx(0.3).epsilon(1e-12));
  CHECK(of.world.method.used == Integrator::verlet);
  CHECK_FALSE(of.world.method.lowest_frequency);
  CHECK_FALSE(of.world.solver);
  CHECK(leaves_out(of, "linear solver"));
  const StepFacts& step = of.world.step;
  CHECK(step.tick == doctest::Approx(0.01));
  CHECK(step.steps_per_tick == static_cast<int>(std::ceil(0.01 / step.stable)));
  CHECK(of.world.method.explicit_share == doctest::Approx(1.25 * of.world.method.step_cost * 10 / step.stable));
  CHECK(of.startup.size() == 3);
}

TEST_CASE("a body too stiff for any number of steps is explained with a great number of them") {
  const Explanation of = explained(R"({"materials": [{"law": "stvk", "young": 1e50, "poisson": 0.3}]})");
  CHECK(of.world.step.steps_per_tick == 1'000'000'000);
}

TEST_CASE("terms of a material are those the scene asks for, and what is no term is left out") {
  const Explanation plain = explained("{}");
  CHECK(terms(plain) == Names{"law"});
  for (const char* feature : {"viscosity", "relaxation", "plasticity", "nodal pressure", "continuation", "springs"})
    CHECK(leaves_out(plain, feature));

  const Explanation rich = explained(R"({"materials": [{"law": "neo_hookean_iso", "K1": 1e3, "kappa": 1e5,
    "viscosity": 1, "relaxation": [{"gamma": 0.3, "tau": 0.1}], "plasticity": {"yield": 1e3, "hardening": 10}}],
    "solver": {"element": "nodal_pressure", "continuation": true}})");
  CHECK(terms(rich) == Names{"law", "nodal_pressure", "viscosity", "relaxation", "plasticity"});
  for (const char* feature : {"viscosity", "relaxation", "plasticity", "nodal pressure", "continuation"})
    CHECK_FALSE(leaves_out(rich, feature));

  const Explanation other = explained(
      R"({"materials": [{"law": "neo_hookean_iso", "K1": 1e3, "kappa": 1e5, "volume_term": "logarithmic"}]})");
  CHECK(terms(other) == Names{"law", "volume_term"});
  CHECK(terms(explained(R"({"materials": [{"law": "mass_spring", "stiffness": 10}]})")) == Names{"springs"});
}

TEST_CASE("of auto the choice is told with the numbers it was made by") {
  const auto with_young = [](const char* young) {
    return explained(
        R"({"mesh": {"box": {"cells": [8, 4, 4]}}, "materials": [{"law": "neo_hookean", "poisson": 0.3, "young": )" +
        std::string(young) + R"(}], "solver": {"integrator": "auto"}})");
  };
  const Explanation soft = with_young("1e4"), stiff = with_young("1e10");
  CHECK(soft.world.method.asked == Integrator::automatic);
  CHECK(soft.world.method.used == Integrator::verlet);
  CHECK(soft.world.method.explicit_share <= soft.world.method.enough);
  CHECK_FALSE(soft.world.solver);
  CHECK(stiff.world.method.explicit_share > stiff.world.method.enough);
  REQUIRE(stiff.world.method.lowest_frequency);
  const bool resolved = stiff.world.step.tick * *stiff.world.method.lowest_frequency < stiff.world.method.resolved;
  CHECK(stiff.world.method.used == (resolved ? Integrator::tr_bdf2 : Integrator::backward_euler));
  CHECK(stiff.world.solver);
  CHECK(leaves_out(stiff, "live stable step"));
}

TEST_CASE("the preconditioner follows the size of the body, or the scene") {
  const auto with_cells = [](const std::string& cells, const std::string& solver) {
    return explained(R"({"mesh": {"box": {"cells": )" + cells + R"(}}, "solver": {)" + solver + "}}")
        .world.solver.value();
  };
  const std::string moving = R"("integrator": "backward_euler")";
  CHECK(with_cells("[4, 4, 4]", moving).preconditioner == Preconditioner::cholesky);
  const SolverFacts middling = with_cells("[8, 8, 8]", moving);
  CHECK(middling.preconditioner == Preconditioner::scalar);
  CHECK(middling.free_nodes == 8 * 81);
  CHECK(middling.by_size);
  const SolverFacts large = with_cells("[12, 9, 9]", moving);
  CHECK(large.preconditioner == Preconditioner::multilevel);
  CHECK(large.levels > 1);
  CHECK(with_cells("[8, 8, 8]", R"("integrator": "static")").preconditioner == Preconditioner::cholesky);
  const SolverFacts asked = with_cells("[4, 4, 4]", moving + R"(, "preconditioner": "scalar")");
  CHECK(asked.preconditioner == Preconditioner::scalar);
  CHECK_FALSE(asked.by_size);
}

TEST_CASE("the element that limits the step is named, with its reason") {
  const TemporaryFolder folder;
  TetMesh mesh = make_box(Vec3(0.1, 0.1, 0.1), {4, 4, 4});
  const auto limit_with = [&](const std::string& materials) {
    write_tet_mesh(folder / "body.msh", mesh);
    return explain(parse_scene(R"({"schema_version": 1, "mesh": {"file": "body.msh"}, "materials": )" + materials + "}",
                               folder / "scene.json"));
  };
  const std::string one = R"([{"law": "stvk", "young": 1e4, "poisson": 0.3}])";
  CHECK(limit_with(one).limit.cause == LimitFacts::Cause::none);

  mesh.regions[37] = 2;
  const std::string two =
      R"([{"law": "stvk", "young": 1e4, "poisson": 0.3}, {"region": 2, "law": "stvk", "young": 1e7, "poisson": 0.3}])";
  const Explanation stiff = limit_with(two);
  CHECK(stiff.limit.cause == LimitFacts::Cause::stiff);
  CHECK(stiff.limit.element == 37);
  CHECK(stiff.limit.wave_speed == doctest::Approx(std::sqrt(1000.0) * stiff.limit.median_wave_speed));

  // Move one corner of an element nearly into the opposite face.
  mesh.regions[37] = 0;
  const Tet tet = mesh.tets[0];
  const Vec3 centre = (mesh.nodes[tet[1]] + mesh.nodes[tet[2]] + mesh.nodes[tet[3]]) / 3;
  mesh.nodes[tet[0]] += 0.98 * (centre - mesh.nodes[tet[0]]);
  const Explanation sliver = limit_with(one);
  CHECK(sliver.limit.cause == LimitFacts::Cause::sliver);
  CHECK(sliver.limit.element == 0);
  CHECK(sliver.limit.height < 0.05 * sliver.limit.median_height);
  CHECK(sliver.limit.dihedral == doctest::Approx(sliver.quality.worst_dihedral));
  CHECK(advice_about(sliver, "sliver"));
  CHECK(advice_about(sliver, "limiting_element"));
}

TEST_CASE("memory grows with the body, shrinks in float, and counts the factor") {
  const auto bytes = [](const std::string& cells, const std::string& solver) {
    return static_cast<double>(
        all_bytes(explained(R"({"mesh": {"box": {"cells": )" + cells + R"(}}, "solver": {)" + solver + "}}")));
  };
  const double small = bytes("[8, 4, 4]", ""), large = bytes("[16, 4, 4]", "");
  CHECK(large / small == doctest::Approx(2).epsilon(0.1));
  CHECK(bytes("[8, 4, 4]", R"("precision": "float")") < 0.9 * small);
  // Every element has at least 4 node numbers, 7 constants and 12 components of corner forces.
  CHECK(small > 8 * 4 * 4 * 5 * (4 * 4 + 7 * 8 + 12 * 8));
  const Explanation implicit =
      explained(R"({"mesh": {"box": {"cells": [8, 4, 4]}}, "solver": {"integrator": "static"}})");
  const auto& memory = implicit.world.memory;
  const auto factors = std::find_if(memory.begin(), memory.end(),
                                    [](const MemoryFacts& facts) { return std::string(facts.what) == "factors"; });
  REQUIRE(factors != memory.end());
  CHECK(factors->bytes > implicit.world.solver->free_nodes * 6 * 8);  // at least the diagonal blocks
}

TEST_CASE("locking is warned of, with a remedy the law allows, and not where nodal pressure is on") {
  const auto advice = [](const std::string& material, const std::string& element) {
    const Explanation of =
        explained(R"({"materials": [)" + material + R"(], "solver": {"element": ")" + element + "\"}}");
    const Advice* locking = advice_about(of, "locking");
    return locking ? locking->remedy : "";
  };
  CHECK(advice(R"({"law": "neo_hookean", "young": 1e4, "poisson": 0.44})", "p1").empty());
  CHECK(says(advice(R"({"law": "neo_hookean", "young": 1e4, "poisson": 0.46})", "p1"), "neo_hookean_iso"));
  const std::string split = R"({"law": "neo_hookean_iso", "K1": 1e3, "kappa": 1e5})";
  CHECK(says(advice(split, "p1"), "nodal_pressure"));
  CHECK(advice(split, "nodal_pressure").empty());
  CHECK(says(advice(split, "p2"), "p2_pressure"));
  CHECK(advice(split, "p2_pressure").empty());
  CHECK(advice(R"({"law": "neo_hookean", "young": 1e4, "poisson": 0.46})", "p2").empty());
}

TEST_CASE("a step that is too long, an implicit method without need and a slow explicit one are pointed out") {
  CHECK(advice_about(explained(R"({"solver": {"rate": null, "step": 0.1}})"), "step"));
  CHECK(advice_about(explained(R"({"solver": {"integrator": "backward_euler"}})"), "implicit"));
  const Explanation slow = explained(
      R"({"mesh": {"box": {"cells": [8, 8, 8]}}, "materials": [{"law": "stvk", "young": 1e10, "poisson": 0.3}]})");
  CHECK(advice_about(slow, "real_time"));
  CHECK_FALSE(advice_about(slow, "step"));
  const Explanation fine = explained("{}");
  for (const char* about : {"step", "implicit", "real_time", "locking", "sliver", "limiting_element"})
    CHECK_FALSE(advice_about(fine, about));
}

TEST_CASE("reading a world's facts changes no later bit") {
  for (const char* integrator : {"verlet", "backward_euler", "tr_bdf2", "auto", "static"}) {
    CAPTURE(integrator);
    const Scene scene = test::small_scene_with(R"({"gravity": [0, -9.81, 0], "mesh": {"box": {"cells": [4, 2, 2]}},
      "solver": {"integrator": ")" + std::string(integrator) +
                                               "\"}}");
    const auto asked = load_world(scene), silent = load_world(scene);
    asked->facts();
    for (int k = 0; k < 3; ++k) {
      asked->tick();
      silent->tick();
      asked->facts();
    }
    CHECK(asked->state_hash() == silent->state_hash());
  }
}

TEST_CASE("what is switched off by name gives the bits of a scene that does not speak of it") {
  const auto hash = [](const std::string& patch) {
    const auto world = load_world(test::small_scene_with(patch));
    world->apply(Grasp{11, 0});
    world->apply(MoveTool{Vec3(0.22, 0.12, 0.1)});
    for (int k = 0; k < 10; ++k) world->tick();
    return world->state_hash();
  };
  const std::string law = R"("law": "neo_hookean_iso", "K1": 1e3, "kappa": 1e4)";
  const std::uint64_t silent = hash(R"({"materials": [{)" + law + "}]}");
  CHECK(hash(R"({"materials": [{)" + law + R"(, "viscosity": 0, "bulk_viscosity": 0, "relaxation": [], "volume_term":
    "quadratic"}], "gravity": [0, 0, 0], "loads": [], "solver": {"damping": 0, "element": "p1", "continuation": false,
    "precision": "double"}})") == silent);
  CHECK(hash(R"({"materials": [{)" + law + R"(, "viscosity": 1}]})") != silent);
}

TEST_CASE("features are measured beside the scene as it is") {
  const Scene scene = test::small_scene_with(R"({"gravity": [0, -9.81, 0],
    "materials": [{"law": "neo_hookean_iso", "K1": 1e3, "kappa": 1e4, "viscosity": 5}], "solver": {"duration": 0.05}})");
  const Measurement measured = measure_features(scene, load_setup(scene));
  REQUIRE(!measured.changes.empty());
  CHECK(measured.changes[0].feature == "as it is");
  CHECK(measured.changes[0].error == 0);
  CHECK(measured.max_motion > 1e-4);
  CHECK(measured.stretch == doctest::Approx(0.05));
  const auto error = [&](const std::string& feature) {
    const auto found = std::find_if(measured.changes.begin(), measured.changes.end(),
                                    [&](const MeasuredChange& change) { return change.feature == feature; });
    return found == measured.changes.end() ? -1 : found->error;
  };
  CHECK(error("viscosity") > 1e-6);
  CHECK(error("element") > 1e-6);
  CHECK(error("precision") > 0);
  CHECK(error("precision") < 1e-5);
  CHECK(error("watch of stretches") == 0);
  CHECK(error("relaxation") == -1);  // the scene has none
  for (const MeasuredChange& change : measured.changes) CHECK(change.milliseconds > 0);
}

TEST_CASE("tools are told: what stands in the scene, and what the script takes up, how often and when") {
  const Explanation of = explained(R"({
    "solver": {"rate": 100}, "tearing": {"stretch": 3}, "self_contact": {"friction": 0.25},
    "tables": [{"point": [0, -1, 0], "normal": [0, 1, 0], "friction": 0.5}],
    "events": [{"at": 0.1, "grasp": {"node": 3, "radius": 0}}, {"at": 0.2, "move": [0, 0, 0]},
               {"at": 0.5, "release": true}, {"at": 0.6, "grasp": {"node": 4, "radius": 0}},
               {"at": 0.7, "pin": {"node": 3, "radius": 0}}, {"at": 0.8, "damping": 2}]})");
  const auto tool = [&](const std::string& name) {
    const auto found = std::find_if(of.tools.begin(), of.tools.end(), [&](const auto& t) { return t.name == name; });
    REQUIRE_MESSAGE(found != of.tools.end(), name);
    return *found;
  };
  CHECK(of.tools.size() == 5);
  CHECK(tool("grasp").times == 2);
  CHECK(*tool("grasp").first == doctest::Approx(0.1));
  CHECK(*tool("grasp").last == doctest::Approx(0.6));
  CHECK(tool("pin").times == 1);
  CHECK_FALSE(tool("table").first);
  CHECK(tool("table").detail.find("0.5") != std::string::npos);
  CHECK(tool("self-contact").detail.find("0.25") != std::string::npos);
  CHECK(tool("tearing").detail.find("3") != std::string::npos);
  CHECK(explained("{}").tools.empty());
}

TEST_CASE("a body without support is told of, unless a table lies below it") {
  const auto falls = [](const std::string& tables) {
    return advice_about(explained(R"({"boundary": [], "gravity": [0, -9.81, 0], "tables": [)" + tables + "]}"),
                        "free_fall") != nullptr;
  };
  CHECK(falls(""));
  CHECK_FALSE(falls(R"({"point": [0, -1, 0], "normal": [0, 1, 0]})"));
  CHECK(falls(R"({"point": [0, 1, 0], "normal": [0, -1, 0]})"));
}

}  // namespace heml::explain_test
