// Cuts in scenes: writing, reading, refusal, replay and report.
#include <doctest/doctest.h>

#include <engine/mesh/files.hpp>
#include <engine/scenario/samples.hpp>
#include <fstream>
#include <heml/scenario/replay.hpp>
#include <heml/scenario/solve.hpp>

namespace heml::cut_test {
namespace {

Scene scene_with_events(const std::string& events) {
  return test::small_scene_with(R"({"solver": {"continuation": true}, "gravity": [0, -9.81, 0], "events": )" + events +
                                "}");
}

constexpr const char* through = R"([{"step": 3, "cut": {"sweep": [[[0.12, -1, -1], [0.12, -1, 1]],
                                                                  [[0.12, 1, -1], [0.12, 1, 1]]]}}])";

}  // namespace

TEST_CASE("a cut reads back as it was written, with all its moments") {
  const Scene scene = scene_with_events(through);
  REQUIRE(scene.events.size() == 1);
  Event event = scene.events[0];
  CHECK(event.tick == 3);
  auto& cut = std::get<CutTissue>(event.command);
  REQUIRE(cut.sweep.blades.size() == 2);
  CHECK(cut.sweep.blades[1][0] == Vec3(0.12, 1, -1));
  CHECK_FALSE(cut.continues_stroke);
  cut.continues_stroke = true;
  cut.sweep.blades.push_back({Vec3(0.1, 0.2, 1.0 / 3), Vec3(1, 2, 3)});
  const Scene again = scene_with_events("[" + event_line(event) + ", " + event_line({4, Undo{}}) + "]");
  const auto& read = std::get<CutTissue>(again.events[0].command);
  CHECK(read.continues_stroke);
  CHECK(read.sweep.blades == cut.sweep.blades);
  CHECK(std::holds_alternative<Undo>(again.events[1].command));
}

TEST_CASE("a cut that cannot be meant is refused, with its place") {
  const auto refused = [](const std::string& cut) {
    return refusal([&] { scene_with_events(R"([{"step": 1, "cut": )" + cut + "}]"); });
  };
  CHECK(says(refused("{}"), "events[0].cut"));
  CHECK(says(refused("{}"), "sweep"));
  CHECK(says(refused(R"({"sweep": [[[0, 0, 0], [1, 0, 0]]]})"), "two times"));
  CHECK(says(refused(R"({"sweep": [[[0, 0, 0]], [[1, 0, 0]]]})"), "two ends"));
  CHECK(says(refused(R"({"sweep": [[[0, 0], [1, 0, 0]], [[0, 0, 0], [1, 0, 0]]]})"), "sweep[0][0]"));
  CHECK(says(refused(R"({"sweeps": []})"), "unknown key"));
  CHECK(says(refused("true"), "must be an object"));
}

TEST_CASE("solve reports a cut, and writes what it added after the nodes of the file") {
  const TemporaryFolder folder;
  const SolveResult result = solve(scene_with_events(through), folder / "out");
  CHECK_FALSE(result.halt);
  std::ifstream file(folder / "out/report.json");
  const Json report = Json::parse(file);
  REQUIRE(report.at("edits").size() == 1);
  const Json& edit = report.at("edits")[0];
  CHECK(edit.at("step") == 3);
  CHECK(edit.at("removed") == 0);
  CHECK(edit.at("split").get<int>() > 0);
  CHECK(edit.at("area").get<double>() == doctest::Approx(0.01).epsilon(0.5));
  CHECK(edit.at("smallest_angle").get<double>() > 8);
  CHECK(edit.at("energy_after").at("elastic").get<double>() ==
        doctest::Approx(edit.at("energy_before").at("elastic").get<double>()).epsilon(1e-9));
  CHECK(report.at("removed") == 0);
  CHECK(report.at("tets").get<int>() >= 10);
  const int nodes = report.at("nodes").get<int>();
  CHECK(nodes > 12);
  std::ifstream positions(folder / "out/positions.csv");
  int lines = 0;
  for (std::string line; std::getline(positions, line);) ++lines;
  CHECK(lines == nodes + 1);
}

TEST_CASE("an event refused on the way ends a solve in words, and what was reached is written and marked") {
  const TemporaryFolder folder;
  const std::string beside = R"([{"step": 2, "cut": {"sweep": [[[9, -1, -1], [9, -1, 1]], [[9, 1, -1], [9, 1, 1]]]}},
                                 {"step": 4, "undo": true}])";
  Scene scene = scene_with_events(beside);
  scene.output_times = {0.02, 0.06};
  std::filesystem::create_directory(folder / "out");
  folder.file("out/positions_1.csv", "of an earlier run");
  const std::string problem = refusal([&] { solve(scene, folder / "out"); });
  CHECK(says(problem, "events: step 4"));
  CHECK(says(problem, "the cut of step 2 parted nothing"));
  std::ifstream file(folder / "out/report.json");
  const Json report = Json::parse(file);
  CHECK(report.at("converged") == false);
  CHECK(report.at("ticks") == 4);
  CHECK(report.at("refused") == problem);
  CHECK(std::filesystem::exists(folder / "out/positions.csv"));
  CHECK(std::filesystem::exists(folder / "out/positions_0.csv"));
  CHECK_FALSE(std::filesystem::exists(folder / "out/positions_1.csv"));
}

TEST_CASE("undo after a cut that parted nothing takes back the edit before it") {
  const TemporaryFolder folder;
  const std::string events = R"([{"step": 1, "remove": {"tets": [0]}},
    {"step": 2, "cut": {"sweep": [[[9, -1, -1], [9, -1, 1]], [[9, 1, -1], [9, 1, 1]]]}}, {"step": 4, "undo": true}])";
  CHECK_FALSE(solve(scene_with_events(events), folder / "out").halt);
  std::ifstream file(folder / "out/report.json");
  CHECK(Json::parse(file).at("removed") == 0);
}

}  // namespace heml::cut_test
