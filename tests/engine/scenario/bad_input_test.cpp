// Every mistake gives a one-line message that names the place and a remedy.
#include <doctest/doctest.h>

#include <engine/mesh/files.hpp>
#include <engine/scenario/samples.hpp>
#include <heml/scenario/scene.hpp>

namespace heml::bad_input_test {
namespace {

struct Mistake {
  const char* text;    ///< a patch of the small scene, or a whole file
  const char* place;   ///< expected in the message
  const char* remedy;  ///< expected in the message
};

void expect_refused(const std::string& text, const Mistake& mistake) {
  CAPTURE(mistake.text);
  const std::string message = refusal([&] { parse_scene(text, "folder/bad.json"); });
  CAPTURE(message);
  CHECK(message.starts_with("folder/bad.json: "));
  CHECK(message.find('\n') == message.npos);
  CHECK(says(message, std::string(": ") + mistake.place));
  CHECK(says(message, mistake.remedy));
}

const Mistake mistakes[] = {
    {R"({"schema_version": null})", "'schema_version' is missing", "\"schema_version\": 1"},
    {R"({"schema_version": 2})", "schema_version: is 2", "reads version 1"},
    {R"({"schema_version": "1"})", "schema_version: is \"1\"", "reads version 1"},
    {R"({"solvr": {}})", "solvr: unknown key", "did you mean 'solver'?"},
    {R"({"name": 3})", "name: is 3", "a text in quotes"},
    {R"({"mesh": null})", "'mesh' is missing", "add \"mesh\""},
    {R"({"mesh": "box.msh"})", "mesh: is \"box.msh\"", "an object"},
    {R"({"mesh": {"file": "a.msh"}})", "mesh: holds file and box", "exactly one of file, surface, labels, box, asset"},
    {R"({"mesh": {"box": null}})", "mesh: holds none", "exactly one of file, surface, labels, box, asset"},
    {R"({"mesh": {"box": null, "file": ""}})", "mesh.file: is \"\"", "path of a file"},
    {R"({"mesh": {"box": null, "asset": "../../etc/passwd"}})", "mesh.asset: is", "name of a mesh"},
    {R"({"mesh": {"scale": 0}})", "mesh.scale: is 0", "greater than 0"},
    {R"({"mesh": {"scale": [1, 1, 1]}})", "mesh.scale: is [1,1,1]", "must be a number"},
    {R"({"mesh": {"tetgen": {"max_volume": 1}}})", "mesh.tetgen: goes with a surface", "mesh.surface"},
    {R"({"mesh": {"box": null, "surface": "a.stl", "tetgen": {"max_volume": 0}}})", "mesh.tetgen.max_volume: is 0",
     "greater than 0"},
    {R"({"mesh": {"box": null, "surface": "a.stl", "tetgen": {"radius_edge_ratio": 0.5}}})",
     "mesh.tetgen.radius_edge_ratio: is 0.5", "from 1 to 100"},
    {R"({"mesh": {"box": {"cells": [0, 1, 1]}}})", "mesh.box.cells[0]: is 0", "whole number from 1"},
    {R"({"mesh": {"box": {"cells": [1.5, 1, 1]}}})", "mesh.box.cells[0]: is 1.5", "whole number"},
    {R"({"mesh": {"box": {"cells": [2, 1]}}})", "mesh.box.cells: is [2,1]", "three whole numbers"},
    {R"({"mesh": {"box": {"cells": [1000, 1000, 1000]}}})", "mesh.box.cells: is [1000,1000,1000]", "cells in all"},
    {R"({"mesh": {"box": {"cells": [1e10, 1, 1]}}})", "mesh.box.cells[0]", "whole number"},
    {R"({"mesh": {"box": {"size": [0.1, 0, 0.1]}}})", "mesh.box.size: is", "greater than 0"},
    {R"({"mesh": {"rotate": {"axis": [0, 0, 0], "degrees": 1}}})", "mesh.rotate.axis: is [0,0,0]",
     "not all of its numbers 0"},
    {R"({"mesh": {"rotate": {"degrees": 1}}})", "mesh.rotate: 'axis' is missing", "add \"axis\""},
    {R"({"mesh": {"translate": [0, 1]}})", "mesh.translate: is [0,1]", "three numbers"},
    {R"({"mesh": {"translate": [0, 1, "x"]}})", "mesh.translate[2]: is \"x\"", "must be a number"},
    {R"({"materials": null})", "'materials' is missing", "add \"materials\""},
    {R"({"materials": []})", "materials: is empty", "at least one"},
    {R"({"materials": {}})", "materials: is {}", "a list"},
    {R"({"materials": [{"young": 1, "poisson": 0.3}]})", "materials[0]: 'law' is missing", "add \"law\""},
    {R"({"materials": [{"law": "neohookean"}]})", "materials[0].law: is \"neohookean\"", "did you mean 'neo_hookean'?"},
    {R"({"materials": [{"law": "stvk", "young": 1, "poison": 0.3}]})", "materials[0].poison: unknown key",
     "did you mean 'poisson'?"},
    {R"({"materials": [{"law": "stvk", "young": 1, "poisson": 0.5}]})", "materials[0].poisson: is 0.5", "like 0.49"},
    {R"({"materials": [{"law": "stvk", "young": 1, "poisson": 0.6}]})", "materials[0].poisson: is 0.6",
     "less than 0.5"},
    {R"({"materials": [{"law": "stvk", "young": 1, "poisson": -1}]})", "materials[0].poisson: is -1",
     "greater than -1"},
    {R"({"materials": [{"law": "stvk", "young": 0, "poisson": 0.3}]})", "materials[0].young: is 0", "greater than 0"},
    {R"({"materials": [{"law": "stvk", "young": "1 kPa", "poisson": 0.3}]})", "materials[0].young: is \"1 kPa\"",
     "must be a number"},
    {R"({"materials": [{"law": "stvk", "young": 1}]})", "materials[0]: 'poisson' is missing", "add \"poisson\""},
    {R"({"materials": [{"law": "stvk"}]})", "materials[0]: 'young' is missing", "or lambda and mu"},
    {R"({"materials": [{"law": "stvk", "young": 1, "mu": 1}]})", "materials[0]: mixes young, poisson with lambda, mu",
     "one pair only"},
    {R"({"materials": [{"law": "stvk", "lambda": 1, "mu": -3}]})", "materials[0].mu: ", "greater than 0"},
    {R"({"materials": [{"law": "stvk", "young": 1, "poisson": 0.3, "density": 0}]})", "materials[0].density: is 0",
     "greater than 0"},
    {R"({"materials": [{"law": "stvk", "young": 1e308, "poisson": 0.4999}]})", "materials[0]: its parameters overflow",
     "smaller"},
    {R"({"materials": [{"law": "stvk", "young": 1, "poisson": 0.3}, {"law": "stvk", "young": 2, "poisson": 0.3}]})",
     "materials[1]: is for no region, like materials[0]", "another region"},
    {R"({"materials": [{"region": 1.5, "law": "stvk", "young": 1, "poisson": 0.3}]})", "materials[0].region: is 1.5",
     "whole number"},
    {R"({"boundary": [{"fix": true}]})", "boundary[0]: holds none", "exactly one of nodes, box, sphere"},
    {R"({"boundary": [{"nodes": [0], "sphere": [[0, 0, 0], 1], "fix": true}]})", "boundary[0]: holds nodes and sphere",
     "exactly one of nodes, box, sphere"},
    {R"({"boundary": [{"nodes": [], "fix": true}]})", "boundary[0].nodes: is empty", "at least one node"},
    {R"({"boundary": [{"nodes": [-1], "fix": true}]})", "boundary[0].nodes[0]: is -1", "whole number from 0"},
    {R"({"boundary": [{"nodes": [0]}]})", "boundary[0]: says nothing", "fix: true"},
    {R"({"boundary": [{"nodes": [0], "fix": true, "translate": [1, 0, 0]}]})", "boundary[0]: is both fixed and moved",
     "fix: true, or translate"},
    {R"({"boundary": [{"nodes": [0], "fix": 1}]})", "boundary[0].fix: is 1", "true or false"},
    {R"({"boundary": [{"nodes": [0], "translate": [0, 0, 0], "over": -1}]})", "boundary[0].over: is -1",
     "0 or greater"},
    {R"({"boundary": [{"nodes": [0], "rotate": {"axis": [1, 0, 0]}}]})", "boundary[0].rotate: 'degrees' is missing",
     "add \"degrees\""},
    {R"({"boundary": [{"nodes": [0], "fix": true, "axes": "xw"}]})", "boundary[0].axes: is \"xw\"",
     "some of x, y and z"},
    {R"({"boundary": [{"nodes": [0], "fix": true, "axes": "yy"}]})", "boundary[0].axes: is \"yy\"", "each once"},
    {R"({"boundary": [{"nodes": [0], "fix": true, "axes": ""}]})", "boundary[0].axes: is \"\"", "some of x, y and z"},
    {R"({"boundary": [{"nodes": [0], "rotate": {"degrees": 9, "axis": [0, 0, 1]}, "axes": "x"}]})",
     "boundary[0].axes: is \"x\"", "left out, where nodes are rotated"},
    {R"({"boundary": [{"box": [[1, 0, 0], [0, 1, 1]], "fix": true}]})", "boundary[0].box: is", "lower corner first"},
    {R"({"boundary": [{"box": [[1, 0, 0]], "fix": true}]})", "boundary[0].box: is", "two corners"},
    {R"({"boundary": [{"sphere": [[0, 0, 0], -1], "fix": true}]})", "boundary[0].sphere[1]: is -1", "0 or greater"},
    {R"({"loads": [{"nodes": [0]}]})", "loads[0]: holds none", "exactly one of force, traction, pressure"},
    {R"({"loads": [{"nodes": [0], "force": [0, 0, 1], "pressure": 3}]})", "loads[0]: holds force and pressure",
     "exactly one of"},
    {R"({"loads": [{"nodes": [0], "pressure": [1, 2, 3]}]})", "loads[0].pressure: is [1,2,3]", "must be a number"},
    {R"({"gravity": -9.81})", "gravity: is -9.81", "three numbers"},
    {R"({"solver": {"integrator": "verlett"}})", "solver.integrator: is \"verlett\"", "did you mean 'verlet'?"},
    {R"({"solver": {"rate": null, "step": 0}})", "solver.step: is 0", "greater than 0"},
    {R"({"solver": {"step": 0.01}})", "solver: holds step and rate", "give one"},
    {R"({"solver": {"rate": 1e-3}})", "solver.rate: is 0.001", "from 1 to"},
    {R"({"solver": {"rate": null, "step": 1e-300}})", "solver: a duration of 0.1 s is too many steps", "at most"},
    {R"({"solver": {"duration": -1}})", "solver.duration: is -1", "0 or greater"},
    {R"({"solver": {"damping": -1}})", "solver.damping: is -1", "0 or greater"},
    {R"({"solver": {"precision": "half"}})", "solver.precision: is \"half\"", "one of double, float"},
    {R"({"solver": {"threads": -1}})", "solver.threads: is -1", "from 0 to"},
    {R"({"solver": {"element": "nodal_pressure"}})", "materials[0].law: 'stvk' has no volume term",
     "\"element\": \"p1\""},
    {R"({"solver": {"element": "p2_pressure"}})", "materials[0].law: 'stvk' has no volume term", "\"element\": \"p2\""},
    {R"({"solver": {"element": "p3"}})", "solver.element: is \"p3\"", "p1, nodal_pressure, p2, p2_pressure"},
    {R"({"solver": {"element": "p2"}, "tearing": {"stretch": 2}})", "tearing: does not go with solver.element p2",
     "\"element\": \"p1\""},
    {R"({"solver": {"element": "p2"}, "materials": [{"law": "mass_spring", "stiffness": 10}]})",
     "materials[0].law: does not go with solver.element p2", "\"element\": \"p1\""},
    {R"({"solver": {"tolerance": 0}})", "solver.tolerance: is 0", "greater than 0"},
    {R"({"solver": {"budget": {"iterations": 0}}})", "solver.budget.iterations: is 0", "1"},
    {R"({"solver": {"budget": {"milliseconds": -2}}})", "solver.budget.milliseconds: is -2", "greater than 0"},
    {R"({"solver": {"budget": {"iterations": 1, "milliseconds": 2}}})", "solver.budget", "iterations"},
    {R"({"solver": {"minimiser": "bfgs"}})", "solver.minimiser", "lbfgs"},
    {R"({"solver": {"projection": "elements"}})", "solver.projection", "element"},
    {R"({"solver": {"preconditioner": "jacobi"}})", "solver.preconditioner", "block_jacobi"},
    {R"({"solver": {"continuation": "yes"}})", "solver.continuation: is \"yes\"", "true or false"},
    {R"({"outputs": {"times": [0.05, 0.2]}})", "outputs.times[1]: is 0.2", "at most solver.duration, 0.1 s"},
    {R"({"solver": {"integrator": "static", "duration": 0.1}, "outputs": {"times": [0.5, 1.5]}})",
     "outputs.times[1]: is 1.5", "fractions of the load, at most 1"},
    {R"({"outputs": {"times": [-1]}})", "outputs.times[0]: is -1", "0 or greater"},
    {R"({"outputs": {"time": [0]}})", "outputs.time: unknown key", "did you mean 'times'?"},
    {R"({"initial": {"position": "a.csv"}})", "initial.position: unknown key", "did you mean 'positions'?"},
    {R"({"view": {"field": "stress"}})", "view.field: is \"stress\"", "von_mises"},
    {R"({"view": {"elevation": 100}})", "view.elevation: is 100", "from -90 to 90"},
    {R"({"events": [{"move": [0, 0, 0]}]})", "events[0]: holds none", "exactly one of step, at"},
    {R"({"events": [{"step": 1, "at": 1, "release": true}]})", "events[0]: holds step and at",
     "exactly one of step, at"},
    {R"({"events": [{"step": 1}]})", "events[0]: holds none", "exactly one of grasp, move"},
    {R"({"events": [{"step": 1.5, "release": true}]})", "events[0].step: is 1.5", "whole number"},
    {R"({"events": [{"at": -1, "release": true}]})", "events[0].at: is -1", "0 or greater"},
    {R"({"events": [{"at": 1e300, "release": true}]})", "events[0].at: is 1e+300", "at most"},
    {R"({"events": [{"step": 1, "release": false}]})", "events[0].release: is false", "must be true"},
    {R"({"events": [{"step": 1, "grasp": {"radius": 1}}]})", "events[0].grasp: holds none",
     "exactly one of node, point"},
    {R"({"events": [{"step": 1, "grasp": {"node": 1, "radius": -1}}]})", "events[0].grasp.radius: is -1",
     "0 or greater"},
    {R"({"events": [{"step": 1, "material": {"law": "stvk", "young": 1, "poisson": 0.5}}]})",
     "events[0].material.poisson: is 0.5", "like 0.49"},
    {R"({"checkpoints": [{"step": 1, "checkpoint": "12"}]})", "checkpoints[0].checkpoint: is \"12\"", "16 hexadecimal"},
    {R"({"checkpoints": [{"step": 1, "checkpoint": "0123456789abcdef", "nodes": "12x4"}]})",
     "checkpoints[0].nodes: is \"12x4\"", "4 hexadecimal digits a node"},
    {R"({"recorded": {"nodes": 1, "tets": 1}})", "recorded: 'mesh' is missing", "add \"mesh\""},
};

const Mistake broken_texts[] = {
    {"", "is empty", "give a scene or a recording"},
    {"{", "line 1, column 2: not valid JSON", "unexpected end of input"},
    {"{\n  \"schema_version\": 1,\n  oops\n}", "line 3, column 3: not valid JSON", "expected string literal"},
    {"{\"schema_version\": NaN}", "line 1, column 20: not valid JSON", "invalid literal"},
    {"{\"gravity\": [0, 1e999, 0]}", "line 1, column 21: not valid JSON", "number overflow"},
    {"[1, 2]", "is [1,2]", "must be a scene"},
    {"{\"schema_version\": 1, \"name\": \"a\", \"name\": \"b\"}", "name: stands twice", "keep one"},
    {"{\"a\": [{}, {\"b\": 1, \"b\": 2}]}", "a[1].b: stands twice", "keep one"},
    {"{\"schema_version\": 1, \"name\": \"\xff\"}", "line 1, column 32: not valid JSON", "ill-formed UTF-8"},
};

}  // namespace

TEST_CASE("refuses every mistake in a scene with its key path, the value seen and what would be right") {
  for (const Mistake& mistake : mistakes) expect_refused(test::scene_with(mistake.text), mistake);
}

TEST_CASE("refuses text that is not JSON with line and column, and keys that stand twice") {
  for (const Mistake& mistake : broken_texts) expect_refused(mistake.text, mistake);
}

TEST_CASE("says which integrators are available where a known one is not part of the build") {
  for (const char* name : {"symplectic_euler", "verlet", "backward_euler", "bdf2", "tr_bdf2", "static", "auto"}) {
    const std::string message =
        refusal([&] { test::small_scene_with(std::string("{\"solver\": {\"integrator\": \"") + name + "\"}}"); });
    CHECK(message.empty() == find_integrator(name).has_value());
    if (message.empty()) continue;
    CHECK(says(message, std::string("solver.integrator: the integrator '") + name + "' is not part"));
    CHECK(says(message, "symplectic_euler, verlet"));
  }
}

TEST_CASE("refuses nesting without end") {
  const std::string message = refusal([] { parse_scene(std::string(100000, '['), "deep.json"); });
  CHECK(says(message, "nested too deeply"));
}

TEST_CASE("shortens enormous values in its message") {
  const std::string patch = "{\"gravity\": \"" + std::string(100000, 'x') + "\"}";
  const std::string message = refusal([&] { test::small_scene_with(patch); });
  CHECK(says(message, "gravity: is \"xxx"));
  CHECK(message.size() < 400);
}

TEST_CASE("refuses files that are missing, folders, and kinds it does not open") {
  const TemporaryFolder folder;
  CHECK(says(refusal([&] { read_scene(folder / "missing.json"); }), "missing.json: cannot be read"));
  std::filesystem::create_directory(folder / "scene.json");
  CHECK(says(refusal([&] { read_scene(folder / "scene.json"); }), "is not a file"));
  const std::string message = refusal([&] { read_scene(folder.file("notes.txt", "hello")); });
  for (const char* ending : {".json", ".jsonl", ".msh", ".vtu", ".obj", ".stl"}) CHECK(says(message, ending));
}

TEST_CASE("reads one material entry as a file, and refuses a wrong one with its key") {
  const TemporaryFolder folder;
  const std::filesystem::path right = folder.file("m.json", R"({"law": "stvk", "lambda": 3, "mu": 2, "density": 7})");
  const std::filesystem::path wrong = folder.file("bad.json", R"({"law": "stvk", "lamda": 3, "mu": 2})");
  const Material material = read_material(right);
  CHECK(material.law == "stvk");
  CHECK(material.parameters == std::vector<double>{3, 2});
  CHECK(material.density == 7);
  const std::string message = refusal([&] { read_material(wrong); });
  CHECK(says(message, "bad.json: lamda: unknown key (did you mean 'lambda'?"));
}

}  // namespace heml::bad_input_test
