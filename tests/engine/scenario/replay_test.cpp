#include <doctest/doctest.h>

#include <engine/mesh/files.hpp>
#include <engine/scenario/samples.hpp>
#include <fstream>
#include <heml/mesh/generate.hpp>
#include <heml/mesh/write.hpp>
#include <heml/scenario/recorder.hpp>
#include <heml/scenario/replay.hpp>
#include <heml/scenario/schedule.hpp>
#include <iterator>

namespace heml::replay_test {
namespace {

Scene session_scene() {
  return test::small_scene_with(R"({"gravity": [0, -9.81, 0], "solver": {"continuation": true}})");
}

/// Records 50 ticks with commands of every kind and a checkpoint every 10 ticks.
void record(const std::filesystem::path& path, const Scene& scene) {
  const std::unique_ptr<World> world = load_world(scene);
  Recorder recorder(path, scene, *world, 10);
  const auto command = [&](const Command& given) {
    REQUIRE(world->apply(given).ok());
    recorder.command(*world, given);
  };
  while (world->ticks() < 50) {
    const long tick = world->ticks();
    if (tick == 3) command(Grasp{11, 0.05});
    if (tick > 3 && tick < 30) command(MoveTool{Vec3(0.2 + 1e-3 * static_cast<double>(tick) / 3, 0.1, 0.1)});
    if (tick == 20) command(SetMaterial{std::nullopt, {"neo_hookean", {2e4, 1e4}, 1000}});
    if (tick == 25) command(SetDamping{0.3});
    if (tick == 28) command(CauterizeTissue{{{{Vec3(0.1, 0.1, 0), Vec3(0.1, 0.1, 0)}}}, {0.08, 0.2}});
    if (tick == 30) command(Release{});
    if (tick == 35) command(SetIntegrator{Integrator::symplectic_euler});
    if (tick == 38) command(SetGravity{Vec3(1, 0, 0)});
    if (tick == 40)
      command(CutTissue{{{{Vec3(0.08, -1, -1), Vec3(0.08, -1, 1)}, {Vec3(0.09, 1, -1), Vec3(0.09, 1, 1)}}}, false});
    if (tick == 42) command(Undo{});
    if (tick == 43)
      command(
          CutTissue{{{{Vec3(0.12, -1, -1), Vec3(0.12, -1, 1)}, {Vec3(0.12, 0.06, -1), Vec3(0.12, 0.06, 1)}}}, true});
    if (tick == 45) command(Reset{});
    world->tick();
    recorder.ticked(*world);
  }
  recorder.end(*world);
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

ReplayResult replay_of(const Scene& scene) {
  const std::unique_ptr<World> world = load_world(scene);
  return replay(scene, *world);
}

}  // namespace

TEST_CASE("replays a recorded session to the bit") {
  const TemporaryFolder folder;
  record(folder / "session.jsonl", session_scene());
  const Scene recording = read_scene(folder / "session.jsonl");
  CHECK(recording.recorded_ticks == 50);
  CHECK(recording.events.size() == 37);
  const std::unique_ptr<World> world = load_world(recording);
  long calls = 0;
  const ReplayResult result = replay(recording, *world, [&](World& at) { CHECK(at.ticks() == ++calls); });
  CHECK(calls == 50);
  CHECK(result.ticks == 50);
  CHECK(result.checkpoints == 6);
  CHECK(!result.difference);
  CHECK(!result.halt);
}

TEST_CASE("a replay can be recorded, with the same commands and its own checkpoints") {
  const TemporaryFolder folder;
  record(folder / "session.jsonl", session_scene());
  const Scene recording = read_scene(folder / "session.jsonl");
  const std::unique_ptr<World> world = load_world(recording);
  Recorder recorder(folder / "again.jsonl", recording, *world, 7);
  replay(recording, *world, {}, &recorder);
  const Scene again = read_scene(folder / "again.jsonl");
  CHECK(again.recorded_ticks == 50);
  CHECK(again.checkpoints.size() == 9);  // at 0, 7, …, 49, and the end
  REQUIRE(again.events.size() == recording.events.size());
  for (std::size_t k = 0; k < again.events.size(); ++k)
    CHECK(event_line(again.events[k]) == event_line(recording.events[k]));
  CHECK_FALSE(replay_of(again).difference.has_value());
}

void check_instructions(bool quadratic) {
  const TemporaryFolder folder;
  for (const InstructionSet isa : instruction_sets()) {
    Scene scene = session_scene();
    scene.solver.quadratic = quadratic;
    scene.recorded_instructions = isa;
    record(folder / "session.jsonl", scene);
    const std::string text = text_of(folder / "session.jsonl"), name(name_of(isa));
    const Scene recording = read_scene(folder / "session.jsonl");
    CHECK(recording.recorded_instructions == isa);
    CHECK(plays_as_recorded(recording));
    CHECK(!replay_of(recording).difference);

    const auto said_to_be = [&](const std::string& other) {
      const std::string key = "\"instructions\": \"";
      const std::size_t at = text.find(key + name);
      REQUIRE(at != std::string::npos);
      return read_scene(folder.file("other.jsonl", std::string(text).replace(at + key.size(), name.size(), other)));
    };
    for (const InstructionSet other : {InstructionSet::portable, InstructionSet::avx2, InstructionSet::avx512}) {
      const Scene of_other = said_to_be(std::string(name_of(other)));
      const bool is_here = other <= instruction_sets().back();
      CHECK(plays_as_recorded(of_other) == is_here);
      const InstructionSet used = load_setup(of_other).instruction_set;
      CHECK(used == (is_here ? other : InstructionSet::best));
      // Point kernels of AVX2 and AVX-512 do the same operations, each lane an element.
      if (quadratic && resolve(used) != InstructionSet::portable && isa != InstructionSet::portable) continue;
      CHECK(replay_of(of_other).difference.has_value() == (resolve(used) != isa));
    }
    CHECK_THROWS_AS(said_to_be("sse9"), InputError);
  }
}

TEST_CASE("a recording is played with the instructions it was made with") { check_instructions(false); }

TEST_CASE("a recording of quadratic elements is played with the instructions it was made with") {
  check_instructions(true);
}

TEST_CASE("replays a session that ended on a command, with no tick after it") {
  const TemporaryFolder folder;
  const Scene scene = session_scene();
  const std::unique_ptr<World> world = load_world(scene);
  Recorder recorder(folder / "session.jsonl", scene, *world, 10);
  while (world->ticks() < 15) {
    world->tick();
    recorder.ticked(*world);
  }
  REQUIRE(world->apply(Reset{}).ok());
  recorder.command(*world, Reset{});
  recorder.end(*world);
  const Scene recording = read_scene(folder / "session.jsonl");
  CHECK(recording.recorded_ticks == 15);
  const ReplayResult result = replay_of(recording);
  CHECK(result.ticks == 15);
  CHECK(result.checkpoints == 2);
  CHECK(!result.difference);
}

TEST_CASE("replays what a crash left of a recording") {
  const TemporaryFolder folder;
  record(folder / "session.jsonl", session_scene());
  const std::string whole = text_of(folder / "session.jsonl");
  const std::size_t cut = whole.find("{\"step\": 30, \"checkpoint\"") + 100;
  const Scene recording = read_scene(folder.file("torn.jsonl", whole.substr(0, cut)));
  CHECK(recording.recorded_ticks == 30);
  const ReplayResult result = replay_of(recording);
  CHECK(result.checkpoints == 3);
  CHECK(!result.difference);
}

TEST_CASE("names the first step and node that differ") {
  const TemporaryFolder folder;
  record(folder / "session.jsonl", session_scene());
  Scene recording = read_scene(folder / "session.jsonl");
  Scene other = recording;
  other.checkpoints[2].hash ^= 1;
  other.checkpoints[2].nodes[5] ^= 1;
  other.checkpoints[2].nodes[8] ^= 1;
  other.checkpoints[4].hash ^= 1;
  const ReplayResult result = replay_of(other);
  REQUIRE(result.difference);
  CHECK(result.difference->tick == 20);
  CHECK(result.difference->node == 5);
  CHECK(result.difference->expected == other.checkpoints[2].hash);
  CHECK(result.difference->actual == recording.checkpoints[2].hash);
  CHECK(says(to_text(*result.difference), "step 20, node 5"));

  std::get<MoveTool>(recording.events[10].command).target.x() += 1e-12;  // at tick 13
  const ReplayResult moved = replay_of(recording);
  REQUIRE(moved.difference);
  CHECK(moved.difference->tick == 20);
  CHECK(moved.difference->node >= 0);
}

TEST_CASE("opens a recording written elsewhere than its mesh, and one moved together with its mesh") {
  const TemporaryFolder folder;
  for (const char* name : {"scenes", "recordings", "moved"}) std::filesystem::create_directory(folder / name);
  write_tet_mesh(folder / "scenes/beam.msh", make_box(Vec3(0.2, 0.1, 0.1), {2, 1, 1}));
  folder.file("scenes/beam.json", test::scene_with(R"({"mesh": {"box": null, "file": "beam.msh"}})"));
  const Scene scene = read_scene(folder / "scenes/beam.json");
  record(folder / "recordings/session.jsonl", scene);
  CHECK(!replay_of(read_scene(folder / "recordings/session.jsonl")).difference);
  record(folder / "scenes/session.jsonl", scene);
  for (const char* name : {"beam.msh", "session.jsonl"})
    std::filesystem::rename(folder / (std::string("scenes/") + name), folder / (std::string("moved/") + name));
  CHECK(!replay_of(read_scene(folder / "moved/session.jsonl")).difference);
}

TEST_CASE("refuses to record over the scene itself or into nowhere") {
  const TemporaryFolder folder;
  const Scene scene = read_scene(folder.file("scene.json", test::scene_with("{}")));
  const std::unique_ptr<World> world = load_world(scene);
  CHECK(says(refusal([&] { Recorder(folder / "scene.json", scene, *world); }), "is read by this run"));
  CHECK(says(refusal([&] { Recorder(folder / "none/r.jsonl", scene, *world); }), "cannot be written"));
  CHECK(text_of(folder / "scene.json") == test::scene_with("{}"));
}

TEST_CASE("plays a scene with a script for its duration, and refuses an event the world refuses") {
  const Scene scene = test::small_scene_with(R"({"events": [{"at": 0.03, "gravity": [0, 1, 0]}]})");
  CHECK(ticks_to_play(scene) == 10);
  CHECK(replay_of(scene).ticks == 10);
  const Scene wrong = test::small_scene_with(
      R"({"events": [{"step": 4, "material": {"region": 77, "law": "stvk", "lambda": 1, "mu": 1}}]})");
  CHECK(refusal([&] { replay_of(wrong); }).find("folder/scene.json: events: step 4: ") == 0);
}

}  // namespace heml::replay_test
