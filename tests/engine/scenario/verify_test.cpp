#include <doctest/doctest.h>
#include <fmt/format.h>

#include <engine/mesh/files.hpp>
#include <engine/scenario/samples.hpp>
#include <heml/scenario/build_identity.hpp>
#include <heml/scenario/recorder.hpp>
#include <heml/scenario/solver_json.hpp>
#include <heml/scenario/verify.hpp>
#include <iterator>

namespace heml::verify_test {
namespace {

/// A box that hangs and is pulled for 20 ticks; its recording has checkpoints at 0, 5, …, 20.
Scene pulled_scene() {
  return test::small_scene_with(R"({"gravity": [0, -9.81, 0], "solver": {"continuation": true, "duration": 0.2},
    "events": [{"step": 7, "grasp": {"node": 11, "radius": 0.05}}, {"step": 8, "move": [0.21, 0.1, 0.1]}]})");
}

/// A box that is pressed flat without continuation of its law: it halts within a tick.
Scene pressed_scene() {
  return test::small_scene_with(R"({
    "materials": [{"law": "neo_hookean", "young": 1e4, "poisson": 0.3}],
    "boundary": [{"box": [[0, -1, -1], [0, 1, 1]], "fix": true},
                 {"box": [[0.199, -1, -1], [1, 1, 1]], "translate": [-0.3, 0, 0], "over": 0.1}],
    "solver": {"duration": 0.2}})");
}

Scene recorded(const Scene& scene, const TemporaryFolder& folder, const std::string& name = "r.jsonl") {
  const std::unique_ptr<World> world = load_world(scene);
  Recorder recorder(folder / name, scene, *world, 5);
  replay(scene, *world, {}, &recorder);
  return read_scene(folder / name);
}

Verification verified(const Scene& scene, bool partial = false) {
  const std::unique_ptr<World> world = load_world(scene);
  return verify(scene, replay(scene, *world), partial);
}

/// The recording as format 1 stores it.
Scene of_format_1(Scene recording) {
  recording.recorded_by = {};
  recording.recorded_end = RecordedEnd{recording.recorded_end->tick, {}, {}, {}, {}};
  return recording;
}

}  // namespace

TEST_CASE("a recording says its format, who made it, and how it ended") {
  const TemporaryFolder folder;
  const Scene recording = recorded(pulled_scene(), folder);
  CHECK(recording.recorded_by.format == 2);
  CHECK(recording.recorded_by.kernel_revision == kernel_revision);
  CHECK(recording.recorded_by.build == build_name());
  REQUIRE(recording.recorded_end);
  CHECK(recording.recorded_end->tick == 20);
  CHECK(recording.recorded_end->checkpoints == 5);
  CHECK(recording.recorded_end->hash == recording.checkpoints.back().hash);
  CHECK_FALSE(recording.recorded_end->halt);
  const Verification verification = verified(recording);
  CHECK(verification.passed);
  CHECK(verification.reason.empty());
  CHECK(verification.warning.empty());
}

TEST_CASE("a recording of every element verifies, with contact and recoveries, whatever the threads") {
  for (const std::string_view element : element_names)
    for (const std::string integrator : {"verlet", "tr_bdf2"}) {
      CAPTURE(std::string(element));
      CAPTURE(integrator);
      Scene scene = test::small_scene_with(fmt::format(R"({{"gravity": [0, -9.81, 0],
        "materials": [{{"law": "neo_hookean_iso", "K1": 2e3, "kappa": 4e4}}],
        "solver": {{"element": "{}", "integrator": "{}", "duration": 0.25, "recovery": true}},
        "tables": [{{"point": [0, -0.01, 0], "normal": [0, 1, 0]}}], "self_contact": {{"friction": 0.3}},
        "events": [{{"step": 3, "pin": {{"node": 11, "radius": 0.05}}}}, {{"step": 6, "history": -1}},
                   {{"step": 7, "grasp": {{"node": 11, "radius": 0.05}}}}, {{"step": 8, "move": [0.21, 0.1, 0.1]}},
                   {{"step": 10, "cut": {{"sweep": [[[0.13, -1, -1], [0.13, -1, 1]], [[0.13, 1, -1], [0.13, 1, 1]]]}}}},
                   {{"step": 12, "remove": {{"tets": [1]}}}}, {{"step": 13, "undo": true}},
                   {{"step": 14, "release": true}}, {{"step": 15, "gravity": [1e5, 0, 0]}},
                   {{"step": 18, "gravity": [0, -9.81, 0]}}]}})",
                                                       element, integrator));
      const std::unique_ptr<World> world = load_world(scene);
      replay(scene, *world);
      if (integrator == "verlet") CHECK(world->recoveries() > 0);  // implicit ticks may be rescued instead
      for (const int threads : {1, 3}) {
        scene.solver.threads = threads;
        const TemporaryFolder folder;
        Scene recording = recorded(scene, folder);
        for (const int others : {1, 3}) {
          recording.solver.threads = others;
          CHECK(verified(recording).passed);
        }
      }
    }
}

