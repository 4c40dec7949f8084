#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <heml/scenario/verify.hpp>
#include <heml/session/session.hpp>
#include <thread>

namespace heml::session_test {

using namespace std::chrono_literals;

namespace {

/// A block fixed at one end, small enough for 1 kHz on any machine.
Scene small_scene() {
  Scene scene;
  scene.file = "small";
  scene.mesh.box = MeshSpec::Box{Vec3(0.1, 0.02, 0.02), Vec3::Zero(), {6, 2, 2}};
  const LameParameters lame = lame_parameters(1e4, 0.3);
  scene.materials = {{std::nullopt, {"neo_hookean", {lame.lambda, lame.mu}, 1000}}};
  BoundaryEntry constrained;
  constrained.where.box = {Vec3(-1, -1, -1), Vec3(1e-6, 1, 1)};
  scene.boundary.push_back(constrained);
  scene.gravity = Vec3(0, -9.81, 0);
  scene.solver.threads = 1;
  scene.solver.continuation = true;
  return scene;
}

/// With ticks that take far less than their 0.1 ms.
Scene fast_scene() {
  Scene scene = small_scene();
  scene.solver.step = 1e-4;
  scene.mesh.box->cells = {2, 1, 1};
  return scene;
}

/// Polls frames until one satisfies `wanted`, for at most 10 s.
template <class Wanted>
const Frame& wait_for(Session& session, const Wanted& wanted) {
  for (int i = 0; i < 2000; ++i) {
    if (wanted(session.latest())) return session.latest();
    std::this_thread::sleep_for(5ms);
  }
  FAIL("the frame waited for never came");
  return session.latest();
}

struct TemporaryFolder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("heml-session-test-" + std::to_string(getpid()));
  TemporaryFolder() { std::filesystem::create_directories(path); }
  ~TemporaryFolder() { std::filesystem::remove_all(path); }
};

}  // namespace

TEST_CASE("frames contain stretches on request") {
  Session session(small_scene(), {});
  wait_for(session, [](const Frame& f) { return f.tick > 20 && f.stretches.empty(); });
  session.enable_stretches(true);
  const Frame& frame = wait_for(session, [](const Frame& f) { return f.tick > 100 && !f.stretches.empty(); });
  CHECK(frame.stretches.size() == frame.surface_mesh->nodes.size());
  CHECK(*std::max_element(frame.stretches.begin(), frame.stretches.end()) > 1.0001f);  // it hangs from one end
  CHECK(frame.values.empty());
  session.show(Field::stretch);
  const Frame& both = wait_for(session, [](const Frame& f) { return !f.values.empty(); });
  CHECK(both.stretches == both.values);
  session.enable_stretches(false);
  wait_for(session, [](const Frame& f) { return f.stretches.empty() && !f.values.empty(); });
}

TEST_CASE("frames contain the solid with the field inside on request") {
  Session session(small_scene(), {});
  wait_for(session, [](const Frame& f) { return f.tick > 20 && !f.solid && f.solid_positions.empty(); });
  session.show(Field::displacement);
  session.enable_solid(true);
  const Frame& frame = wait_for(session, [](const Frame& f) { return f.solid && !f.solid_values.empty(); });
  CHECK(frame.solid->tets.size() == frame.elements);
  REQUIRE(frame.solid_positions.size() == frame.solid->rest.size());
  REQUIRE(frame.solid_values.size() == frame.solid->rest.size());
  for (std::size_t k = 0; k < frame.surface_mesh->nodes.size(); ++k) {
    const auto node = static_cast<std::size_t>(frame.surface_mesh->nodes[k]);
    CHECK(frame.solid_positions[node] == frame.positions[k]);
    CHECK(frame.solid_values[node] == frame.values[k]);
  }
  session.enable_solid(false);
  wait_for(session, [](const Frame& f) { return !f.solid && f.solid_positions.empty() && f.solid_values.empty(); });
}

