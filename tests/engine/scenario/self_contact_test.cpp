// Self-contact and tearing in scenes: writing, reading, refusal, report and replay.
#include <doctest/doctest.h>

#include <algorithm>
#include <engine/mesh/files.hpp>
#include <engine/scenario/samples.hpp>
#include <fstream>
#include <heml/scenario/explain.hpp>
#include <heml/scenario/recorder.hpp>
#include <heml/scenario/replay.hpp>
#include <heml/scenario/solve.hpp>

namespace heml::self_contact_test {
namespace {

/// A block with a slot from above; a probe presses its two lobes together.
constexpr const char* lobes = R"({
  "mesh": {"box": {"size": [0.1, 0.05, 0.02], "cells": [10, 5, 2]}},
  "boundary": [{"box": [[-1, -1, -1], [1, 0, 1]], "fix": true}],
  "self_contact": {"friction": 0.25},
  "materials": [{"law": "neo_hookean", "young": 5e3, "poisson": 0.3}],
  "solver": {"rate": 500, "duration": 0.4, "damping": 10, "continuation": true},
  "events": [{"step": 0, "remove": {"box": [[0.04, 0.01, -1], [0.06, 1, 1]]}},
             {"step": 1, "probe": {"radius": 0.006, "shaft": [0, 0, 0.06], "speed": 0.25,
                                   "path": [[0.108, 0.045, -0.02], [0.07, 0.045, -0.02]]}}]})";

/// A strip that is pulled apart.
constexpr const char* strip = R"({
  "mesh": {"box": {"size": [0.06, 0.02, 0.005], "cells": [12, 4, 1]}},
  "boundary": [{"box": [[0, -1, -1], [0, 1, 1]], "fix": true},
               {"box": [[0.06, -1, -1], [1, 1, 1]], "translate": [0.09, 0, 0], "over": 0.2}],
  "tearing": {"stretch": 1.6},
  "solver": {"rate": 500, "duration": 0.3, "damping": 10, "continuation": true}})";

Json solved(const char* patch) {
  const TemporaryFolder folder;
  const SolveResult result = solve(test::small_scene_with(patch), folder / "out");
  CHECK_FALSE(result.halt);
  std::ifstream file(folder / "out/report.json");
  return Json::parse(file);
}

}  // namespace

TEST_CASE("self-contact and tearing read back as they were written, and are off unless they are asked for") {
  const Scene plain = test::small_scene_with("{}");
  CHECK_FALSE(plain.self_contact);
  CHECK_FALSE(plain.tearing);
  CHECK_FALSE(test::small_scene_with(R"({"self_contact": false})").self_contact);
  CHECK(test::small_scene_with(R"({"self_contact": true})").self_contact->friction == 0);
  const Scene scene = test::small_scene_with(R"({"self_contact": {"friction": 0.3}, "tearing": {"stretch": 1.7}})");
  CHECK(scene.self_contact->friction == 0.3);
  CHECK(scene.tearing->stretch == 1.7);
  CHECK(scene.self_contact->within_bodies);
  const Scene between = test::small_scene_with(R"({"self_contact": {"within_bodies": false}})");
  CHECK_FALSE(between.self_contact->within_bodies);
  CHECK_FALSE(parse_scene(scene_line(between), "folder/scene.json").self_contact->within_bodies);
  const Scene again = parse_scene(scene_line(scene), "folder/scene.json");
  CHECK(scene_line(again) == scene_line(scene));
  CHECK(again.self_contact->friction == 0.3);
  CHECK(again.tearing->stretch == 1.7);
}

TEST_CASE("self-contact and tearing that cannot be meant are refused, with their place") {
  const auto refused = [](const char* patch) { return refusal([&] { test::small_scene_with(patch); }); };
  CHECK(says(refused(R"({"self_contact": 1})"), "self_contact: is 1"));
  CHECK(says(refused(R"({"self_contact": 1})"), "true, false, or"));
  CHECK(says(refused(R"({"self_contact": {"frction": 1}})"), "did you mean 'friction'?"));
  CHECK(says(refused(R"({"self_contact": {"within_bodies": 0}})"), "self_contact.within_bodies: is 0"));
  CHECK(says(refused(R"({"self_contact": {"friction": -1}})"), "self_contact.friction: is -1"));
  CHECK(says(refused(R"({"tearing": true})"), "must be an object"));
  CHECK(says(refused(R"({"tearing": {}})"), "'stretch' is missing"));
  CHECK(says(refused(R"({"tearing": {"stretch": 1}})"), "more than 1"));
  CHECK(says(refused(R"({"tearing": {"stretch": 2}, "solver": {"integrator": "static"}})"),
                   "does not go with solver.integrator static"));
}

TEST_CASE("solve reports what tissue bears of tissue") {
  const Json report = solved(lobes);
  CHECK(report.at("self_contact").at("force") > 0.01);
  CHECK(report.at("self_contact").at("touching") > 0);
  CHECK(report.at("self_contact").at("deepest") < 1e-4);
  CHECK_FALSE(solved(strip).contains("self_contact"));
}

TEST_CASE("lobes of one body pass through each other where bodies bear on each other alone") {
  std::string scene = lobes;
  const std::string friction = R"("friction": 0.25)";
  scene.replace(scene.find(friction), friction.size(), friction + R"(, "within_bodies": false)");
  const Json report = solved(scene.c_str());
  CHECK(report.at("self_contact").at("touching") == 0);
  CHECK(report.at("self_contact").at("force") == 0.0);
}

TEST_CASE("solve reports a tear") {
  const Json report = solved(strip);
  REQUIRE(report.at("edits").size() == 1);
  const Json& tear = report.at("edits")[0];
  CHECK(tear.at("torn") >= 8);
  CHECK(tear.at("area") > 0.0);
  CHECK(tear.at("removed") == 0);
  CHECK(report.at("tets") == 5 * 12 * 4);
}

TEST_CASE("recordings of lobes that touch and of a strip that tears play to the bit") {
  for (const char* patch : {lobes, strip}) {
    const TemporaryFolder folder;
    const auto path = folder / "session.jsonl";
    {
      const Scene scene = test::small_scene_with(patch);
      const auto world = load_world(scene);
      Recorder recorder(path, scene, *world, 30);
      replay(scene, *world, {}, &recorder);
      REQUIRE_FALSE(world->halt());
    }
    const Scene recording = read_scene(path);
    const auto world = load_world(recording);
    const ReplayResult result = replay(recording, *world);
    CHECK(result.checkpoints >= 5);
    CHECK_FALSE(result.difference);
  }
}

TEST_CASE("explain says that tissue passes tissue, or what keeping it apart takes") {
  const auto leaves_out = [](const Explanation& of, const char* feature) {
    return std::any_of(of.omitted_features.begin(), of.omitted_features.end(),
                       [&](const OmittedFeature& left) { return left.feature == feature; });
  };
  const Explanation plain = explain(test::small_scene_with("{}"));
  CHECK(leaves_out(plain, "self-contact"));
  CHECK(leaves_out(plain, "tearing"));
  const Explanation contact_count = explain(test::small_scene_with(lobes));
  CHECK_FALSE(leaves_out(contact_count, "self-contact"));
  CHECK(std::any_of(
      contact_count.world.memory.begin(), contact_count.world.memory.end(),
      [](const MemoryFacts& memory) { return std::string(memory.what) == "self-contact" && memory.bytes > 0; }));
}

}  // namespace heml::self_contact_test