TEST_CASE("whatever is altered, dropped or moved in a recording is noticed") {
  const TemporaryFolder folder;
  const Scene whole = recorded(pulled_scene(), folder);
  const auto reason = [&](const auto& alter) {
    Scene recording = whole;
    alter(recording);
    const Verification verification = verified(recording);
    CHECK(verification.passed == verification.reason.empty());
    return verification.reason;
  };
  CHECK(reason([](Scene&) {}) == "");
  CHECK(says(reason([](Scene& r) { r.checkpoints[2].hash ^= 1; }), "differs at step 10: state"));
  CHECK(says(reason([](Scene& r) { r.checkpoints[2].nodes[3] ^= 1; }), "differs at step 10, node 3"));
  CHECK(says(reason([](Scene& r) { r.checkpoints[2].nodes.pop_back(); }), "differs at step 10, node 11"));
  CHECK(says(reason([](Scene& r) { r.checkpoints.erase(r.checkpoints.begin() + 2); }),
                   "4 checkpoints, and its end tells of 5"));
  CHECK(says(reason([](Scene& r) { r.checkpoints.clear(); }), "no checkpoint"));
  CHECK(says(reason([](Scene& r) { *r.recorded_end->hash ^= 1; }), "differs at step 20"));
  CHECK(says(reason([](Scene& r) { r.recorded_end->hash.reset(); }), "lacks"));
  CHECK(says(reason([](Scene& r) { r.recorded_end->checkpoints.reset(); }), "lacks"));
  CHECK(says(reason([](Scene& r) { r.recorded_end.reset(); }), "no end record"));
  CHECK(says(reason([](Scene& r) { r.recorded_end->halt = "unstable"; }), "did not stop at step 20"));
  CHECK(says(reason([](Scene& r) { r.events.push_back({21, Release{}}); }), "event of step 21"));
  CHECK(says(reason([](Scene& r) { r.recorded_by.kernel_revision = 0; }), "kernel revision 0"));
  CHECK(says(reason([](Scene& r) {
                     r.recorded_by.build = "GCC 1";
                     r.checkpoints[1].hash ^= 1;
                   }),
                   "another build (GCC 1; this is"));
  CHECK(reason([](Scene& r) { r.recorded_by.build = "GCC 1"; }) == "");
  const auto end_at = [](Scene& r, long tick, std::uint64_t hash) {
    r.recorded_ticks = r.recorded_end->tick = tick;
    r.recorded_end->hash = hash;
  };
  CHECK(says(reason([&](Scene& r) { end_at(r, 10, r.checkpoints[2].hash); }),
                   "checkpoint of step 20, after its end"));
}

TEST_CASE("a recording that was cut short verifies as far as it goes when that is asked for") {
  const TemporaryFolder folder;
  Scene recording = recorded(pulled_scene(), folder);
  recording.recorded_end.reset();
  recording.checkpoints.resize(3);
  recording.recorded_ticks = 10;
  CHECK_FALSE(verified(recording).passed);
  CHECK(verified(recording, true).passed);
  recording.checkpoints[2].hash ^= 1;
  CHECK_FALSE(verified(recording, true).passed);
}

