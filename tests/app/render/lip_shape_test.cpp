#include "app/render/lip_shape.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <engine/session/cut_body.hpp>

namespace heml::lip_shape_test {

using namespace heml::render;

namespace {

struct Lips {
  CutBody body;
  OriginalSkin skin{*body.cut};
  std::vector<WoundSite> sites = wound_sites(*body.cut, skin.exposed());
  std::vector<Vec3f> drawn(float opening) const {
    std::vector<Vec3f> x = lip_displacements(*body.cut, skin, sites, opening);
    for (std::size_t n = 0; n < x.size(); ++n) x[n] += body.cut->rest[n];
    return x;
  }
};

}  // namespace

TEST_CASE("the two sides of a cut are sites of two nodes, and its rim has two neighbours but at its ends") {
  const Lips lips;
  int pairs = 0, on_rim = 0;
  for (const WoundSite& site : lips.sites) {
    pairs += site.nodes.size() == 2;
    on_rim += !site.rim.empty();
    CHECK(site.nodes.size() <= 2);
    for (const int node : site.nodes) CHECK(lips.body.cut->rest[node] == lips.body.cut->rest[site.nodes[0]]);
    if (site.nodes.size() == 2 && !site.rim.empty()) CHECK(site.rim.size() == 2);
  }
  CHECK(pairs > 20);
  CHECK(on_rim > 15);
}

TEST_CASE("a rim that zigzags beside the blade's plane is drawn along it, the same on both sides") {
  const Lips lips;
  const std::vector<Vec3f> drawn = lips.drawn(1e-9f);
  double before = 0, after = 0;
  for (const WoundSite& site : lips.sites) {
    for (const int node : site.nodes) CHECK((drawn[node] - drawn[site.nodes[0]]).norm() < 1e-6f);
    if (site.rim.empty()) continue;
    before += std::pow(CutBody::beside(lips.body.cut->rest[site.nodes[0]]), 2);
    after += std::pow(CutBody::beside(drawn[site.nodes[0]]), 2);
    CHECK(lips.skin.nearest(drawn[site.nodes[0]]).depth < 1e-6f);
  }
  CHECK(before > 0);
  CHECK(after < 0.5 * before);
}

TEST_CASE("lips part by twice the opening at the rim, and not at its ends") {
  const Lips lips;
  constexpr float opening = 2e-4f;
  const std::vector<Vec3f> drawn = lips.drawn(opening);
  int parted = 0;
  for (const WoundSite& site : lips.sites) {
    if (site.nodes.size() < 2) continue;
    const float gap = (drawn[site.nodes[0]] - drawn[site.nodes[1]]).norm();
    CHECK(gap < 2.01f * opening);
    if (site.rim.size() == 2) parted += gap > 1.5f * opening;
  }
  CHECK(parted > 10);
}

TEST_CASE("no face of the skin is turned over and nodes far from the wound stay") {
  const Lips lips;
  const std::vector<Vec3f> drawn = lips.drawn(5e-4f);
  const SurfaceMesh& mesh = *lips.body.cut;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (lips.skin.exposed()[t]) continue;
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3f normal = (mesh.rest[b] - mesh.rest[a]).cross(mesh.rest[c] - mesh.rest[a]);
    CHECK((drawn[b] - drawn[a]).cross(drawn[c] - drawn[a]).dot(normal) > 0);
  }
  for (std::size_t n = 0; n < drawn.size(); ++n)
    if (CutBody::beside(mesh.rest[n]) > 0.035f) CHECK(drawn[n] == mesh.rest[n]);
}

}  // namespace heml::lip_shape_test
