// Implicit steps whose iterations are few: how far the organ that real time is measured with is from where as many as
// it takes would have it.
#include <doctest/doctest.h>

#include <heml/scenario/scene.hpp>

#include "engine/mesh/files.hpp"
#include "engine/world/world_support.hpp"

namespace heml::few_iterations_test {

using namespace heml::test;

namespace {

/// Where the kidney is that falls into its vessels for a third of a second, m.
std::vector<Vec3> fallen(const Scene& scene, Integrator integrator, std::optional<Budget> budget) {
  WorldSetup setup = load_setup(scene);
  setup.solver.integrator = integrator;
  setup.solver.single_precision = false;
  setup.solver.threads = 1;
  setup.solver.rate = 60;
  setup.solver.budget = budget;
  const auto world = make_world(setup);
  for (int k = 0; k < 20; ++k) world->tick();
  REQUIRE_FALSE(world->halt());
  return world->positions();
}

}  // namespace

TEST_CASE("a kidney of quadratic elements falls into its vessels with one iteration a stage as with many") {
  const Scene scene = read_scene((assets_folder() / "scenes/kidney_adapted.json").string());
  const std::pair<Integrator, double> methods[] = {
      {Integrator::backward_euler, 3e-4}, {Integrator::tr_bdf2, 1e-3}, {Integrator::sdirk2, 2e-3}};
  for (const auto& [integrator, bound] : methods) {
    const std::string method(integrator_name(integrator));
    CAPTURE(method);
    const std::vector<Vec3> many = fallen(scene, integrator, std::nullopt);
    CHECK(rms_difference(fallen(scene, integrator, Budget{1, 0}), many) < bound);  // of 30 mm
  }
}

}  // namespace heml::few_iterations_test