TEST_CASE("a recording of format 1 verifies with a warning where its checkpoints are evenly spaced up to its end") {
  const TemporaryFolder folder;
  const Scene whole = of_format_1(recorded(pulled_scene(), folder));
  CHECK(verified(whole).passed);
  CHECK(says(verified(whole).warning, "format 1"));
  const auto passes_with = [&](const std::vector<std::size_t>& kept, long end) {
    Scene recording = whole;
    recording.checkpoints.clear();
    for (const std::size_t k : kept) recording.checkpoints.push_back(whole.checkpoints[k]);
    recording.recorded_ticks = recording.recorded_end->tick = end;
    return verified(recording).passed;
  };
  CHECK(passes_with({0, 1, 2, 3, 4}, 20));
  CHECK(passes_with({0, 2, 4}, 20));
  CHECK(passes_with({4}, 20));              // recording of a recovery
  CHECK(passes_with({0, 2, 3}, 15));        // last interval shorter
  CHECK_FALSE(passes_with({0, 1, 2}, 20));  // second half dropped
  CHECK_FALSE(passes_with({0, 1, 3, 4}, 20));
  CHECK_FALSE(passes_with({1, 2, 3, 4}, 20));
  CHECK_FALSE(passes_with({0}, 20));
  CHECK_FALSE(passes_with({0, 1, 2, 3, 4}, 10));
  Scene without_end = whole;
  without_end.recorded_end.reset();
  CHECK_FALSE(verified(without_end).passed);

  // A recording whose last tick had a command, which changed the state before the checkpoint at the end.
  Scene on_command = whole;
  on_command.checkpoints.resize(4);
  on_command.recorded_ticks = on_command.recorded_end->tick = 18;
  CHECK_FALSE(verified(on_command).passed);
  on_command.events.push_back({18, Reset{}});
  CHECK(verified(on_command).passed);
}

TEST_CASE("a halt is part of a recording, is shown again and verifies, another one does not") {
  const TemporaryFolder folder;
  const Scene recording = recorded(pressed_scene(), folder);
  REQUIRE(recording.recorded_end);
  REQUIRE(recording.recorded_end->halt);
  CHECK(recording.recorded_end->tick < 20);
  const std::unique_ptr<World> world = load_world(recording);
  const ReplayResult played = replay(recording, *world);
  REQUIRE(played.halt);
  CHECK(played.ticks == recording.recorded_end->tick);
  CHECK(played.halt->message == *recording.recorded_end->halt);
  CHECK_FALSE(played.difference);
  CHECK(verify(recording, played).passed);

  Scene other = recording;
  other.recorded_end->halt = "unstable";
  CHECK(says(verified(other).reason, "recorded at step"));
  other = recording;
  other.recorded_end->hash = *other.recorded_end->hash ^ 1;
  CHECK(says(verified(other).reason, "differs at step"));

  // A recording whose halt is taken out is noticed; one that was ended before the tick that would halt verifies.
  other = recording;
  other.recorded_end->halt.reset();
  other.recorded_ticks = other.recorded_end->tick;
  CHECK(says(verified(other).reason, "says that the run halted, and not why"));
  other.recorded_end->halted = false;
  CHECK(verified(other).passed);

  // Recording the replay gives the same recording.
  const Scene again = recorded(recording, folder, "again.jsonl");
  CHECK(again.recorded_end->halt == recording.recorded_end->halt);
  CHECK(verified(again).passed);
}

TEST_CASE("commands to a world that has halted count from a reset on, and else not at all") {
  const TemporaryFolder folder;
  const Scene scene = pressed_scene();
  for (const bool reset : {false, true}) {
    const std::unique_ptr<World> world = load_world(scene);
    Recorder recorder(folder / "r.jsonl", scene, *world, 5);
    const auto command = [&](const Command& given) {
      REQUIRE(world->apply(given).ok());
      recorder.command(*world, given);
    };
    while (!world->halt()) {
      world->tick();
      recorder.ticked(*world);
    }
    command(SetGravity{Vec3(0, -5, 0)});
    if (reset) {
      command(Reset{});
      for (int k = 0; k < 2; ++k) {
        world->tick();
        recorder.ticked(*world);
      }
      REQUIRE_FALSE(world->halt());
    }
    recorder.end(*world);
    const Scene recording = read_scene(folder / "r.jsonl");
    CHECK(recording.events.size() == (reset ? 2 : 0));
    CHECK(recording.recorded_end->halt.has_value() == !reset);
    CHECK(verified(recording).reason == "");
  }
}

TEST_CASE("a recorder says when its file takes no more, once") {
  const Scene scene = pulled_scene();
  const std::unique_ptr<World> world = load_world(scene);
  CHECK(says(refusal([&] { Recorder(std::filesystem::path("/dev/full"), scene, *world); }),
                   "/dev/full: cannot be written: No space left"));
}

}  // namespace heml::verify_test
