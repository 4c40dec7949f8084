#include "app/render/ambient_occlusion.hpp"

#include <doctest/doctest.h>

#include "shapes.hpp"

namespace heml::ambient_occlusion_test {

using namespace heml::render;

TEST_CASE("a ball sees the whole sky everywhere") {
  const Skin skin = ball_skin(2, 1);
  for (const float open : ambient_occlusion(skin, skin.rest, 0.7f)) CHECK(open == 1);
}

TEST_CASE("the inside of a closed ball sees nothing") {
  const Skin skin = ball_skin(2, 1);
  std::vector<Vec3f> inward;
  for (const Vec3f& node : skin.rest) inward.push_back(-node);
  for (const float open : ambient_occlusion(skin, inward, 3)) CHECK(open < 0.02f);
}

TEST_CASE("beside a wide wall half of the sky is hidden") {
  // Nodes of a floor in the xz plane at the foot of a wall in the xy plane. Of cosine-weighted directions about y, half
  // point to the side of the wall.
  Skin skin;
  const float far = 200;
  skin.rest = {{0, 0, 1e-3f}, {1e-3f, 0, 1e-3f}, {0, 0, 2e-3f}, {-far, -1, 0}, {far, -1, 0}, {0, far, 0}};
  skin.triangles = {{3, 4, 5}};
  const std::vector<Vec3f> up(skin.rest.size(), Vec3f::UnitY());
  CHECK(ambient_occlusion(skin, up, 100)[0] == doctest::Approx(0.5).epsilon(0.06));
}

}  // namespace heml::ambient_occlusion_test
