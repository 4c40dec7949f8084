#include <doctest/doctest.h>

#include <heml/base/error.hpp>
#include <studies/quantity_text.hpp>
#include <studies/tune.hpp>

namespace heml::tune_test {

namespace {

Measured measured(double frame_milliseconds, double error, double step, bool failed = false) {
  Measured m;
  m.method = {Integrator::tr_bdf2, step, 1};
  m.error = error;
  m.run.simulated = 1;
  m.run.seconds = frame_milliseconds * 1e-3 / seconds_per_frame;
  if (failed) m.run.failed = "ran away";
  return m;
}

Tuning by_hand() {
  Tuning tuning;
  TunedMesh& mesh = tuning.meshes.emplace_back();
  mesh.mesh = "the scene's mesh";
  mesh.scene.name = "block";
  mesh.mesh_error = 1e-3;
  mesh.study.measured = {measured(20, 1e-6, 0.002), measured(10, 1e-4, 0.005), measured(5, 1e-3, 0.01),
                         measured(2, 1e-5, 1.0 / 30), measured(1, 1e-9, 0.001, true)};
  return tuning;
}

std::string refusal(const std::string& text, double (*parse)(const std::string&, const std::string&)) {
  try {
    parse(text, "--within");
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("quantities have a number and a unit") {
  CHECK(seconds_from("16ms", "--within") == doctest::Approx(0.016));
  CHECK(seconds_from("0.5 s", "--within") == 0.5);
  CHECK(seconds_from("250us", "--within") == doctest::Approx(250e-6));
  CHECK(metres_from("1mm", "--error") == doctest::Approx(1e-3));
  CHECK(metres_from("1e-1 cm", "--error") == doctest::Approx(1e-3));
  CHECK(metres_from("20 µm", "--error") == doctest::Approx(20e-6));
  for (const char* wrong : {"", "ms", "16", "16 mm", "-1ms", "0s", "nan s", "1e999 s", "16msx"}) {
    CAPTURE(wrong);
    CHECK(refusal(wrong, seconds_from).find("--within") != std::string::npos);
  }
  CHECK(refusal("16", seconds_from).find("ms") != std::string::npos);
  CHECK(refusal("16 inch", metres_from).find("inch") != std::string::npos);
}

TEST_CASE("within a time the least error counts, of methods that have a state for every frame and did not fail") {
  const Tuning tuning = by_hand();
  const auto best = best_for({0.016, std::nullopt}, tuning);
  REQUIRE(best);
  CHECK(best->measured->method.step == 0.005);
  CHECK(best->error() == doctest::Approx(1.1e-3));
  CHECK_FALSE(best_for({0.001, std::nullopt}, tuning));
}

TEST_CASE("within an error the least time counts, mesh and time together") {
  const Tuning tuning = by_hand();
  CHECK(best_for({std::nullopt, 1.2e-3}, tuning)->measured->method.step == 1.0 / 30);
  CHECK(best_for({std::nullopt, 1.005e-3}, tuning)->measured->method.step == 0.002);
  CHECK_FALSE(best_for({std::nullopt, 0.9e-3}, tuning));
  CHECK(nothing_reaches({std::nullopt, 0.9e-3}, tuning).find("most exact") != std::string::npos);
  CHECK(nothing_reaches({1e-4, std::nullopt}, tuning).find("fastest") != std::string::npos);
}

TEST_CASE("a tuned scene is a scene, solved as was measured, and the text says what was given up") {
  const Scene scene = parse_scene(R"({
    "schema_version": 1, "name": "block",
    "mesh": {"box": {"size": [0.2, 0.1, 0.1], "cells": [2, 2, 2]}},
    "materials": [{"law": "mooney_rivlin", "K1": 1500, "K2": 200, "kappa": 5e4}],
    "boundary": [{"box": [[0, -1, -1], [0, 1, 1]], "fix": true}],
    "gravity": [0, -9.81, 0],
    "solver": {"duration": 0.02},
    "events": [{"at": 0.01, "damping": 3}]
  })",
                                  "folder/scene.json");
  const Tuning tuning = measure_for_tuning(scene, false);
  CHECK(tuning.meshes.size() == 9);  // coarser, own, finer × three elements
  for (const TuneGoal& goal : {TuneGoal{10.0, std::nullopt}, TuneGoal{std::nullopt, 1.0}}) {
    const auto best = best_for(goal, tuning);
    REQUIRE(best);
    const Scene tuned = parse_scene(scene_text(tuned_scene(tuning, *best)), "folder/tuned.json");
    CHECK(tuned.solver.integrator == best->measured->method.integrator);
    CHECK(tuned.solver.element() == best->study->element);
    CHECK(tuned.events.size() == 1);
    CHECK(load_setup(tuned).mesh.tets.size() == best->study->tets);
    CHECK_FALSE(tuning_text(goal, tuning, *best).empty());
  }
}

}  // namespace heml::tune_test
