// Removals as events: reading, writing, recording, replay, report.
#include <doctest/doctest.h>

#include <engine/mesh/files.hpp>
#include <engine/scenario/samples.hpp>
#include <heml/mesh/read.hpp>
#include <heml/scenario/recorder.hpp>
#include <heml/scenario/replay.hpp>
#include <heml/scenario/schedule.hpp>
#include <heml/scenario/solve.hpp>
#include <heml/scenario/text_file.hpp>

namespace heml::removal_test {
namespace {

const char* const removals = R"({
  "gravity": [0, -9.81, 0],
  "mesh": {"box": {"cells": [4, 2, 2]}},
  "solver": {"duration": 0.2, "continuation": true},
  "events": [
    {"step": 2, "remove": {"tets": [12, 3]}},
    {"step": 4, "remove": {"box": [[0.15, 0.05, 0], [0.2, 0.1, 0.05]]}},
    {"at": 0.06, "remove": {"sphere": [[0.1, 0.05, 0.05], 0.05]}},
    {"step": 8, "remove": {"region": 0}}
  ]})";

/// The scene without its last event, which removes all elements.
Scene scene_of_removals() {
  Scene scene = test::small_scene_with(removals);
  scene.events.pop_back();
  return scene;
}

std::string refused(const std::string& events) {
  return refusal([&] { test::small_scene_with(R"({"events": )" + events + "}"); });
}

}  // namespace

TEST_CASE("a removal reads the same from what it is written as") {
  const Scene scene = test::small_scene_with(removals);
  REQUIRE(scene.events.size() == 4);
  CHECK(std::get<RemoveElements>(scene.events[0].command).which.tets == std::vector<int>{12, 3});
  CHECK(scene.events[2].tick == 6);
  CHECK(std::get<RemoveElements>(scene.events[2].command).which.sphere->second == 0.05);
  CHECK(std::get<RemoveElements>(scene.events[3].command).which.region == 0);
  for (const Event& event : scene.events) {
    const std::string line = event_line(event);
    const Scene again = test::small_scene_with(R"({"events": [)" + line + "]}");
    CHECK(event_line(again.events[0]) == line);
  }
}

TEST_CASE("a removal that cannot be meant is refused where it stands") {
  CHECK(says(refused(R"([{"step": 1, "remove": {"tets": []}}])"), "events[0].remove.tets: is empty"));
  CHECK(says(refused(R"([{"step": 1, "remove": {"tets": [1.5]}}])"), "events[0].remove.tets[0]: is 1.5"));
  CHECK(says(refused(R"([{"step": 1, "remove": [3]}])"), "events[0].remove: is [3] (must be an object"));
  CHECK(says(refused(R"([{"step": 1, "remove": {}}])"), "give exactly one of tets, region, box, sphere"));
  CHECK(says(refused(R"([{"step": 1, "remove": {"nodes": [3]}}])"), "events[0].remove.nodes: unknown key"));
  CHECK(says(refused(R"([{"step": 1, "remove": {"box": [[1, 1, 1], [0, 0, 0]]}}])"), "lower corner first"));
  const auto played = [](const std::string& events) {
    return refusal([&] {
      const Scene scene = test::small_scene_with(R"({"events": )" + events + "}");
      const auto world = load_world(scene);
      replay(scene, *world);
    });
  };
  CHECK(says(played(R"([{"step": 1, "remove": {"tets": [4, 10]}}])"),
                   "events: step 1: remove.tets[1]: is 10 (the mesh has elements 0 to 9)"));
  CHECK(says(played(R"([{"step": 1, "remove": {"tets": [4]}}, {"step": 2, "remove": {"tets": [4]}}])"),
                   "events: step 2: remove: element 4 was removed before"));
  CHECK(says(played(R"([{"step": 1, "remove": {"region": 0}}])"), "all 10 elements that are left would go"));
}

TEST_CASE("a recorded session with removals and a reset replays to the bit") {
  const TemporaryFolder folder;
  Scene script = scene_of_removals();
  script.events.push_back({14, Reset{}});
  script.events.push_back({17, RemoveElements{{{40}, {}, {}, {}}}});
  {
    const auto world = load_world(script);
    Schedule schedule(script, world->setup().mesh);
    Scene bare = script;
    bare.events.clear();
    Recorder recorder(folder / "session.jsonl", bare, *world, 3);
    while (world->ticks() < 20) {
      for (const Event& event : schedule.due(world->ticks())) {
        REQUIRE(world->apply(event.command).ok());
        recorder.command(*world, event.command);
      }
      world->tick();
      recorder.ticked(*world);
    }
    recorder.end(*world);
  }
  const Scene recording = read_scene(folder / "session.jsonl");
  CHECK(recording.events.size() == 5);
  const auto world = load_world(recording);
  const ReplayResult result = replay(recording, *world);
  CHECK(result.ticks == 20);
  CHECK(result.checkpoints >= 7);
  CHECK(!result.difference);
  CHECK(world->topology()->elements.size() == 79);

  Scene other = recording;  // removing another element makes the replay differ
  std::get<RemoveElements>(other.events[0].command).which.tets[0] = 13;
  const auto elsewhere = load_world(other);
  CHECK(replay(other, *elsewhere).difference);
}

TEST_CASE("the report and the vtu of a solve say what was removed") {
  const TemporaryFolder folder;
  Scene scene = scene_of_removals();
  scene.output_vtu = true;
  solve(scene, folder / "out");
  const Json report = Json::parse(read_text_file(folder / "out/report.json"));
  CHECK(report["tets"] == 80);
  const int removed = report["removed"].get<int>();
  CHECK(removed > 2 + 4);
  REQUIRE(report["edits"].size() == 3);
  int sum = 0;
  for (const Json& edit : report["edits"]) {
    sum += edit["removed"].get<int>();
    CHECK(edit["mass"].get<double>() > 0);
    CHECK(edit["energy_after"]["elastic"].get<double>() <= edit["energy_before"]["elastic"].get<double>());
  }
  CHECK(sum == removed);
  CHECK(report["edits"][0]["step"] == 2);
  const TetMesh written = read_tet_mesh(folder / "out/positions.vtu");
  CHECK(static_cast<int>(written.tets.size()) == 80 - removed);
  CHECK(written.nodes.size() == 5 * 3 * 3);
}

}  // namespace heml::removal_test