TEST_CASE("frames contain error estimates on request, without effect on the body") {
  Session session(small_scene(), {});
  wait_for(session, [](const Frame& f) { return f.tick > 20 && !f.mesh_error && !f.time_error; });
  session.enable_errors(true);
  const Frame& frame = wait_for(session, [](const Frame& f) { return f.mesh_error && f.time_error; });
  CHECK(*frame.mesh_error > 0.01);
  CHECK(*frame.mesh_error < 1);
  CHECK(frame.time_error->rms > 0);
  CHECK(frame.time_error->rms < 1e-3);
  session.enable_errors(false);
  wait_for(session, [](const Frame& f) { return !f.mesh_error && !f.time_error; });
}

TEST_CASE("a session steps by itself and publishes what a viewer needs") {
  Session session(small_scene(), {});
  CHECK(session.latest().surface_mesh->nodes.size() > 50);
  CHECK(session.latest().surface_mesh->constrained.size() == 9);
  const Frame& frame = wait_for(session, [](const Frame& f) { return f.tick > 100; });
  CHECK(frame.positions.size() == frame.surface_mesh->nodes.size());
  CHECK(frame.time == doctest::Approx(static_cast<double>(frame.tick) * 1e-3));
  CHECK(frame.energies.potential < 0);
  CHECK(frame.values.empty());
  session.show(Field::displacement);
  const Frame& shown = wait_for(session, [](const Frame& f) { return f.field == Field::displacement; });
  CHECK(shown.values.size() == shown.surface_mesh->nodes.size());
  CHECK(*std::max_element(shown.values.begin(), shown.values.end()) > 1e-4f);
}

TEST_CASE("a viewer that stalls for 50 ms does not stall the engine") {
  Session session(small_scene(), {});
  wait_for(session, [](const Frame& f) { return f.tick > 20; });
  // A stalled engine would do no tick in these 250 ms, a free one up to 250.
  long ticks = 0;
  for (int stall = 0; stall < 5; ++stall) {
    const long before = session.latest().tick;
    std::this_thread::sleep_for(50ms);
    ticks += session.latest().tick - before;
  }
  CHECK(ticks >= 75);
}

TEST_CASE("steps that are too slow slow simulated time, and the pace values report it") {
  SessionOptions options;
  std::atomic<bool> slow{true};
  options.before_tick = [&] {
    if (slow) std::this_thread::sleep_for(5ms);
  };
  Session session(small_scene(), options);
  const auto began = std::chrono::steady_clock::now();
  const Frame& frame = wait_for(session, [](const Frame& f) { return f.tick >= 200; });
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  CHECK(wall >= 200 * 0.005);
  CHECK(frame.pace.slowdown >= 4);
  CHECK_FALSE(frame.pace.keeping_up);
  CHECK(frame.pace.missed >= 100);
  CHECK(frame.pace.p50 >= 0.005);
  // Once steps are fast again, no burst makes up for the 150 ticks lost beyond Pacer::patience.
  slow = false;
  const long before = session.latest().tick;
  std::this_thread::sleep_for(200ms);
  CHECK(session.latest().tick - before <= 200 + 60 + 40);
}

TEST_CASE("pause holds the body, one step is one tick, and commands are taken while paused") {
  SessionOptions options;
  options.start_paused = true;
  Session session(small_scene(), options);
  CHECK(wait_for(session, [](const Frame& f) { return f.paused; }).tick == 0);
  session.step_once();
  wait_for(session, [](const Frame& f) { return f.tick == 1; });
  std::this_thread::sleep_for(30ms);
  CHECK(session.latest().tick == 1);
  session.post(Grasp{30, 0.01});
  CHECK(wait_for(session, [](const Frame& f) { return find_tool<GraspState>(f.tools) != nullptr; }).tools.size() == 1);
  session.play();
  wait_for(session, [](const Frame& f) { return f.tick > 50 && !f.paused; });
  session.pause();
  wait_for(session, [](const Frame& f) { return f.paused; });
  session.post(Reset{});
  CHECK(wait_for(session, [](const Frame& f) { return f.time == 0; }).tick > 50);
}

