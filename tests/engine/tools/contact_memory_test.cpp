#include <doctest/doctest.h>

#include <heml/tools/contact_memory.hpp>
#include <vector>

namespace heml::contact_memory_test {
namespace {

/// A node on a plane with normal y.
struct OnPlane {
  std::vector<double> x{0, 0, 0};
  ContactPoint point{{0, 0, 0, 0}, {1, 0, 0, 0}, 1, 0, Vec3::UnitY()};
  ContactAnchor anchor;

  void step(double to, double normal, double friction) {
    x[0] = to;
    anchor.update(point, x.data(), Vec3::Zero(), 0.5, normal, friction);
  }
  double drift() const { return anchor.drift(point, x.data(), Vec3::Zero(), 1e-4).x(); }
};

AnchoredPoint point_at(int node) { return {0, {node, node, node, node}, {{}, Vec3::Zero(), 0, 0, 0}}; }

}  // namespace

TEST_CASE("an anchor stays while friction is below its bound, and draws back along the surface") {
  OnPlane node;
  node.step(0.1, 1, 0.2);
  CHECK(node.drift() == 0);
  node.x[1] = -0.3;
  node.step(0.101, 1, 0.2);
  CHECK(node.drift() == doctest::Approx(0.001 / contact_recovery));
  CHECK(node.anchor.drift(node.point, node.x.data(), Vec3::Zero(), 1).x() == doctest::Approx(0.001));
}

TEST_CASE("an anchor follows a point that slides, and stays where it comes to rest") {
  OnPlane node;
  for (int k = 0; k < 30; ++k) {
    node.step(0.01 * k, 1, 0.5);
    CHECK(node.drift() == 0);
  }
  node.step(0.3, 1, 0.2);
  node.step(0.301, 1, 0.2);
  CHECK(node.drift() > 0);
}

TEST_CASE("a step with little normal impulse is no sliding") {
  OnPlane node;
  for (int k = 0; k < 20; ++k) node.step(0, 1, 0.3);
  node.step(1e-5, 0.001, 0.0005);
  CHECK(node.drift() == doctest::Approx(1e-5 / contact_recovery));
}

TEST_CASE("contacts are remembered for some steps after they left") {
  std::vector<AnchoredPoint> known{point_at(1), point_at(4), point_at(6)};
  for (int k = 0; k < max_idle_steps; ++k) remember(known, {point_at(2), point_at(4)});
  REQUIRE(known.size() == 4);
  CHECK(std::is_sorted(known.begin(), known.end()));
  CHECK(known[0].anchor.idle == max_idle_steps);
  CHECK(known[2].anchor.idle == 0);
  remember(known, {point_at(2)});
  REQUIRE(known.size() == 2);
  CHECK(known[0].nodes[0] == 2);
  CHECK(known[1].nodes[0] == 4);
}

}  // namespace heml::contact_memory_test
