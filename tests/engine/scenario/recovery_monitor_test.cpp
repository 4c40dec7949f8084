#include <doctest/doctest.h>

#include <engine/mesh/files.hpp>
#include <engine/scenario/samples.hpp>
#include <heml/scenario/recovery_monitor.hpp>
#include <heml/scenario/replay.hpp>
#include <heml/scenario/solve.hpp>

namespace heml::recovery_monitor_test {
namespace {

/// A box that a short, strong gravity inverts. Saint Venant-Kirchhoff lets it, with any instruction set; a law whose
/// energy grows without bound towards J = 0 fails there or not as round-off decides.
Scene struck_scene() {
  return test::small_scene_with(R"({
    "materials": [{"law": "stvk", "young": 1e4, "poisson": 0.3}],
    "solver": {"rate": 60, "integrator": "backward_euler", "recovery": true, "duration": 2},
    "events": [{"step": 5, "grasp": {"point": [0.2, 0, 0], "radius": 0.01}}, {"step": 6, "release": true},
               {"step": 10, "gravity": [-10000, 0, 0]}, {"step": 12, "gravity": [0, 0, 0]},
               {"step": 119, "damping": 1}]})");
}

}  // namespace

TEST_CASE("solve writes a recovery file that replays to the bit, and no file without a recovery") {
  const TemporaryFolder folder;
  const SolveResult result = solve(struck_scene(), folder / "out");
  REQUIRE_FALSE(result.halt);
  const Scene again = read_scene(folder / "out/recovery.jsonl");
  CHECK(again.events.size() == 4);  // later events are not written
  CHECK(again.checkpoints.size() == 1);
  const std::unique_ptr<World> world = load_world(again);
  const ReplayResult replayed = replay(again, *world);
  CHECK(replayed.checkpoints == 1);
  CHECK_FALSE(replayed.difference);
  REQUIRE(world->recovery());
  CHECK(world->recovery()->tick >= 10);
  REQUIRE(world->recovery()->ended);

  Scene calm = struck_scene();
  calm.events.clear();
  calm.points.clear();
  solve(calm, folder / "out");
  CHECK_FALSE(std::filesystem::exists(folder / "out/recovery.jsonl"));
}

TEST_CASE("the monitor reports the begin and the end of a recovery once each, and nothing after a reset") {
  const Scene scene = struck_scene();
  for (const bool reset : {false, true}) {
    const std::unique_ptr<World> world = load_world(scene);
    RecoveryMonitor watch;
    int begins = 0, ends = 0;
    replay(scene, *world, [&](World& at) {
      const auto news = watch.after_tick(at);
      begins += news == RecoveryMonitor::Change::began;
      ends += news == RecoveryMonitor::Change::ended;
      if (!reset || news != RecoveryMonitor::Change::began) return;
      REQUIRE(at.apply(SetGravity{Vec3::Zero()}).ok());
      REQUIRE(at.apply(Reset{}).ok());
    });
    CHECK(begins == 1);
    CHECK(ends == (reset ? 0 : 1));
  }
}

}  // namespace heml::recovery_monitor_test
