#include <doctest/doctest.h>

#include <heml/session/remaining_skin.hpp>

#include "cut_body.hpp"

namespace heml::remaining_skin_test {

TEST_CASE("of a cut body all of the skin is left, and the sides of the cut are connected round its ends alone") {
  const CutBody body;
  const OriginalSkin original(*body.cut);
  const RemainingSkin left(*body.cut, original);
  const double top = CutBody::side;
  // On the top the cut goes from edge to edge; on the sides it ends at half the depth.
  const int before = left.at({0.02, 0.04, top}), behind = left.at({0.06, 0.04, top});
  const int deep_before = left.at({0.034, 0, 0.02}), deep_behind = left.at({0.036, 0, 0.02});
  for (const int tile : {before, behind, deep_before, deep_behind}) REQUIRE(tile >= 0);
  CHECK(left.at({0.02, 0.04, top - 0.005}) < 0);  // no point of the skin
  CHECK(left.tile_of(static_cast<int>(left.face(before))) == before);
  CHECK(left.tile_of(-1) == -1);
  CHECK(left.are_connected(before, before));
  CHECK(left.are_connected(before, left.at({0.025, 0.045, top})));
  CHECK(left.are_connected(deep_before, deep_behind));
  const int at_left = left.at({0.0385, 0.04, top}), at_right = left.at({0.0425, 0.04, top});
  REQUIRE(at_left != at_right);
  CHECK_FALSE(left.are_connected(at_left, at_right));
}

TEST_CASE("faces that a cut has not divided are those from before") {
  const CutBody body;
  const OriginalSkin original(*body.cut);
  const RemainingSkin left(*body.cut, original);
  const std::vector<int> kept = left.kept_of(*body.whole);
  REQUIRE(kept.size() == body.whole->triangles.size());
  std::size_t divided = 0;
  for (std::size_t t = 0; t < kept.size(); ++t) {
    if (kept[t] < 0) {
      ++divided;
      continue;
    }
    const Triangle& face = body.cut->triangles[left.face(kept[t])];
    Vec3f before = Vec3f::Zero(), now = Vec3f::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      before += body.whole->rest[static_cast<std::size_t>(body.whole->triangles[t][k])];
      now += body.cut->rest[static_cast<std::size_t>(face[k])];
    }
    CHECK((before - now).norm() < 1e-7f);
  }
  CHECK(divided > 10);
  CHECK(divided < kept.size() / 3);
}

}  // namespace heml::remaining_skin_test
