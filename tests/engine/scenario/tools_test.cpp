// Pins, tables, probes and sutures in scenes: writing, reading, refusal and replay.
#include <doctest/doctest.h>

#include <engine/mesh/files.hpp>
#include <engine/scenario/samples.hpp>
#include <heml/scenario/recorder.hpp>
#include <heml/scenario/replay.hpp>
#include <heml/scenario/schedule.hpp>

namespace heml::tools_test {
namespace {

Scene scene_with_events(const std::string& events) {
  return test::small_scene_with(R"({"gravity": [0, -9.81, 0], "events": )" + events + "}");
}

std::string refused(const std::string& event) {
  return refusal([&] { scene_with_events(R"([{"step": 1, )" + event + "}]"); });
}

}  // namespace

TEST_CASE("tools read back as they were written") {
  const Event events[] = {{1, PinTissue{7, 0.03}},
                          {2, Unpin{7}},
                          {2, Unpin{}},
                          {3, SetTables{{{Vec3(0, -0.1, 1.0 / 3), Vec3(0, 1, 0), 0.3}}}},
                          {4, MoveProbe{0.01, Vec3(0, 0.1, 0), 0.2, {Vec3(0.1, 0.2, 0), Vec3(0.1, 0.1, 1.0 / 7)}, 0.5}},
                          {5, WithdrawProbe{}},
                          {6, SutureTissue{{3, 8}, 0.01, 0.25}},
                          {7, CutSutures{}}};
  std::string list;
  for (const Event& event : events) list += (list.empty() ? "[" : ", ") + event_line(event);
  const Scene scene = scene_with_events(list + "]");
  REQUIRE(scene.events.size() == std::size(events));
  for (std::size_t k = 0; k < std::size(events); ++k) {
    CHECK(scene.events[k].tick == events[k].tick);
    CHECK(scene.events[k].command.index() == events[k].command.index());
    CHECK(event_line(scene.events[k]) == event_line(events[k]));
  }
  CHECK(std::get<MoveProbe>(scene.events[4].command).path[1] == Vec3(0.1, 0.1, 1.0 / 7));
}

TEST_CASE("tables of a scene are put there, kept when it is written, and bear what lies on them") {
  const Scene scene = test::small_scene_with(
      R"({"boundary": null, "gravity": [0, -9.81, 0], "tables": [{"point": [0, 0, 0], "normal": [0, 2, 0], "friction": 0.4}],
          "solver": {"integrator": "static", "tolerance": 1e-9}})");
  REQUIRE(scene.tables.size() == 1);
  CHECK(scene.tables[0].normal == Vec3(0, 1, 0));
  const Scene again = parse_scene(scene_line(scene), "folder/scene.json");
  CHECK(scene_line(again) == scene_line(scene));
  const auto world = load_world(again);
  world->load_to(1);
  REQUIRE_FALSE(world->halt());
  CHECK(tools_of<TableState>(world->tools())[0].force.y() ==
        doctest::Approx(0.2 * 0.1 * 0.1 * 1000 * 9.81).epsilon(1e-6));
}

TEST_CASE("places of pins and sutures become the nodes nearest to them") {
  const Scene scene = scene_with_events(
      R"([{"step": 0, "pin": {"point": [0.21, 0.11, 0]}}, {"step": 1, "release": {"point": [0.21, 0.11, 0]}},
          {"step": 2, "suture": {"points": [[0.1, 0.12, 0], [0.2, 0.12, 0.1]], "length": 0.05}}])");
  const auto world = load_world(scene);
  Schedule schedule(scene, world->setup().mesh);
  const auto events = schedule.due(5);
  REQUIRE(events.size() == 3);
  const auto place = [&](int node) { return world->setup().mesh.nodes[static_cast<std::size_t>(node)]; };
  CHECK((place(std::get<PinTissue>(events[0].command).node) - Vec3(0.2, 0.1, 0)).norm() <= 1e-12);
  CHECK(std::get<Unpin>(events[1].command).node == std::get<PinTissue>(events[0].command).node);
  const auto ends = std::get<SutureTissue>(events[2].command).nodes;
  CHECK((place(ends[0]) - Vec3(0.1, 0.1, 0)).norm() <= 1e-12);
  CHECK((place(ends[1]) - Vec3(0.2, 0.1, 0.1)).norm() <= 1e-12);
}

