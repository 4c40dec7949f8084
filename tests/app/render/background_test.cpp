#include "app/render/background.hpp"

#include <doctest/doctest.h>

#include <app/render/osmesa_context.hpp>
#include <app/render/renderer.hpp>

#include "shapes.hpp"

namespace heml::background_test {

using namespace heml::render;

namespace {

constexpr Size whole{320, 180};

// A ball of radius 5 cm; its pictures by a renderer that has drawn before, and by one that has not.
struct Stage {
  OsMesaContext context{whole};
  Renderer renderer;
  SurfaceMesh surface_mesh = ball_surface(3, 0.05f);
  Frame frame = frame_at_rest(surface_mesh);
  Camera camera;
  DrawOptions options;
  Size size = whole;

  Stage() {
    const BoundingSphere ball = bounding_sphere(surface_mesh.rest);
    camera.fit(ball.centre, ball.radius, whole);
  }
  Image draw(Renderer& by) {
    by.draw(frame, camera, options, size);
    return read_pixels(whole);
  }
  Image fresh() {
    Renderer other;
    return draw(other);
  }
  /// Whether one picture after another is as if each were the first; three times, since the second makes what is kept.
  bool is_like_fresh() {
    const Image wanted = fresh();
    for (int k = 0; k < 3; ++k)
      if (draw(renderer).pixels != wanted.pixels) return false;
    return true;
  }
  void move(const Vec3f& by) {
    for (Vec3f& node : frame.positions) node += by;
  }
};

}  // namespace

TEST_CASE("what is kept gives the bytes of a first picture, wherever body and shadows go") {
  Stage stage;
  CHECK(stage.is_like_fresh());
  const Image before = stage.fresh();
  for (const Vec3f& step : {Vec3f(0.02f, 0, 0), Vec3f(0, 0.05f, 0), Vec3f(0.1f, 0.02f, -0.05f), Vec3f(-0.3f, 0, 0.2f),
                            Vec3f(0.2f, -0.1f, 0), Vec3f(0, 40, 0)}) {
    stage.move(step);
    CHECK(stage.is_like_fresh());
  }
  CHECK(stage.fresh().pixels != before.pixels);
}

TEST_CASE("what is kept gives the bytes of a first picture, whatever instruments, views and panes") {
  Stage stage;
  CHECK(stage.is_like_fresh());
  const auto probe = [&](const Vec3& tip, const Vec3& end) {
    stage.frame.tools = {ProbeState{{}, tip, end, 0.004}};
    return stage.is_like_fresh();
  };
  CHECK(probe({0.02, 0.06, 0.02}, {0.3, 0.3, 0.1}));
  CHECK(probe({0.06, -0.2, 0.06}, {0.06, 0.1, 0.06}));  // through the ground
  CHECK(probe({-0.1, -0.4, 0}, {0.1, -0.3, 0}));        // below it
  stage.camera.fit(Vec3f::Zero(), 0.2f, whole);
  const Vec3 side = stage.camera.right().cast<double>(), ahead = Vec3::UnitY().cross(side).normalized();
  const Vec3 hidden = 0.1 * side - 0.15 * ahead - Vec3(0, 0.1, 0);  // by ground that no shadow falls on
  CHECK(probe(hidden, hidden + 0.02 * side));
  stage.frame.tools.clear();
  stage.camera.pan(0.1f, -0.4f);
  CHECK(stage.is_like_fresh());
  stage.options.resolution = 0.5f;
  CHECK(stage.is_like_fresh());
  stage.options.resolution = 1;
  stage.options.ground = false;
  CHECK(stage.is_like_fresh());
  stage.options.ground = true;
  stage.size = {150, 120};
  stage.options.left = 100;
  stage.options.bottom = 37;
  CHECK(stage.is_like_fresh());
}

TEST_CASE("old shadows are those of the picture before, and new ones come with another body") {
  Stage stage;
  stage.draw(stage.renderer);
  stage.options.old_shadows = true;
  CHECK(stage.draw(stage.renderer).pixels == stage.fresh().pixels);
  stage.move({0.03f, 0, 0});
  const Image old = stage.draw(stage.renderer);
  CHECK(old.pixels != stage.fresh().pixels);
  stage.options.old_shadows = false;
  CHECK(stage.draw(stage.renderer).pixels == stage.fresh().pixels);
  stage.options.old_shadows = true;
  stage.frame.surface_mesh = std::make_shared<const SurfaceMesh>(stage.surface_mesh);
  stage.move({0.03f, 0, 0});
  CHECK(stage.draw(stage.renderer).pixels == stage.fresh().pixels);
}

}  // namespace heml::background_test
