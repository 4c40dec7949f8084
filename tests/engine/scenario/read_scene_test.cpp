#include <doctest/doctest.h>

#include <cmath>
#include <engine/mesh/files.hpp>
#include <engine/scenario/samples.hpp>
#include <heml/scenario/scene.hpp>

namespace heml::read_scene_test {

TEST_CASE("reads a scene with every key of the format") {
  const Scene scene = parse_scene(R"({
    "schema_version": 1, "name": "cantilever", "title": "A beam", "description": "Bends.",
    "mesh": {"file": "box.msh", "scale": 0.001, "rotate": {"axis": [0, 0, 2], "origin": [1, 0, 0], "degrees": 90},
             "translate": [0, 0.5, 0]},
    "materials": [
      {"law": "neo_hookean", "young": 1.0e4, "poisson": 0.45, "density": 1100.0},
      {"region": 2, "law": "stvk", "lambda": 3e4, "mu": 2e4}
    ],
    "boundary": [
      {"nodes": [0, 4, 7], "fix": true},
      {"box": [[0.099, -1, -1], [0.101, 1, 1]], "translate": [0.05, 0, 0],
       "rotate": {"axis": [3, 0, 0], "origin": [0, 0.1, 0], "degrees": 45}, "over": 1.5},
      {"nodes": [1], "fix": true, "axes": "zx"}
    ],
    "loads": [
      {"box": [[0.099, -1, -1], [0.101, 1, 1]], "traction": [0, -20, 0]},
      {"sphere": [[0, 0, 0], 0.02], "pressure": 7, "over": 2},
      {"nodes": [3], "force": [0, 0, 1]}
    ],
    "gravity": [0, -9.81, 0],
    "solver": {"integrator": "symplectic_euler", "step": 1e-4, "duration": 0.5, "damping": 2, "precision": "float",
               "threads": 2, "element": "p1", "continuation": true, "tolerance": 1e-10,
               "budget": {"iterations": 2}},
    "outputs": {"times": [0.1, 0.05], "positions": false, "vtu": true},
    "initial": {"velocity": [1, 0, 0], "positions": "start.csv"},
    "view": {"azimuth": 30, "elevation": -20, "zoom": 1.5, "field": "J", "wireframe": true}
  })",
                                  "folder/scene.json");
  CHECK(scene.name == "cantilever");
  CHECK(scene.mesh.file == "folder/box.msh");
  CHECK(scene.mesh.scale == 0.001);
  CHECK(scene.mesh.rotate_axis == Vec3(0, 0, 1));
  CHECK(scene.mesh.rotate_origin == Vec3(1, 0, 0));
  CHECK(scene.mesh.rotate_degrees == 90);
  CHECK(scene.mesh.translate == Vec3(0, 0.5, 0));
  REQUIRE(scene.materials.size() == 2);
  CHECK(!scene.materials[0].region);
  CHECK(scene.materials[0].material.density == 1100);
  CHECK(scene.materials[0].material.parameters[0] == doctest::Approx(1e4 * 0.45 / (1.45 * 0.1)).epsilon(1e-12));
  CHECK(scene.materials[0].material.parameters[1] == doctest::Approx(1e4 / 2.9).epsilon(1e-12));
  CHECK(scene.materials[1].region == 2);
  CHECK(scene.materials[1].material.density == 1000);
  CHECK(scene.materials[1].material.parameters == std::vector<double>{3e4, 2e4});
  REQUIRE(scene.boundary.size() == 3);
  CHECK(scene.boundary[2].motion.axes == AxisSet{{true, false, true}});
  CHECK(scene.boundary[0].where.nodes == std::vector<int>{0, 4, 7});
  CHECK(scene.boundary[1].motion.translate == Vec3(0.05, 0, 0));
  CHECK(scene.boundary[1].motion.axis == Vec3(1, 0, 0));
  CHECK(scene.boundary[1].motion.origin == Vec3(0, 0.1, 0));
  CHECK(scene.boundary[1].motion.degrees == 45);
  CHECK(scene.boundary[1].motion.ramp_time == 1.5);
  REQUIRE(scene.loads.size() == 3);
  CHECK(scene.loads[0].load.kind == Load::Kind::traction);
  CHECK(scene.loads[0].load.vector == Vec3(0, -20, 0));
  CHECK(scene.loads[1].load.kind == Load::Kind::pressure);
  CHECK(scene.loads[1].load.pressure == 7);
  CHECK(scene.loads[1].where.sphere->second == 0.02);
  CHECK(scene.loads[1].load.ramp_time == 2);
  CHECK(scene.loads[2].load.kind == Load::Kind::force);
  CHECK(scene.gravity == Vec3(0, -9.81, 0));
  CHECK(scene.solver.integrator == Integrator::symplectic_euler);
  CHECK(scene.solver.step == 1e-4);
  CHECK(scene.solver.duration == 0.5);
  CHECK(scene.solver.damping == 2);
  CHECK(scene.solver.budget.value().iterations == 2);
  CHECK(scene.solver.single_precision);
  CHECK(scene.solver.threads == 2);
  CHECK(scene.solver.continuation);
  CHECK(scene.output_times == std::vector<double>{0.1, 0.05});
  CHECK(!scene.output_positions);
  CHECK(scene.output_vtu);
  CHECK(scene.initial_velocity == Vec3(1, 0, 0));
  CHECK(scene.initial_positions == "folder/start.csv");
  CHECK(scene.view.azimuth == 30);
  CHECK(scene.view.field == Field::volume_ratio);
  CHECK(scene.view.wireframe);
}