TEST_CASE("a frame tells whether it shows all that was posted and asked for, played or paused") {
  SessionOptions options;
  options.start_paused = true;
  Session session(small_scene(), options);
  const auto answered = [&](const Frame& f) { return session.has_answered(f); };
  for (const bool playing : {false, true}) {
    CAPTURE(playing);
    if (playing) session.play();
    const Frame before = wait_for(session, [&](const Frame& f) { return answered(f) && f.paused != playing; });
    session.post(Grasp{30, 0.01});
    session.post(MoveTool{Vec3(0.2, 0, 0)});
    CHECK_FALSE(answered(before));
    const Frame grasped = wait_for(session, answered);
    CHECK(grasped.tools.size() == 1);
    CHECK(grasped.commands >= before.commands + 2);
    session.post(Release{});
    session.show(playing ? Field::stretch : Field::displacement);
    CHECK_FALSE(answered(grasped));
    const Frame& shown = wait_for(session, answered);
    CHECK(shown.tools.empty());
    CHECK_FALSE(shown.values.empty());
    session.post(Grasp{-1, 0.01});  // refused, which is an answer too
    CHECK(wait_for(session, answered).refusals == (playing ? 2 : 1));
  }
}

TEST_CASE("a frame of a tick under way when a command came does not count as its answer") {
  std::atomic<bool> in_tick{false};
  std::atomic<int> allowed{0};
  SessionOptions options;
  options.before_tick = [&] {
    in_tick = true;
    for (int wait = 0; allowed == 0 && wait < 5000; ++wait) std::this_thread::sleep_for(2ms);
    --allowed;
  };
  Session session(small_scene(), options);
  for (int wait = 0; !in_tick && wait < 5000; ++wait) std::this_thread::sleep_for(2ms);
  session.post(Grasp{30, 0.01});
  std::this_thread::sleep_for(20ms);  // a frame is due after the tick
  allowed = 1;
  const Frame& before = wait_for(session, [](const Frame& f) { return f.tick == 1; });
  CHECK(before.tools.empty());
  CHECK_FALSE(session.has_answered(before));
  allowed = 1'000'000;
  CHECK(wait_for(session, [&](const Frame& f) { return session.has_answered(f); }).tools.size() == 1);
}

TEST_CASE("removed elements leave the frames' surface mesh, and a reset brings them back") {
  SessionOptions options;
  options.start_paused = true;
  Session session(small_scene(), options);
  const auto whole = session.latest().surface_mesh;
  session.post(RemoveElements{{{}, {}, std::array{Vec3(0.08, -1, -1), Vec3(1, 1, 1)}, {}}});
  const Frame& frame = wait_for(session, [&](const Frame& f) { return f.surface_mesh != whole; });
  CHECK(frame.surface_mesh->nodes.size() == whole->nodes.size() - 9 + 1);  // −9 at the end, +1 newly exposed
  CHECK(frame.positions.size() == frame.surface_mesh->nodes.size());
  CHECK(frame.removed == 20);
  CHECK(frame.surface_mesh->whole == whole);
  for (const Vec3f& X : frame.surface_mesh->rest) CHECK(X.x() < 0.085f);
  for (const auto& triangle : frame.surface_mesh->triangles)
    for (const int n : triangle) CHECK(static_cast<std::size_t>(n) < frame.surface_mesh->nodes.size());
  const long version = frame.surface_mesh->version;
  session.post(Reset{});
  const Frame& after = wait_for(session, [&](const Frame& f) { return f.surface_mesh->version > version; });
  CHECK(after.surface_mesh->nodes == whole->nodes);
  CHECK(after.surface_mesh->triangles == whole->triangles);
  CHECK_FALSE(after.surface_mesh->whole);
  CHECK(after.removed == 0);
}

