// Steps that no element is crushed within.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <heml/world/step_strain.hpp>

#include "world_support.hpp"

namespace heml::step_strain_test {

using namespace heml::test;

namespace {

/// A box whose positions after a step are F times those before; e of the elements at node 0.
double strain_of(const Mat3& F, const Mat3& before = Mat3::Identity()) {
  WorldSetup setup;
  setup.mesh = make_box(Vec3(0.03, 0.02, 0.02), {3, 2, 2});
  setup.materials = {{std::nullopt, soft()}};
  const Model<double> model = make_model<double>(setup);
  std::vector<double> x, y;
  for (const Vec3& X : model.mesh.nodes) {
    const Vec3 a = before * X, b = F * a;
    x.insert(x.end(), a.begin(), a.end());
    y.insert(y.end(), b.begin(), b.end());
  }
  StepStrain<double> strain;
  strain.adopt(model, full_topology(model.mesh), true);
  CHECK(strain.largest({}, true, x.data(), y.data()) == 0);  // all elements are of one size, and nothing touches them
  return strain.largest({0}, true, x.data(), y.data());
}

/// A box, held at one end, that is cut in tick 5 and falls on a table put there in one tick, and on another in a later
/// one.
struct DroppedBox {
  Material material;
  std::array<double, 3> blade;   ///< m
  std::array<double, 2> height;  ///< m, of the tables
  std::array<int, 2> tick;

  std::unique_ptr<World> world() const {
    WorldSetup setup;
    setup.mesh = make_box(Vec3(0.1, 0.02, 0.02), {10, 2, 2});
    setup.materials = {{std::nullopt, material}};
    setup.boundary.push_back({nodes_where(setup.mesh, [](const Vec3& X) { return X.x() < 1e-9; })});
    setup.gravity = Vec3(0, -9.81, 0);
    setup.solver.integrator = Integrator::verlet;
    setup.solver.rate = 60;
    setup.solver.threads = 1;
    return make_world(setup);
  }
  /// The tick from k/60 s on, with what comes before it.
  void run_tick(World& world, int k) const {
    CutTissue cut;
    cut.sweep.blades = {{Vec3(blade[0], -1, -1), Vec3(blade[0], -1, 1)}, {Vec3(blade[1], 1, -1), Vec3(blade[2], 1, 1)}};
    if (k == 5) REQUIRE(world.apply(cut).ok());
    for (std::size_t t = 0; t < 2; ++t)
      if (k == tick[t]) REQUIRE(world.apply(SetTables{{{Vec3(0, height[t], 0), Vec3::UnitY(), 0}}}).ok());
    world.tick();
  }
};

Material fung() { return {"fung_demiray", {2000, 2, 1e5}, 1000}; }

}  // namespace

TEST_CASE("strain of a step: compressed, turned and turned inside out, in closed form") {
  const Mat3 I = Mat3::Identity();
  CHECK(strain_of(I) == 0);
  CHECK(strain_of(Vec3(0.9, 1, 1).asDiagonal()) == doctest::Approx(0.1));
  CHECK(strain_of(Vec3(0.9, 1, 1).asDiagonal(), Vec3(0.5, 1.2, 3).asDiagonal()) == doctest::Approx(0.1));
  CHECK(strain_of(Vec3(-1, 1, 1).asDiagonal()) == doctest::Approx(2));
  const Mat3 turn = Eigen::AngleAxisd(0.3, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  CHECK(strain_of(turn) == doctest::Approx(std::sqrt(2.0) * (1 - std::cos(0.3))));
  // From J = 0.15 to 0.05: measured against J = 0.2.
  CHECK(strain_of(Vec3(1.0 / 3, 1, 1).asDiagonal(), Vec3(0.15, 1, 1).asDiagonal()) == doctest::Approx(0.5));
}

TEST_CASE("slivers of cuts land on tables, explicitly, and none runs away") {
  // Each ran away or was pressed flat where steps were those that the shape before them bears.
  const std::vector<DroppedBox> boxes = {
      {fung(), {0.0494, 0.0681, 0.0438}, {-0.03, -0.022}, {11, 30}},
      {fung(), {0.0394, 0.0341, 0.0458}, {-0.0461, -0.0215}, {14, 33}},
      {fung(), {0.0343, 0.0581, 0.0561}, {-0.0265, -0.0201}, {12, 29}},
      {fung(), {0.0445, 0.0492, 0.0467}, {-0.0388, -0.0191}, {12, 28}},
      {soft("neo_hookean", 6000, 0.45), {0.0528, 0.0621, 0.0325}, {-0.0471, -0.0167}, {15, 35}},
      {soft("neo_hookean", 6000, 0.45), {0.0317, 0.0658, 0.0348}, {-0.045, -0.0196}, {12, 34}}};
  for (const DroppedBox& box : boxes) {
    CAPTURE(box.blade[0]);
    const auto world = box.world();
    double most = 0;
    for (int k = 0; k < 60 && !world->halt(); ++k) {
      box.run_tick(*world, k);
      most = std::max(most, total(world->energies()));
    }
    CHECK_FALSE(world->halt());
    // Nothing but the second table, which lifts what lies on it by 3 cm at most, does work.
    CHECK(most < 0.04 * 9.81 * 0.04);
  }
}

TEST_CASE("a snapshot amid steps that were shortened restores what they go on with") {
  const DroppedBox box{fung(), {0.0494, 0.0681, 0.0438}, {-0.03, -0.022}, {11, 30}};
  constexpr int ticks = 40;
  const auto world = box.world();
  std::vector<std::shared_ptr<const WorldSnapshot>> before;  // each tick
  std::vector<std::uint64_t> after;
  std::vector<long> steps;
  for (int k = 0; k < ticks; ++k) {
    before.push_back(world->snapshot());
    steps.push_back(world->steps());
    box.run_tick(*world, k);
    after.push_back(world->state_hash());
    steps.back() = world->steps() - steps.back();
  }
  CHECK(*std::max_element(steps.begin() + box.tick[0], steps.end()) >= 2 * steps[6]);
  for (int from = box.tick[0]; from < ticks; ++from) {
    CAPTURE(from);
    REQUIRE(world->restore(*before[static_cast<std::size_t>(from)]).ok());
    for (int k = from; k < std::min(ticks, from + 4); ++k) {
      box.run_tick(*world, k);
      CHECK(world->state_hash() == after[static_cast<std::size_t>(k)]);
    }
  }
}

}  // namespace heml::step_strain_test
