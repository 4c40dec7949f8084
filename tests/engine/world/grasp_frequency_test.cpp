// How stiff a grasp is: by the tissue that it holds.
#include <algorithm>

#include "state_support.hpp"

namespace heml::grasp_frequency_test {

using namespace heml::test;

namespace {

constexpr double pull = 1e-4;  // m

Material with_young(double young) { return soft("neo_hookean", young); }

/// N, of a grasp at a node that is pulled from rest along x.
double force_at(const WorldSetup& setup, int node, double radius = 0.012) {
  const auto world = make_world(setup);
  REQUIRE(world->apply(Grasp{node, radius}).ok());
  const Vec3 place = world->positions()[static_cast<std::size_t>(node)];
  REQUIRE(world->apply(MoveTool{place + Vec3(pull, 0, 0)}).ok());
  const auto tools = world->tools();
  return find_grasp(tools, 0)->force.x();
}

/// The half of a bar at its tip has region 2.
WorldSetup halves() {
  WorldSetup setup = bar(with_young(1e4), Integrator::verlet, false);
  setup.boundary.clear();
  for (std::size_t t = 0; t < setup.mesh.tets.size(); ++t) {
    Vec3 centre = Vec3::Zero();
    for (const int n : setup.mesh.tets[t]) centre += setup.mesh.nodes[static_cast<std::size_t>(n)] / 4;
    setup.mesh.regions[t] = centre.x() > 0.03 ? 2 : 1;
  }
  return setup;
}

}  // namespace

TEST_CASE("grasp frequency: entries of materials that no element has do not count, to the bit") {
  WorldSetup setup = halves();
  const double alone = force_at(setup, tip);
  setup.materials.push_back({7, with_young(1e7)});
  CHECK(force_at(setup, tip) == alone);
}

TEST_CASE("grasp frequency: it is that of the tissue round the patch, of several the stiffest") {
  WorldSetup setup = halves();
  const double soft_alone = force_at(setup, tip, 0.016);
  setup.materials = {{1, with_young(1e6)}, {2, with_young(1e4)}};
  CHECK(force_at(setup, tip, 0.016) == doctest::Approx(soft_alone));
  setup.materials = {{1, with_young(1e4)}, {2, with_young(1e6)}};
  CHECK(force_at(setup, tip, 0.016) > 10 * soft_alone);
  CHECK(force_at(setup, 0, 0.016) == doctest::Approx(soft_alone));
  const auto middle = nodes_where(setup.mesh, [](const Vec3& X) { return (X - Vec3(0.03, 0, 0)).norm() < 1e-9; });
  REQUIRE(middle.size() == 1);
  const double across = force_at(setup, middle[0], 0);
  setup.materials = {{std::nullopt, with_young(1e4)}};
  CHECK(across > 10 * force_at(setup, middle[0], 0));
}

}  // namespace heml::grasp_frequency_test