TEST_CASE("a recovery is told to the viewer, with a file that shows it again, and recorded to the bit") {
  const TemporaryFolder folder;
  Scene scene = small_scene();
  scene.solver.recovery = true;
  scene.solver.damping = 20;
  SessionOptions options;
  options.recovery_file = folder.path / "made" / "recovery.jsonl";
  options.record = folder.path / "session.jsonl";
  {
    Session session(scene, options);
    session.post(SetGravity{Vec3(-40000, 0, 0)});
    wait_for(session, [](const Frame& f) { return f.recovery.has_value(); });
    session.post(SetGravity{Vec3::Zero()});
    const Frame& frame = wait_for(session, [](const Frame& f) { return f.recovery && f.recovery->ended; });
    CHECK(frame.recovery_file == options.recovery_file.string());
    CHECK(frame.halted.empty());
  }
  for (const std::filesystem::path& file : {options.recovery_file, *options.record}) {
    const Scene recording = read_scene(file);
    CHECK(recording.events.size() >= 2);
    const auto world = load_world(recording);
    const ReplayResult result = replay(recording, *world);
    CHECK(result.checkpoints >= 1);
    CHECK_FALSE(result.difference);
    REQUIRE(world->recovery());
    CHECK(world->recovery()->ended);
  }
}

TEST_CASE("a recorded session replays to the same hashes, with one thread and with two") {
  TemporaryFolder folder;
  const auto file = folder.path / "session.jsonl";
  {
    SessionOptions options;
    options.record = file;
    Session session(small_scene(), options);
    wait_for(session, [](const Frame& f) { return f.tick > 100; });
    session.post(Grasp{20, 0.012});
    for (int i = 0; i < 20; ++i) {
      session.post(MoveTool{Vec3(0.05 + 0.001 * i, 0.01, 0.01)});
      std::this_thread::sleep_for(10ms);
    }
    session.post(SetMaterial{std::nullopt, {"stvk", {6e3, 4e3}, 900}});
    session.post(SetDamping{3});
    session.post(SetIntegrator{Integrator::symplectic_euler});
    const long now = session.latest().tick;
    wait_for(session, [&](const Frame& f) { return f.tick > now + 600; });
    session.post(Release{});
    session.post(Reset{});
    wait_for(session, [&](const Frame& f) { return f.tick > now + 900; });
  }
  std::ifstream lines(file);
  std::string line, last;
  while (std::getline(lines, line)) last = line;
  CHECK(last.find("\"end\"") != std::string::npos);
  for (const int threads : {1, 2}) {
    Scene scene = read_scene(file);
    CHECK(scene.events.size() >= 8);
    CHECK(scene.checkpoints.size() >= 3);
    scene.solver.threads = threads;
    const auto world = load_world(scene);
    const ReplayResult result = replay(scene, *world);
    CHECK(result.checkpoints >= 3);
    CHECK_FALSE(result.difference);
    CHECK_FALSE(result.halt);
  }
  // The comparison can fail: another material gives another motion.
  Scene changed = read_scene(file);
  changed.materials[0].material.parameters[1] *= 1.0000001;
  const auto world = load_world(changed);
  CHECK(replay(changed, *world).difference);
}

TEST_CASE("after a removal another thread builds a new factor, and its adoption is recorded") {
  TemporaryFolder folder;
  const auto file = folder.path / "removal.jsonl";
  const auto recorded = [&] {
    std::ifstream lines(file);
    return std::string(std::istreambuf_iterator<char>(lines), {});
  };
  {
    Scene scene = small_scene();
    scene.mesh.box->cells = {20, 5, 5};
    scene.solver.integrator = Integrator::backward_euler;
    scene.solver.step = 0.01;
    scene.solver.budget = Budget{1, 0};
    SessionOptions options;
    options.record = file;
    Session session(scene, options);
    wait_for(session, [](const Frame& f) { return f.tick > 2; });
    for (const double x : {0.09, 0.08, 0.07}) {  // some during a build
      RemoveElements removal;
      removal.which.box = {Vec3(x, -1, -1), Vec3(x + 0.01, 1, 1)};
      session.post(removal);
      std::this_thread::sleep_for(5ms);
    }
    wait_for(session, [&](const Frame&) { return recorded().find("\"factor\"") != std::string::npos; });
    const long now = session.latest().tick;
    wait_for(session, [&](const Frame& f) { return f.tick > now + 10; });
  }
  for (const int threads : {1, 2}) {
    Scene scene = read_scene(file);
    scene.solver.threads = threads;
    const auto world = load_world(scene);
    const ReplayResult result = replay(scene, *world);
    CHECK(result.checkpoints >= 2);
    CHECK_FALSE(result.difference);
    CHECK_FALSE(result.halt);
  }
}

