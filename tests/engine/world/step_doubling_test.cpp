// The gauge of time errors, held against errors that are known.
#include <doctest/doctest.h>

#include <cmath>
#include <heml/world/step_doubling.hpp>

#include "world_support.hpp"

namespace heml::step_doubling_test {

using namespace heml::test;

namespace {

/// A beam that is let go.
WorldSetup beam(Integrator integrator, std::optional<double> step) {
  WorldSetup setup;
  setup.mesh = make_box(Vec3(0.1, 0.02, 0.02), {5, 1, 1});
  setup.materials = {{std::nullopt, Material{"neo_hookean", {6e3, 4e3}}}};
  Boundary constrained;
  for (std::size_t n = 0; n < setup.mesh.nodes.size(); ++n)
    if (setup.mesh.nodes[n].x() < 1e-9) constrained.nodes.push_back(static_cast<int>(n));
  setup.boundary = {constrained};
  setup.gravity = Vec3(0, -9.81, 0);
  setup.solver.integrator = integrator;
  setup.solver.step = step;
  setup.solver.threads = 1;
  return setup;
}

constexpr double stretch = 0.1;  // s

double rms(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double sum = 0;
  for (std::size_t n = 0; n < a.size(); ++n) sum += (a[n] - b[n]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(a.size()));
}

/// Runs a world and its shadow; at half time the tool moves.
std::optional<TimeError> shadowed(World& world, bool grasps) {
  StepDoublingEstimator shadow(world.setup());
  if (grasps) world.apply(Grasp{5, 0.01});
  if (!shadow.begin(world)) return std::nullopt;
  bool moved = !grasps;
  while (world.time() < stretch * (1 - 1e-9)) {
    if (!moved && world.time() >= stretch / 2) {
      const MoveTool move{tool_of<GraspState>(world).grip + Vec3(0, 0.01, 0.005)};
      world.apply(move);
      shadow.move(move);
      moved = true;
    }
    world.tick();
    shadow.ticked(world);
  }
  return shadow.error(world.positions());
}

}  // namespace

TEST_CASE("step doubling estimates the error of steps within a factor of two") {
  for (const bool grasps : {false, true}) {
    const auto fine = make_world(beam(Integrator::verlet, 2e-5));
    shadowed(*fine, grasps);
    for (const Integrator integrator :
         {Integrator::backward_euler, Integrator::bdf2, Integrator::tr_bdf2, Integrator::verlet}) {
      CAPTURE(integrator_name(integrator));
      CAPTURE(grasps);
      const auto world = make_world(beam(integrator, integrator == Integrator::verlet ? 1e-3 : 5e-3));
      const auto error = shadowed(*world, grasps);
      REQUIRE(error);
      const double effectivity = error->rms / rms(world->positions(), fine->positions());
      CAPTURE(effectivity);
      CHECK(effectivity > 0.5);
      CHECK(effectivity < 2);
      CHECK(error->max >= error->rms);
      CHECK(error->interval == doctest::Approx(stretch));
    }
  }
}

TEST_CASE("step doubling changes no bit of the run") {
  const auto followed = make_world(beam(Integrator::verlet, {})), alone = make_world(beam(Integrator::verlet, {}));
  shadowed(*followed, false);
  while (alone->time() < stretch * (1 - 1e-9)) alone->tick();
  CHECK(followed->state_hash() == alone->state_hash());
}

TEST_CASE("step doubling declines internal state, another precision, a cut body and statics") {
  WorldSetup viscous = beam(Integrator::verlet, {});
  viscous.materials[0].material.viscosity = 10;
  CHECK_FALSE(StepDoublingEstimator(viscous).begin(*make_world(viscous)));
  WorldSetup single = beam(Integrator::verlet, {});
  single.solver.single_precision = true;
  CHECK_FALSE(StepDoublingEstimator(beam(Integrator::verlet, {})).begin(*make_world(single)));
  const auto removed = make_world(beam(Integrator::verlet, {}));
  REQUIRE(removed->apply(RemoveElements{{.tets = {3}, .region = {}, .box = {}, .sphere = {}}}).ok());
  CHECK_FALSE(StepDoublingEstimator(beam(Integrator::verlet, {})).begin(*removed));
  const WorldSetup still = beam(Integrator::static_equilibrium, {});
  CHECK_FALSE(StepDoublingEstimator(still).begin(*make_world(still)));
}

TEST_CASE("a world's estimate of its mesh falls with the mesh, and nets of springs have none") {
  double before = 1;
  for (const int cells : {2, 4}) {
    WorldSetup setup = beam(Integrator::static_equilibrium, {});
    setup.mesh = make_box(Vec3(0.1, 0.02, 0.02), {5 * cells, cells, cells});
    setup.boundary[0].nodes.clear();
    for (std::size_t n = 0; n < setup.mesh.nodes.size(); ++n)
      if (setup.mesh.nodes[n].x() < 1e-9) setup.boundary[0].nodes.push_back(static_cast<int>(n));
    setup.gravity *= 0.1;
    const auto world = make_world(setup);
    world->load_to(1);
    const auto estimate = world->error_estimate();
    REQUIRE(estimate);
    CHECK(estimate->of_element.size() == setup.mesh.tets.size());
    CHECK(estimate->relative() < 0.8 * before);
    before = estimate->relative();
    std::vector<int> nodes(setup.mesh.nodes.size());
    for (std::size_t n = 0; n < nodes.size(); ++n) nodes[n] = static_cast<int>(n);
    std::vector<float> values;
    world->write_field(Field::error, nodes, values);
    CHECK(*std::max_element(values.begin(), values.end()) > estimate->relative());
  }
  CHECK(before < 0.4);
  WorldSetup net = beam(Integrator::verlet, {});
  net.materials = {{std::nullopt, Material{"mass_spring", {10}}}};
  CHECK_FALSE(make_world(net)->error_estimate());
}

}  // namespace heml::step_doubling_test
