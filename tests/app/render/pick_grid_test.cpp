#include "app/render/pick_grid.hpp"

#include <doctest/doctest.h>

#include <random>

#include "shapes.hpp"

namespace heml::pick_grid_test {

using namespace heml::render;

namespace {

const Size size{320, 180};

/// Two balls, one in part before the other, dented where the frame says so.
struct Body {
  SurfaceMesh surface_mesh = ball_surface(3, 0.05f);
  Frame frame;

  Body() {
    const SurfaceMesh other = ball_surface(2, 0.03f, Vec3f(0.03f, 0.01f, -0.09f));
    const auto first = static_cast<int>(surface_mesh.rest.size());
    surface_mesh.rest.insert(surface_mesh.rest.end(), other.rest.begin(), other.rest.end());
    for (const auto& [a, b, c] : other.triangles) surface_mesh.triangles.push_back({first + a, first + b, first + c});
    for (std::size_t n = surface_mesh.nodes.size(); n < surface_mesh.rest.size(); ++n)
      surface_mesh.nodes.push_back(static_cast<int>(n));
    frame = frame_at_rest(surface_mesh);
    for (Vec3f& x : frame.positions) x.y() += 0.2f * x.x() * x.x() / 0.05f;
  }
};

/// All pixels of nodes, and as many at random, some beside the picture.
std::vector<Vec2f> pixels_of(const Frame& frame, const Camera& camera) {
  std::vector<Vec2f> pixels;
  std::mt19937 random(7);
  std::uniform_real_distribution<float> x(-20, 340), y(-20, 200);
  for (const Vec3f& node : frame.positions) {
    if (const Vec2f at = camera.pixel(node, size); at.allFinite()) pixels.push_back(at);
    pixels.emplace_back(x(random), y(random));
  }
  return pixels;
}

/// Returns how many rays hit.
int compare(const Body& body, const Camera& camera, const std::optional<SectionPlane>& section) {
  const PickGrid grid(body.frame, body.surface_mesh, camera, size);
  int hits = 0;
  for (const Vec2f& at : pixels_of(body.frame, camera)) {
    const auto all = pick(body.frame, body.surface_mesh, camera.ray(at.x(), at.y(), size), section);
    const auto near = grid.pick(at, section);
    REQUIRE(all.has_value() == near.has_value());
    if (!all) continue;
    ++hits;
    REQUIRE(near->triangle == all->triangle);
    REQUIRE(near->node == all->node);
    REQUIRE(near->point == all->point);
  }
  return hits;
}

}  // namespace

TEST_CASE("picks of a grid are those that ask every triangle, in perspective and without, with a section and without") {
  const Body body;
  for (const bool orthographic : {false, true})
    for (const bool cut : {false, true}) {
      Camera camera;
      camera.fit(Vec3f::Zero(), 0.08f, size);
      camera.set_orthographic(orthographic);
      camera.orbit(0.3f, -0.7f);
      CHECK(compare(body, camera, cut ? std::optional(SectionPlane{Vec3f(0, 0.6f, 0.8f), 0.01f}) : std::nullopt) > 300);
    }
}

TEST_CASE("picks of a grid are right where the body reaches behind the eye and beside the picture") {
  Body body;
  for (Vec3f& x : body.frame.positions) x.z() *= 20;
  Camera camera;
  camera.fit(Vec3f::Zero(), 0.04f, size);
  camera.orbit(0.1f, 0.2f);
  CHECK(compare(body, camera, std::nullopt) > 300);
  camera.zoom(0);
  CHECK(compare(body, camera, std::nullopt) > 100);
}

TEST_CASE("a picture without a body has no picks") {
  const SurfaceMesh none;
  const Frame frame;
  CHECK_FALSE(PickGrid(frame, none, Camera(), size).pick({10, 10}));
}

}  // namespace heml::pick_grid_test