TEST_CASE("a session rewound to an earlier time has its bits and continues in its own recording") {
  const TemporaryFolder folder;
  const auto first = folder.path / "first.jsonl", second = folder.path / "second.jsonl";
  Frame moment, later;
  Scene variant;
  {
    SessionOptions options;
    options.record = first;
    Session session(small_scene(), options);
    session.post(Grasp{20, 0.012});
    for (int i = 0; i < 10; ++i) {
      session.post(MoveTool{Vec3(0.05 + 0.002 * i, 0.01, 0.01)});
      std::this_thread::sleep_for(10ms);
    }
    session.post(SetMaterial{std::nullopt, {"stvk", {6e3, 4e3}, 900}});
    session.pause();
    session.post(Reset{});  // applied while paused, and still before the frame to return to
    moment = wait_for(session, [](const Frame& f) { return f.paused && f.time == 0; });
    CHECK(moment.tick > 50);
    session.play();
    session.post(SetDamping{9});
    later = wait_for(session, [&](const Frame& f) { return f.tick > moment.tick + 100; });
    variant = session.until(moment);
  }
  const auto recorded = read_scene(first);
  {
    SessionOptions options;
    options.record = second;
    options.start_paused = true;
    options.fast_forward_to = moment.tick;
    Session session(variant, options);
    const Frame& reached =
        wait_for(session, [&](const Frame& f) { return f.fast_forward_target == 0 && f.tick == moment.tick; });
    CHECK(reached.paused);
    CHECK(reached.time == moment.time);
    CHECK(reached.commands == moment.commands);
    CHECK(reached.positions == moment.positions);
    CHECK(reached.tools.size() == moment.tools.size());
    session.post(SetGravity{Vec3(0, 5, 0)});
    session.play();
    wait_for(session, [&](const Frame& f) { return f.tick > moment.tick + 600; });
  }
  const Scene branch = read_scene(second);
  CHECK(static_cast<long>(branch.events.size()) == moment.commands + 1);
  CHECK(std::holds_alternative<SetGravity>(branch.events.back().command));
  const auto world = load_world(branch);
  const ReplayResult result = replay(branch, *world);
  CHECK(result.checkpoints >= 3);
  CHECK_FALSE(result.difference);
  const Scene untouched = read_scene(first);
  CHECK(untouched.events.size() == recorded.events.size());
  CHECK(untouched.recorded_ticks >= later.tick);
}

TEST_CASE("a fast-forward is faster than real time, and a pause ends it early") {
  SessionOptions options;
  options.start_paused = true;
  Session session(fast_scene(), options);
  session.fast_forward_to(2000);
  const Frame& there = wait_for(session, [](const Frame& f) { return f.tick == 2000 && f.fast_forward_target == 0; });
  CHECK(there.paused);
  CHECK(there.pace.missed == 0);
  session.fast_forward_to(100000000);
  wait_for(session, [](const Frame& f) { return f.tick > 2100; });
  session.pause();
  const long tick = wait_for(session, [](const Frame& f) { return f.fast_forward_target == 0; }).tick;
  std::this_thread::sleep_for(50ms);
  CHECK(session.latest().tick <= tick + 1);
}

TEST_CASE("the pace of a fast-forward is that of its own ticks, not of the time before it") {
  SessionOptions options;
  options.start_paused = true;
  Session session(fast_scene(), options);
  std::this_thread::sleep_for(200ms);  // 2000 ticks of real time without one
  session.fast_forward_to(100000000);
  const Frame& frame = wait_for(session, [](const Frame& f) { return f.tick > 10000 && f.fast_forward_target > 0; });
  CHECK(frame.pace.slowdown < 100);  // no ticks of its own: infinite
  CHECK(frame.pace.p50 > 0);
}

TEST_CASE("a fast-forward that is ended early goes on as before, and misses no deadline by it") {
  Session session(fast_scene(), {});
  session.fast_forward_to(100000000);
  wait_for(session, [](const Frame& f) { return f.tick > 10000; });
  session.fast_forward_to(0);
  const Frame& ended = wait_for(session, [](const Frame& f) { return f.fast_forward_target == 0; });
  CHECK_FALSE(ended.paused);
  const long tick = ended.tick;
  CHECK(tick < 100000000);
  wait_for(session, [&](const Frame& f) { return f.tick > tick; });
}

