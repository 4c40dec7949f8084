// Time of an explicit step of three blocks at rest on one another on a table, against that of the same blocks free:
// without table, self-contact and gravity. Ticks of both worlds in turn; microseconds a step, median and minimum.
//
//   ninja -C build/release bench_resting_contact && build/release/tests/bench_resting_contact [SECONDS=5]
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <heml/world/world.hpp>

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

/// Times of a step, s, in the order of their size.
struct Steps {
  std::vector<double> all;

  /// Of `ticks` ticks.
  void sample(World& world, int ticks) {
    const auto began = std::chrono::steady_clock::now();
    const long before = world.steps();
    for (int k = 0; k < ticks; ++k) world.tick();
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - began;
    all.push_back(passed.count() / static_cast<double>(world.steps() - before));
  }
  double microseconds(double part) const { return 1e6 * all[static_cast<std::size_t>(part * (all.size() - 1.0))]; }
};

void measure(bool single, double seconds) {
  const auto resting = make_world(three_blocks(true, single)), free = make_world(three_blocks(false, single));
  while (resting->time() < settled) resting->tick();
  free->tick();
  Steps with, without;
  const auto began = std::chrono::steady_clock::now();
  while (std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count() < seconds) {
    with.sample(*resting, 30);
    without.sample(*free, 300);
  }
  if (resting->halt() || free->halt()) std::exit(1);
  for (Steps* steps : {&with, &without}) std::sort(steps->all.begin(), steps->all.end());
  const double a = with.microseconds(0.5), a_min = with.microseconds(0), b = without.microseconds(0.5),
               b_min = without.microseconds(0);
  std::printf("%s: in contact %.1f (min %.1f), free %.2f (min %.2f) us a step; ratio %.1f (min %.1f)\n",
              single ? "float" : "double", a, a_min, b, b_min, a / b, a_min / b_min);
  std::printf("  %zu tetrahedra, %d pairs with an impulse in the last step\n", resting->setup().mesh.tets.size(),
              tool_of<SelfContactState>(*resting).contact_count);
}

}  // namespace

int main(int count, char** arguments) {
  const double seconds = count > 1 ? std::atof(arguments[1]) : 5;
  for (const bool single : {false, true}) measure(single, seconds);
}