TEST_CASE("a view has a side in place of two angles, hidden regions, and a range of colours") {
  const auto read = [](const std::string& view) {
    return parse_scene(R"({"schema_version": 1, "mesh": {"file": "/meshes/a.msh"},
                           "materials": [{"law": "stvk", "young": 1, "poisson": 0}], "view": )" + view + "}",
                       "scene.json");
  };
  const Scene scene = read(R"({"side": "left", "orthographic": true})");
  CHECK(scene.view.azimuth == -90);
  CHECK(scene.view.elevation == 0);
  CHECK(scene.view.orthographic);
  CHECK_FALSE(read("{}").view.orthographic);
  const View inside = read(R"({"hidden": [5, 1, 5], "range": [-2, 3.5]})").view;
  CHECK(inside.hidden == std::vector<int>{1, 5});
  CHECK(inside.range == std::array<double, 2>{-2, 3.5});
  CHECK_THROWS_WITH_AS(read(R"({"range": [3, 3]})"), doctest::Contains("range"), InputError);
  CHECK_THROWS_WITH_AS(read(R"({"hidden": [0.5]})"), doctest::Contains("hidden"), InputError);
  CHECK_THROWS_WITH_AS(read(R"({"side": "left", "azimuth": 3})"), doctest::Contains("azimuth"), InputError);
}

TEST_CASE("gives what a scene leaves out its documented default") {
  const Scene scene = parse_scene(
      R"({"schema_version": 1, "mesh": {"file": "/meshes/a.msh"},
          "materials": [{"law": "stvk", "young": 1, "poisson": 0}]})",
      "scene.json");
  CHECK(scene.mesh.file == "/meshes/a.msh");
  CHECK(scene.materials[0].material.density == 1000);
  CHECK(scene.materials[0].material.parameters == std::vector<double>{0, 0.5});
  CHECK(scene.gravity == Vec3::Zero());
  CHECK(scene.solver.integrator == Integrator::verlet);
  CHECK(!scene.solver.step);
  CHECK(scene.solver.tick() == 1e-3);
  CHECK(scene.solver.duration == 1);
  CHECK(scene.solver.damping == 0);
  CHECK(!scene.solver.single_precision);
  CHECK(!scene.solver.continuation);
  CHECK(scene.output_positions);
  CHECK(!scene.output_vtu);
  CHECK(!scene.recorded_ticks);
}

TEST_CASE("reads every kind of event, in ascending order of ticks, equal ticks as listed") {
  const Scene scene = test::small_scene_with(R"({"events": [
    {"step": 9, "reset": true},
    {"step": 1, "grasp": {"node": 3, "radius": 0.01}},
    {"at": 0.02, "move": [1, 2, 3]},
    {"step": 2, "release": true},
    {"step": 3, "material": {"region": 5, "law": "neo_hookean", "lambda": 2, "mu": 1, "density": 3}},
    {"at": 0.0449, "damping": 2},
    {"step": 5, "gravity": [0, -1, 0]},
    {"step": 6, "integrator": "symplectic_euler"},
    {"step": 7, "grasp": {"point": [0.2, 0.1, 0]}}
  ]})");
  REQUIRE(scene.events.size() == 9);
  const std::vector<long> ticks = {1, 2, 2, 3, 4, 5, 6, 7, 9};
  for (std::size_t i = 0; i < ticks.size(); ++i) CHECK(scene.events[i].tick == ticks[i]);
  CHECK(std::get<Grasp>(scene.events[0].command).node == 3);
  CHECK(std::get<Grasp>(scene.events[0].command).radius == 0.01);
  CHECK(std::get<MoveTool>(scene.events[1].command).target == Vec3(1, 2, 3));
  CHECK(std::holds_alternative<Release>(scene.events[2].command));
  CHECK(std::get<SetMaterial>(scene.events[3].command).region == 5);
  CHECK(std::get<SetMaterial>(scene.events[3].command).material.parameters == std::vector<double>{2, 1});
  CHECK(std::get<SetDamping>(scene.events[4].command).damping == 2);
  CHECK(std::get<SetGravity>(scene.events[5].command).gravity == Vec3(0, -1, 0));
  CHECK(std::get<SetIntegrator>(scene.events[6].command).integrator == Integrator::symplectic_euler);
  REQUIRE(scene.points.size() == 1);
  CHECK(scene.points.at(7).front() == Vec3(0.2, 0.1, 0));
  CHECK(std::holds_alternative<Reset>(scene.events[8].command));
}