TEST_CASE("during a replay no choice depends on the clock") {
  const TemporaryFolder folder;
  const auto first = folder.path / "budget.jsonl", second = folder.path / "again.jsonl";
  Scene scene = small_scene();
  scene.mesh.box->cells = {20, 5, 5};
  scene.solver.integrator = Integrator::backward_euler;
  scene.solver.step = 0.01;
  scene.solver.budget = Budget{0, 10};
  {
    SessionOptions options;
    options.record = first;
    options.before_tick = [] { std::this_thread::sleep_for(20ms); };  // far beyond the budget, which is then lowered
    Session session(scene, options);
    wait_for(session, [](const Frame& f) { return f.tick > 8; });
  }
  const Scene recorded = read_scene(first);
  CHECK(recorded.events.size() >= 1);
  {
    SessionOptions options;
    options.record = second;
    options.start_paused = true;
    options.fast_forward_to = *recorded.recorded_ticks;
    Session session(recorded, options);
    wait_for(session, [](const Frame& f) { return f.fast_forward_target == 0; });
  }
  const Scene again = read_scene(second);
  REQUIRE(again.events.size() == recorded.events.size());
  for (std::size_t k = 0; k < again.events.size(); ++k)
    CHECK(event_line(again.events[k]) == event_line(recorded.events[k]));
  CHECK(again.checkpoints.back().hash == recorded.checkpoints.back().hash);
}

TEST_CASE("a paused session can be closed at any moment") {
  Scene scene = small_scene();
  scene.mesh.box->cells = {1, 1, 1};
  for (int k = 0; k < 2000; ++k) {
    SessionOptions options;
    options.start_paused = true;
    std::atomic<int> frames{0};
    options.on_frame = [&] { ++frames; };
    const Session session(scene, options);
    while (frames < 2) std::this_thread::yield();  // the engine thread is about to sleep
    for (std::atomic<int> moments = k % 300; moments > 0;) --moments;
  }
}

TEST_CASE("a halted session reports why and can be reset") {
  Scene scene = small_scene();
  scene.solver.continuation = false;
  scene.solver.step = 0.02;  // far beyond the limit
  Session session(scene, {});
  CHECK(wait_for(session, [](const Frame& f) { return !f.halted.empty(); }).halted.find(" at t = ") !=
        std::string::npos);
  session.pause();
  session.post(Reset{});
  CHECK(wait_for(session, [](const Frame& f) { return f.halted.empty(); }).time == 0);
}

TEST_CASE("a reset of the scene tells the settings that hold since, as a step of the history does") {
  Session session(small_scene(), {});
  session.post(SetDamping{7});
  wait_for(session, [](const Frame& f) { return f.undo_list && f.undo_list->past.size() == 1; });
  session.post(Reset{true});
  const Frame& frame = wait_for(session, [](const Frame& f) { return f.undo_list && f.undo_list->past.size() == 2; });
  CHECK(frame.undo_list->steps == 1);
  const auto& settings = frame.undo_list->settings;
  const auto damping = std::find_if(settings.begin(), settings.end(), [](const Command& command) {
    return std::holds_alternative<SetDamping>(command);
  });
  REQUIRE(damping != settings.end());
  CHECK(std::get<SetDamping>(*damping).damping == small_scene().solver.damping);
}

TEST_CASE("a recorded session that halted verifies, after more commands too") {
  const TemporaryFolder folder;
  Scene scene = small_scene();
  scene.solver.continuation = false;
  scene.solver.step = 0.02;  // far beyond the limit
  for (const bool more : {false, true}) {
    SessionOptions options;
    options.record = folder.path / "halted.jsonl";
    {
      Session session(scene, options);
      wait_for(session, [](const Frame& f) { return !f.halted.empty(); });
      if (more) {
        session.post(SetGravity{Vec3(0, 1, 0)});
        session.post(SetDamping{7});
        std::this_thread::sleep_for(50ms);
      }
    }
    const Scene recording = read_scene(*options.record);
    REQUIRE(recording.recorded_end);
    CHECK(recording.recorded_end->halt);
    const auto world = load_world(recording);
    CHECK(verify(recording, replay(recording, *world)).reason == "");
  }
}

