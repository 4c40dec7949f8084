// Time of an explicit step of three blocks at rest on one another on a table, against that of the same blocks free:
// without table, self-contact and gravity. Ticks of both worlds in turn; microseconds a step, median and minimum.
//
//   ninja -C build/release bench_resting_contact && build/release/tests/bench_resting_contact [SECONDS=5]
#include <cstdio>
#include <cstdlib>
#include <heml/world/world.hpp>
#include <studies/interleaved_timing.hpp>

#include "engine/world/world_support.hpp"

using namespace heml;
using namespace heml::test;

namespace {

constexpr double side = 0.04, settled = 0.5;  // m, s

void add_box(TetMesh& mesh, double height, const std::array<int, 3>& cells, const Vec3& origin) {
  add(mesh, make_box(Vec3(side, height, side), cells), Eigen::Isometry3d(Eigen::Translation3d(origin)));
}

/// As in tests/engine/world/resting_contact_test.cpp.
WorldSetup three_blocks(bool in_contact, bool single) {
  WorldSetup setup;
  setup.mesh = make_box(Vec3(side, side, side), {3, 3, 3});
  add_box(setup.mesh, 0.8 * side, {3, 2, 3}, Vec3(0.002, side, 0.001));
  add_box(setup.mesh, 0.8 * side, {2, 3, 2}, Vec3(0.004, 1.8 * side, 0.002));
  setup.materials = {{std::nullopt, soft("neo_hookean", 2e4)}};
  setup.solver.damping = 20;
  setup.solver.threads = 1;
  setup.solver.single_precision = single;
  if (!in_contact) return setup;
  setup.tables = {{Vec3::Zero(), Vec3::UnitY(), 0.4}};
  setup.self_contact = SelfContactSettings{0.4};
  setup.gravity = Vec3(0, -9.81, 0);
  return setup;
}

void measure(bool single, double seconds) {
  const auto resting = make_world(three_blocks(true, single)), free = make_world(three_blocks(false, single));
  while (resting->time() < settled) resting->tick();
  free->tick();
  const auto times = time_interleaved({[&] { resting->tick(); }, [&] { free->tick(); }}, {seconds, 5, 100000});
  if (resting->halt() || free->halt()) std::exit(1);
  const double each = 1e6 / resting->substeps(), of_free = 1e6 / free->substeps();
  std::printf("%s: in contact %.1f (min %.1f), free %.2f (min %.2f) us a step; ratio %.1f (min %.1f)\n",
              single ? "float" : "double", each * times[0].median, each * times[0].min,
              of_free * times[1].median, of_free * times[1].min,
              each * times[0].median / (of_free * times[1].median), each * times[0].min / (of_free * times[1].min));
  std::printf("  %zu tetrahedra, %d pairs with an impulse in the last step\n", resting->setup().mesh.tets.size(),
              tool_of<SelfContactState>(*resting).contact_count);
}

}  // namespace

int main(int count, char** arguments) {
  const double seconds = count > 1 ? std::atof(arguments[1]) : 5;
  for (const bool single : {false, true}) measure(single, seconds);
}
