#include "app/render/wound.hpp"

#include <doctest/doctest.h>

#include <app/render/smooth_surface.hpp>
#include <engine/session/cut_body.hpp>

#include "shapes.hpp"

namespace heml::wound_test {

using namespace heml::render;

TEST_CASE("an uncut surface has no wound") {
  const CutBody body;
  SurfaceMesh same = *body.whole;
  same.whole = body.whole;
  CHECK(Wound(same, 0.05f).empty());
}

TEST_CASE("the drawn lips move with the tissue: they turn and travel with a rigid motion") {
  const CutBody body;
  Wound wound(*body.cut, 0.05f);
  const std::vector<Vec3f> rest = wound.place(body.cut->rest);
  const Eigen::Matrix3f turn(Eigen::AngleAxisf(0.9f, Vec3f(1, 2, -1).normalized()));
  std::vector<Vec3f> moved;
  for (const Vec3f& x : body.cut->rest) moved.push_back(turn * x + Vec3f(0.3f, -0.1f, 0.2f));
  const std::vector<Vec3f>& placed = wound.place(moved);
  for (std::size_t n = 0; n < rest.size(); ++n)
    CHECK((placed[n] - turn * rest[n] - Vec3f(0.3f, -0.1f, 0.2f)).norm() < 1e-6f);
}

TEST_CASE("two lips that lie together in deformed tissue are drawn as mirror images") {
  const CutBody body;
  Wound wound(*body.cut, 0.05f);
  const OriginalSkin& skin = wound.skin();
  std::vector<Vec3f> bent = body.cut->rest;
  for (Vec3f& x : bent) x = Vec3f(1.2f * x.x() + 3 * x.z() * x.z(), x.y() - 0.2f * x.x(), x.z() + 2 * x.y() * x.y());
  const std::vector<Vec3f>& placed = wound.place(bent);
  for (const WoundSite& site : wound_sites(*body.cut, skin.exposed())) {
    if (site.nodes.size() != 2 || site.rim.size() != 2) continue;
    const Vec3f a = placed[site.nodes[0]] - bent[site.nodes[0]], b = placed[site.nodes[1]] - bent[site.nodes[1]];
    CHECK((a - b).norm() < 2.5e-3f);  // each is drawn back by the opening
    CHECK((a - b).norm() > 1e-4f);
  }
}

TEST_CASE("a closed wound is dark inside and a gaping one is lit") {
  const CutBody body;
  Wound wound(*body.cut, 0.05f);
  wound.place(body.cut->rest);
  const std::vector<float> closed = wound.openness();
  std::vector<Vec3f> gaping = body.cut->rest;
  for (const WoundSite& site : wound_sites(*body.cut, wound.exposed()))
    if (site.nodes.size() == 2) gaping[site.nodes[1]].x() += 0.05f;  // one lip moves away
  wound.place(gaping);
  int deep = 0;
  for (const WoundSite& site : wound_sites(*body.cut, wound.exposed())) {
    if (site.nodes.size() != 2 || wound.skin().places()[site.nodes[0]].depth < 0.015f) continue;
    ++deep;
    CHECK(closed[site.nodes[0]] < 0.1f);
    CHECK(wound.openness()[site.nodes[0]] > 0.7f);
  }
  CHECK(deep > 3);
}

TEST_CASE("the rims of two lips that lie together are the same smooth curve") {
  const CutBody body;
  const OriginalSkin skin(*body.cut);
  const SmoothSurface surface(*body.cut, 4, skin.exposed());
  const SurfaceTopology& topology = surface.topology();
  // Vertices inside the rim's edges, by the rest positions of the edge's ends: each must have a twin on the other lip.
  std::vector<Vec3f> points;
  std::vector<std::array<int, 2>> faces(topology.edges.size());
  for (std::size_t t = 0; t < skin.exposed().size(); ++t)
    for (const int e : topology.triangle_edges[t]) ++faces[e][skin.exposed()[t] ? 1 : 0];
  std::size_t first = topology.corner_nodes.size();
  for (std::size_t e = 0; e < faces.size(); ++e) {
    const std::size_t sides = topology.edges[e].sides.size();
    if (faces[e] == std::array{1, 1}) {
      REQUIRE(sides == 2);  // its own crease
      for (std::size_t k = 0; k < 3; ++k) {
        CHECK(surface.positions()[first + k] == surface.positions()[first + 3 + k]);  // skin and wound share it
        points.push_back(surface.positions()[first + k]);
      }
    }
    first += 3 * sides;
  }
  REQUIRE(points.size() > 60);
  for (std::size_t i = 0; i < points.size(); ++i) {
    float nearest = 1;
    for (std::size_t j = 0; j < points.size(); ++j)
      if (j != i) nearest = std::min(nearest, (points[i] - points[j]).norm());
    CHECK(nearest < 1e-6f);
  }
}

}  // namespace heml::wound_test