TEST_CASE("reads the document and the JSON Lines form of a recording as the same") {
  const std::string entries[] = {R"({"step": 0, "checkpoint": "00000000000000ff", "nodes": "00ffabcd"})",
                                 R"({"step": 4, "move": [0.1, 0, 0]})",
                                 R"({"step": 9, "checkpoint": "0123456789ABCDEF"})", R"({"step": 10, "end": true})"};
  const std::string checkpoints = entries[0] + "," + entries[2] + "," + entries[3];
  const std::string document =
      test::scene_with("{\"events\": [" + entries[1] + "], \"checkpoints\": [" + checkpoints + "]}");
  std::string lines = test::scene_with("{}") + "\n\n";
  for (const std::string& entry : entries) lines += entry + "\r\n";
  for (const std::string& text : {document, lines}) {
    const Scene scene = parse_scene(text, "recording");
    REQUIRE(scene.checkpoints.size() == 2);
    CHECK(scene.checkpoints[0].hash == 255);
    CHECK(scene.checkpoints[0].nodes == std::vector<std::uint16_t>{0x00ff, 0xabcd});
    CHECK(scene.checkpoints[1].tick == 9);
    CHECK(scene.checkpoints[1].hash == 0x0123456789abcdef);
    REQUIRE(scene.events.size() == 1);
    CHECK(scene.events[0].tick == 4);
    CHECK(scene.recorded_ticks == 10);
  }
}

TEST_CASE("drops a last line torn by a crash, and goes as far as the lines before it") {
  const std::string whole = test::scene_with("{}") + "\n" + R"({"step": 3, "checkpoint": "00000000000000ff"})" + "\n" +
                            R"({"step": 7, "move": [0.1, 0, 0]})" + "\n";
  const std::string last = R"({"step": 8, "end": true})";
  for (std::size_t kept = 1; kept < last.size(); ++kept) {
    const Scene scene = parse_scene(whole + last.substr(0, kept), "recording.jsonl");
    CHECK(scene.events.size() == 1);
    CHECK(scene.recorded_ticks == 8);
  }
  CHECK(parse_scene(whole + last, "recording.jsonl").recorded_ticks == 8);
}

TEST_CASE("refuses any other broken line with its number") {
  const std::string scene = test::scene_with("{}") + "\n";
  const auto message = [&](const std::string& lines) {
    return refusal([&] { parse_scene(scene + lines, "recording.jsonl"); });
  };
  CHECK(says(message("{\"step\": 1, \"release\": true}\n{\"step\": 2, \"mo\n{\"step\": 3, \"release\": true}\n"),
                   "recording.jsonl: line 3, column"));
  CHECK(says(message("{\"step\": 1, \"move\": 4}\n"), "line 2: move: is 4 (must be three"));
  CHECK(says(message("{\"step\": 1, \"mve\": 4}\n"), "line 2: mve: unknown key (did you mean 'move'?"));
  CHECK(says(message("{\"step\": 1, \"step\": 4}\n"), "line 2: step: stands twice"));
  CHECK(says(message("{\"step\": 1, \"end\": true}\n{\"step\": 2, \"end\": true}\n"), "line 3: a second end"));
}

TEST_CASE("a scene may name a tissue instead of a law, with what it says beside it") {
  const heml::Scene scene = heml::parse_scene(R"({
    "schema_version": 1, "mesh": {"box": {"size": [1, 1, 1], "cells": [1, 1, 1]}},
    "materials": [{"preset": "brain_ogden_swine", "region": 3, "density": 1040, "viscosity": 0.5}]})",
                                              "tissue.json");
  CHECK(scene.materials[0].region == 3);
  CHECK(scene.materials[0].material.law == "ogden");
  CHECK(scene.materials[0].material.viscosity == 0.5);
  CHECK_THROWS_WITH(heml::parse_scene(R"({
    "schema_version": 1, "mesh": {"box": {"size": [1, 1, 1], "cells": [1, 1, 1]}},
    "materials": [{"preset": "brian"}]})",
                                      "tissue.json"),
                    doctest::Contains("materials[0].preset"));
}

TEST_CASE("refuses plasticity in statics, which has no way to follow") {
  CHECK_THROWS_WITH(heml::parse_scene(R"({
    "schema_version": 1, "mesh": {"box": {"size": [1, 1, 1], "cells": [1, 1, 1]}}, "solver": {"integrator": "static"},
    "materials": [{"law": "neo_hookean_iso", "K1": 500, "kappa": 1e4, "plasticity": {"yield": 50}}]})",
                                      "clay.json"),
                    doctest::Contains("materials[0].plasticity: does not go with solver.integrator static"));
}

}  // namespace heml::read_scene_test