TEST_CASE("tools that cannot be meant are refused, with their place") {
  CHECK(says(refused(R"("pin": {})"), "events[0].pin"));
  CHECK(says(refused(R"("pin": {"node": -1})"), "events[0].pin.node"));
  CHECK(says(refused(R"("pin": {"node": 1, "radius": -1})"), "pin.radius"));
  CHECK(says(refused(R"("pin": {"node": 1, "point": [0, 0, 0]})"), "pin"));
  CHECK(says(refused(R"("release": "pin")"), "\"pins\""));
  CHECK(says(refused(R"("release": {"pins": 3})"), "unknown key"));
  CHECK(says(refused(R"("release": {"nodes": 3})"), "release.nodes"));
  CHECK(says(refused(R"("tables": [{"point": [0, 0, 0]}])"), "normal"));
  CHECK(says(refused(R"("tables": [{"point": [0, 0, 0], "normal": [0, 0, 0]}])"), "must be a direction"));
  CHECK(says(refused(R"("tables": [{"point": [0, 0, 0], "normal": [0, 1, 0], "friction": -0.1}])"), "friction"));
  CHECK(says(refused(R"("probe": {"path": [[0, 0, 0]]})"), "radius"));
  CHECK(says(refused(R"("probe": {"radius": 0, "path": [[0, 0, 0]]})"), "probe.radius"));
  CHECK(says(refused(R"("probe": {"radius": 1, "path": []})"), "probe.path"));
  CHECK(says(refused(R"("probe": {"radius": 1, "path": [[0, 0, null]]})"), "probe.path[0]"));
  CHECK(says(refused(R"("probe": {"radius": 1, "path": [[0, 0, 0]], "speed": 0})"), "probe.speed"));
  CHECK(says(refused(R"("suture": {"nodes": [1]})"), "must be two"));
  CHECK(says(refused(R"("suture": {"nodes": [1, 2], "length": -1})"), "suture.length"));
  CHECK(says(refused(R"("suture": {"nodes": [1, 2], "over": -1})"), "suture.over"));
  const Scene far = scene_with_events(R"([{"step": 1, "suture": {"nodes": [1, 2000]}}])");
  CHECK(says(refusal([&] { Schedule(far, load_setup(far).mesh); }), "suture.nodes"));
}

TEST_CASE("a recorded session with every tool replays to the bit, by explicit and by implicit steps") {
  for (const std::string solver :
       {R"({"rate": 100, "duration": 0.5})",
        R"({"integrator": "backward_euler", "rate": null, "step": 0.01, "duration": 0.5})"}) {
    CAPTURE(solver);
    const Scene scene =
        test::small_scene_with(R"({"gravity": [0, -9.81, 0], "solver": )" + solver +
                               R"(, "tables": [{"point": [0, -0.01, 0], "normal": [0, 1, 0], "friction": 0.3}]})");
    const TemporaryFolder folder;
    {
      const auto world = load_world(scene);
      Recorder recorder(folder / "session.jsonl", scene, *world, 10);
      const auto command = [&](const Command& given) {
        REQUIRE(world->apply(given).ok());
        recorder.command(*world, given);
      };
      while (world->ticks() < 50) {
        if (world->ticks() == 2) command(PinTissue{11, 0});
        if (world->ticks() == 4)
          command(MoveProbe{0.02, Vec3(0, 0.2, 0), 0.2, {Vec3(0.15, 0.15, 0.05), Vec3(0.15, 0.1, 0.05)}, 1});
        if (world->ticks() == 20) command(MoveProbe{0.02, Vec3(0, 0.2, 0), 0.2, {Vec3(0.12, 0.1, 0.05)}, 0.5});
        if (world->ticks() == 25) command(Unpin{11});
        if (world->ticks() == 30) command(WithdrawProbe{});
        if (world->ticks() == 32) command(SutureTissue{{4, 8}, 0.1, 0.1});
        if (world->ticks() == 45) command(CutSutures{});
        if (world->ticks() == 46) command(SetTables{});
        world->tick();
        recorder.ticked(*world);
      }
      REQUIRE_FALSE(world->halt());
      recorder.end(*world);
    }
    Scene recording = read_scene(folder / "session.jsonl");
    for (const int threads : {1, 2}) {
      recording.solver.threads = threads;
      const auto world = load_world(recording);
      const ReplayResult result = replay(recording, *world);
      CHECK(result.checkpoints >= 5);
      CHECK_FALSE(result.difference);
    }
  }
}

}  // namespace heml::tools_test
