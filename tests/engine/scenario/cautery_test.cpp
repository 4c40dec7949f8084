// Burns in scenes: writing, reading, refusal, report, export and verified recordings.
#include <doctest/doctest.h>

#include <engine/mesh/files.hpp>
#include <engine/scenario/samples.hpp>
#include <fstream>
#include <heml/mesh/read.hpp>
#include <heml/scenario/frame_series.hpp>
#include <heml/scenario/scene.hpp>
#include <heml/scenario/solve.hpp>

namespace heml::cautery_test {
namespace {

Scene scene_with_events(const std::string& events) {
  return test::small_scene_with(R"({"solver": {"continuation": true}, "gravity": [0, -9.81, 0], "events": )" + events +
                                "}");
}

}  // namespace

TEST_CASE("a burn reads back as it was written, of a line and of a sweep") {
  for (const std::string path : {R"("line": [[0.1, 0.2, 0.3], [1, 2, 3]])", R"("line": [[0.1, 0.2, 0.3]])",
                                 R"("sweep": [[[0, 0, 1], [0, 0, 0]], [[1, 0, 1], [1, 0, 0]]])"}) {
    const Scene scene = scene_with_events(R"([{"step": 3, "cauterize": {)" + path + R"(, "radius": 0.004}}])");
    REQUIRE(scene.events.size() == 1);
    Event event = scene.events[0];
    auto& burn = std::get<CauterizeTissue>(event.command);
    CHECK(burn.heat.radius == 0.004);
    CHECK(burn.heat.shrink == usual_shrink);
    CHECK_FALSE(burn.continues_stroke);
    burn.heat.shrink = 1.0 / 3;
    burn.continues_stroke = true;
    const Scene again = scene_with_events("[" + event_line(event) + "]");
    const auto& read = std::get<CauterizeTissue>(again.events[0].command);
    CHECK(read.sweep.blades == burn.sweep.blades);
    CHECK(read.heat.radius == 0.004);
    CHECK(read.heat.shrink == 1.0 / 3);
    CHECK(read.continues_stroke);
    CHECK((event_line(event).find("line") != std::string::npos) == (path.find("line") != std::string::npos));
  }
}

TEST_CASE("a burn that cannot be meant is refused, with its place and what would be right") {
  const auto refused = [](const std::string& burn) {
    return refusal([&] { scene_with_events(R"([{"step": 1, "cauterize": )" + burn + "}]"); });
  };
  const std::string line = R"("line": [[0, 0, 0]])";
  CHECK(says(refused("{}"), "events[0].cauterize"));
  CHECK(says(refused("{}"), "line"));
  CHECK(says(refused("{" + line + "}"), "radius"));
  CHECK(says(refused(R"({"line": [], "radius": 1})"), "cauterize.line"));
  CHECK(says(refused(R"({"line": [], "radius": 1})"), "give one place of the electrode or more"));
  CHECK(says(refused(R"({"sweep": [], "radius": 1})"), "cauterize.sweep"));
  CHECK(says(refused(R"({"sweep": [[[0, 0, 0]]], "radius": 1})"), "two ends of the electrode"));
  CHECK(says(refused(R"({"line": [[0, 0]], "radius": 1})"), "line[0]"));
  CHECK(says(refused("{" + line + R"(, "sweep": [[[0, 0, 0], [0, 0, 1]]], "radius": 1})"), "sweep"));
  CHECK(says(refused("{" + line + R"(, "radius": -0.01})"), "cauterize.radius"));
  CHECK(says(refused("{" + line + R"(, "radius": 0})"), "cauterize.radius"));
  CHECK(says(refused("{" + line + R"(, "radius": 0.01, "shrink": 1})"), "cauterize.shrink"));
  CHECK(says(refused("{" + line + R"(, "radius": 0.01, "shrink": 1})"), "0.5"));
  CHECK(says(refused("{" + line + R"(, "radius": 0.01, "shrink": "much"})"), "cauterize.shrink"));
  CHECK(says(refused("{" + line + R"(, "radius": 0.01, "depth": 1})"), "unknown key"));
}

TEST_CASE("solve reports a burn, and a frame has what is burnt of each element") {
  const TemporaryFolder folder;
  const Scene scene =
      scene_with_events(R"([{"step": 3, "cauterize": {"line": [[0.1, 0.1, 0.05]], "radius": 0.09}}])");
  CHECK_FALSE(solve(scene, folder / "out").halt);
  std::ifstream file(folder / "out/report.json");
  const Json report = Json::parse(file);
  REQUIRE(report.at("edits").size() == 1);
  CHECK(report.at("edits")[0].at("step") == 3);
  CHECK(report.at("edits")[0].at("removed") == 0);
  CHECK(report.at("edits")[0].at("burnt").get<int>() > 0);

  const auto world = load_world(scene);
  write_frame(folder / "before.vtu", *world);
  CHECK_FALSE(find_field(read_tet_mesh(folder / "before.vtu"), "burnt"));
  REQUIRE(world->apply(scene.events[0].command).ok());
  write_frame(folder / "after.vtu", *world);
  const TetMesh after = read_tet_mesh(folder / "after.vtu");
  const ElementField* burnt = find_field(after, "burnt");
  REQUIRE(burnt);
  const std::vector<Burn>& burns = world->setup().mesh.burns;
  REQUIRE(burnt->values.size() == burns.size());
  for (std::size_t t = 0; t < burns.size(); ++t) CHECK(burnt->values[t] == burns[t].level);
}

}  // namespace heml::cautery_test
