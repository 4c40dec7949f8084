#include <doctest/doctest.h>

#include <heml/session/wound_rim.hpp>

#include "cut_body.hpp"

namespace heml::wound_rim_test {
namespace {

const CutBody& body() {
  static const CutBody made;
  return made;
}

}  // namespace

TEST_CASE("an uncut surface has no rim") {
  const SurfaceMesh& whole = *body().whole;
  const WoundRim rim = wound_rim(whole, std::vector<char>(whole.triangles.size(), 0));
  CHECK(rim.nodes.empty());
  CHECK(rim.edges.empty());
}

TEST_CASE("the rim of a cut is one line on the surface, near the blade, from end to end") {
  const SurfaceMesh& cut = *body().cut;
  const WoundRim rim = wound_rim(cut, OriginalSkin(cut).exposed());
  REQUIRE(rim.edges.size() >= 10);
  CHECK(rim.nodes.size() == rim.edges.size() + 1);
  std::vector<int> at(rim.nodes.size(), 0);
  for (const auto& [nodes, faces] : rim.edges) {
    CHECK(nodes[0] < nodes[1]);
    for (const int n : nodes) ++at[static_cast<std::size_t>(n)];
    // The faces on both sides have the edge, one each way.
    for (std::size_t way = 0; way < 2; ++way) {
      REQUIRE(faces[way] >= 0);
      const Triangle& face = cut.triangles[static_cast<std::size_t>(faces[way])];
      bool has_edge = false;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto place = [&](std::size_t corner) {
          return Vec3(cut.rest[static_cast<std::size_t>(face[corner % 3])].cast<double>());
        };
        has_edge |= place(k) == rim.nodes[static_cast<std::size_t>(nodes[way])].place &&
                    place(k + 1) == rim.nodes[static_cast<std::size_t>(nodes[1 - way])].place;
      }
      CHECK(has_edge);
    }
  }
  CHECK(std::count(at.begin(), at.end(), 1) == 2);
  CHECK(std::count(at.begin(), at.end(), 2) == static_cast<long>(at.size()) - 2);
  for (const WoundRim::Node& node : rim.nodes) {
    const double inside = std::min(node.place.minCoeff(), (Vec3::Constant(CutBody::side) - node.place).minCoeff());
    CHECK(std::abs(inside) < 1e-8);
    CHECK(CutBody::beside(node.place.cast<float>()) < 0.006f);  // half an edge
    CHECK(node.normal.norm() == doctest::Approx(1));
    CHECK(node.normal.dot(node.place - Vec3::Constant(CutBody::side / 2)) > 0.02);  // outward
  }
}

}  // namespace heml::wound_rim_test
