#include <doctest/doctest.h>

#include <heml/mesh/weld.hpp>
#include <heml/session/skin_split.hpp>
#include <map>
#include <numeric>

#include "skinned_body.hpp"

namespace heml::skin_split_test {
namespace {

using namespace heml::test;

/// A cube's shell, and a rim that runs round it in a plane, the ends of its edges at random.
struct Ringed {
  TriangleMesh shell = SkinnedBody::shell(SkinnedBody::side + 0.002, 9);
  SurfaceTree tree{shell};
  std::vector<std::uint32_t> same;
  std::vector<std::size_t> first{0};
  std::vector<int> around;
  WoundRim rim;

  explicit Ringed(double x) {
    std::vector<Vec3f> places;
    for (const Vec3& node : shell.nodes) places.push_back(node.cast<float>());
    same = weld(places);
    for (std::size_t v = 0; v < same.size(); ++v) {
      for (std::size_t t = 0; t < shell.triangles.size(); ++t)
        for (const int n : shell.triangles[t])
          if (same[static_cast<std::size_t>(n)] == v) around.push_back(static_cast<int>(t));
      first.push_back(around.size());
    }
    const double side = SkinnedBody::side;
    const std::array<std::array<double, 2>, 4> corners{{{0, 0}, {side, 0}, {side, side}, {0, side}}};
    for (std::size_t k = 0; k < 4; ++k)
      for (int i = 0; i < 7; ++i) {
        const double at = i == 0 ? 0 : (i + 0.3 * std::sin(i + 5.0 * static_cast<double>(k))) / 7;
        const auto &a = corners[k], &b = corners[(k + 1) % 4];
        const Vec3 place(x + 0.001 * std::sin(3.0 * i), a[0] + at * (b[0] - a[0]), a[1] + at * (b[1] - a[1]));
        Vec3 normal = place - Vec3(place.x(), side / 2, side / 2);
        if (i > 0) normal = Vec3(0, b[1] - a[1], a[0] - b[0]);  // outward of a side, and of both at a corner
        rim.nodes.push_back({place, normal.normalized()});
      }
    for (int n = 0; n < 28; ++n) rim.edges.push_back({{std::min(n, (n + 1) % 28), std::max(n, (n + 1) % 28)}, {7, 9}});
  }
};

}  // namespace

TEST_CASE("a line round a shell divides its triangles without a gap, in two") {
  for (const double x : {0.031, 0.04, 0.0448}) {
    const Ringed ringed(x);
    const TriangleMesh& shell = ringed.shell;
    const SplitSkin split = split_along(ringed.rim, {ringed.tree, ringed.same, ringed.first, ringed.around}, 0.002);
    REQUIRE(split.points.size() > 30);
    TriangleMesh divided{shell.nodes, {}, ""};
    for (const SplitSkin::Point& point : split.points) divided.nodes.push_back(point.place);
    std::vector<char> is_divided(shell.triangles.size(), 0);
    for (const SplitSkin::Part& part : split.parts) {
      is_divided[static_cast<std::size_t>(part.triangle)] = 1;
      divided.triangles.push_back(part.corners);
      const Triangle& base = shell.triangles[static_cast<std::size_t>(part.triangle)];
      for (std::size_t k = 0; k < 3; ++k) {
        Vec3 sum = Vec3::Zero();
        for (std::size_t i = 0; i < 3; ++i) {
          CHECK(part.weights[k][static_cast<int>(i)] > -1e-9);
          sum += part.weights[k][static_cast<int>(i)] * shell.nodes[static_cast<std::size_t>(base[i])];
        }
        CHECK((sum - divided.nodes[static_cast<std::size_t>(part.corners[k])]).norm() < 1e-12);
      }
    }
    for (std::size_t t = 0; t < shell.triangles.size(); ++t)
      if (!is_divided[t]) divided.triangles.push_back(shell.triangles[t]);
    CHECK(area(divided) == doctest::Approx(area(shell)).epsilon(1e-12));
    // Every edge has a face on either side; without the edges along the rim there are two shells.
    std::map<std::array<int, 2>, int> faces;
    for (std::size_t t = 0; t < divided.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
        faces[{divided.triangles[t][k], divided.triangles[t][(k + 1) % 3]}] = static_cast<int>(t);
    std::vector<std::size_t> part_of(divided.triangles.size());
    std::iota(part_of.begin(), part_of.end(), std::size_t{0});
    const auto root = [&](std::size_t t) {
      while (part_of[t] != t) t = part_of[t];
      return t;
    };
    const int first = static_cast<int>(shell.nodes.size());
    for (const auto& [edge, face] : faces) {
      const auto other = faces.find({edge[1], edge[0]});
      REQUIRE(other != faces.end());
      const auto along = split.along_rim.find({edge[0] - first, edge[1] - first});
      if (along == split.along_rim.end()) {
        part_of[root(static_cast<std::size_t>(face))] = root(static_cast<std::size_t>(other->second));
      } else {
        const std::array both{along->second, split.along_rim.at({edge[1] - first, edge[0] - first})};
        CHECK((both == std::array{7, 9} || both == std::array{9, 7}));
      }
    }
    std::size_t parts = 0;
    for (std::size_t t = 0; t < part_of.size(); ++t) parts += part_of[t] == t;
    CHECK(parts == 2);
  }
}

}  // namespace heml::skin_split_test