TEST_CASE("a session closed in the middle of a tick leaves a recording with its end") {
  const TemporaryFolder folder;
  SessionOptions options;
  options.record = folder.path / "short.jsonl";
  {
    Scene scene = small_scene();
    scene.mesh.box->cells = {60, 12, 12};
    scene.solver.rate = 1;  // a tick takes far longer than the destructor waits
    Session session(scene, options);
    std::this_thread::sleep_for(100ms);
  }
  const Scene recording = read_scene(*options.record);
  REQUIRE(recording.recorded_end);
  CHECK(recording.recorded_end->tick == 0);
  const auto world = load_world(recording);
  CHECK(verify(recording, replay(recording, *world)).reason == "");
}

TEST_CASE("a disk that fills up ends the recording, is told to the viewer, and the session goes on") {
  const TemporaryFolder folder;
  const auto pipe = folder.path / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  std::signal(SIGPIPE, SIG_IGN);  // so that a write fails as on a full disk
  SessionOptions options;
  options.record = pipe;
  std::ifstream reader;
  std::thread opener([&] { reader.open(pipe); });
  Session session(small_scene(), options);
  opener.join();
  CHECK(wait_for(session, [](const Frame& f) { return f.tick > 10; }).recording_problem.empty());
  reader.close();
  const std::string problem =
      wait_for(session, [](const Frame& f) { return !f.recording_problem.empty(); }).recording_problem;
  CHECK(problem.find(pipe.string() + ": cannot be written") == 0);
  const long tick = session.latest().tick;
  wait_for(session, [&](const Frame& f) { return f.tick > tick + 10; });
}

TEST_CASE("undo and redo: frames list the actions, settings come back, and the recording replays") {
  const TemporaryFolder folder;
  const auto recording = folder.path / "undone.jsonl";
  {
    SessionOptions options;
    options.record = recording;
    Session session(small_scene(), options);
    CHECK(!session.latest().undo_list);
    session.post(PinTissue{6, 0});
    wait_for(session, [](const Frame& f) { return f.undo_list && f.undo_list->past.size() == 1; });
    session.post(SetDamping{5});
    const Frame& two = wait_for(session, [](const Frame& f) { return f.undo_list->past.size() == 2; });
    CHECK(two.undo_list->past == std::vector<std::string>{"pin", "damping"});
    const long tick = two.tick;
    session.post(StepHistory{-1});
    const Frame& undone = wait_for(session, [](const Frame& f) { return f.undo_list->steps == 1; });
    CHECK(undone.tick >= tick);
    CHECK(undone.undo_list->future == std::vector<std::string>{"damping"});
    const auto& settings = undone.undo_list->settings;
    const auto damping = std::find_if(settings.begin(), settings.end(), [](const Command& command) {
      return std::holds_alternative<SetDamping>(command);
    });
    REQUIRE(damping != settings.end());
    CHECK(std::get<SetDamping>(*damping).damping == 0);
    CHECK(find_tool<PinState>(undone.tools));
    session.post(StepHistory{-1});
    wait_for(session, [](const Frame& f) { return !find_tool<PinState>(f.tools); });
    session.post(StepHistory{1});
    wait_for(session, [](const Frame& f) { return find_tool<PinState>(f.tools) != nullptr; });
    session.post(StepHistory{1});
    wait_for(session, [](const Frame& f) { return f.undo_list->future.empty(); });
    session.post(StepHistory{1});
    CHECK(wait_for(session, [](const Frame& f) { return f.refusals == 1; }).refusal ==
          "history: there is nothing to redo");
  }
  const Scene recorded = read_scene(recording);
  const auto world = load_world(recorded);
  CHECK(verify(recorded, replay(recorded, *world)).reason == "");
}

}  // namespace heml::session_test
