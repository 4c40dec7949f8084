#include "app/render/fine_skin.hpp"

#include <doctest/doctest.h>

#include <app/render/osmesa_context.hpp>
#include <app/render/png.hpp>
#include <app/render/renderer.hpp>
#include <engine/mesh/files.hpp>
#include <heml/base/cpu_time.hpp>
#include <heml/base/error.hpp>
#include <heml/mesh/generate.hpp>
#include <heml/mesh/surface.hpp>

#include "shapes.hpp"

namespace heml::fine_skin_test {

using namespace heml::render;

namespace {

constexpr Size size{320, 180};

/// A box of tetrahedra of 10 cm about the origin with its frame.
struct Body {
  TetMesh mesh = make_box(Vec3(0.1, 0.1, 0.1), {3, 3, 3}, Vec3(-0.05, -0.05, -0.05));
  Frame frame;

  Body() {
    SurfaceMesh surface;
    Solid solid;
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
      surface.nodes.push_back(static_cast<int>(n));
      surface.rest.push_back(mesh.nodes[n].cast<float>());
    }
    surface.triangles = extract_boundary(mesh).triangles;
    surface.regions.assign(surface.triangles.size(), 0);
    solid.rest = surface.rest;
    solid.tets = mesh.tets;
    solid.regions = mesh.regions;
    frame = frame_at_rest(surface);
    frame.solid = std::make_shared<const Solid>(std::move(solid));
    frame.solid_positions = frame.solid->rest;
  }
  void move(const Eigen::Matrix3f& A, const Vec3f& b) {
    frame.positions.clear();
    for (const Vec3f& x : frame.solid->rest) frame.positions.push_back(A * x + b);
    frame.solid_positions = frame.positions;
  }
};

/// A ball that hangs on the body.
std::shared_ptr<Skin> ball_skin(const TetMesh& mesh, int rounds, float radius) {
  const SurfaceMesh ball = ball_surface(rounds, radius);
  auto skin = std::make_shared<Skin>();
  for (const Vec3f& x : ball.rest) skin->surface.mesh.nodes.push_back(x.cast<double>());
  skin->surface.mesh.triangles = ball.triangles;
  skin->embedding = embed(skin->surface.mesh.nodes, mesh);
  return skin;
}

struct Stage : Body {
  OsMesaContext context{size};
  Renderer renderer;
  Camera camera;
  DrawOptions options;

  Stage() {
    camera.fit(Vec3f::Zero(), 0.09f, size);
    options.ground = options.constrained = false;
  }
  Image draw() {
    renderer.draw(frame, camera, options, size);
    return read_pixels(size);
  }
};

FineSkin made(const Body& body, std::shared_ptr<const Skin> skin) {
  const SurfaceMesh& surface = *body.frame.surface_mesh;
  return FineSkin(std::move(skin), surface, tissue_look(surface), bounding_sphere(surface.rest));
}

int count_where(const Image& image, const auto& is) {
  int count = 0;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const std::uint8_t* p = image.at(x, y);
      count += is(int{p[0]}, int{p[1]}, int{p[2]});
    }
  return count;
}

}  // namespace

TEST_CASE("a fine skin moves with the body, and its normals are those of the moved surface") {
  Body body;
  const OsMesaContext context(size);
  FineSkin skin = made(body, ball_skin(body.mesh, 4, 0.06f));  // beyond the body's sides
  Eigen::Matrix3f A;
  A << 1.3f, 0.2f, 0, -0.1f, 0.8f, 0.1f, 0, 0.3f, 1;
  const Vec3f b(0.2f, -0.1f, 0.3f);
  body.move(A, b);
  skin.update(body.frame, Range{});
  const Eigen::Matrix3f normals = A.inverse().transpose();
  const SurfaceMesh ball = ball_surface(4, 0.06f);
  for (std::size_t v = 0; v < ball.rest.size(); ++v) {
    CHECK((skin.positions()[v] - (A * ball.rest[v] + b)).norm() < 1e-6f);
    CHECK(skin.normals()[v].dot((normals * ball.rest[v]).normalized()) > 0.999f);
  }
}

TEST_CASE("normals are the same on both sides of a seam") {
  Body body;
  const OsMesaContext context(size);
  const auto skin = std::make_shared<Skin>();
  // Two triangles of a roof that share an edge in place, but no vertex.
  skin->surface.mesh.nodes = {{-0.02, 0, 0}, {0, 0, 0.01}, {0, 0.02, 0.01},
                              {0, 0, 0.01},  {0.02, 0, 0}, {0, 0.02, 0.01}};
  skin->surface.mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  skin->embedding = embed(skin->surface.mesh.nodes, body.mesh);
  FineSkin fine = made(body, skin);
  fine.update(body.frame, Range{});
  CHECK(fine.normals()[1] == fine.normals()[3]);
  CHECK(fine.normals()[2] == fine.normals()[5]);
  CHECK(std::abs(fine.normals()[1].x()) < 1e-6f);
  CHECK(fine.normals()[1].z() > 0.8f);
}

TEST_CASE("the skin is drawn in place of the body's surface, while the body is whole") {
  const Image alone = [] {  // a picture of a body that is the ball differs in texture at most
    Stage stage;
    stage.frame = frame_at_rest(ball_surface(4, 0.03f));
    return stage.draw();
  }();
  Stage stage;
  const Image box = stage.draw();
  stage.frame.skin = ball_skin(stage.mesh, 4, 0.03f);  // within the body
  const Image ball = stage.draw();
  CHECK(rms_difference(box, ball) > 5);
  CHECK(rms_difference(alone, ball) < rms_difference(box, ball) / 2);
  // Without the skin, without a solid, or once edited, the body is drawn as before, to the bit.
  const auto skin = std::exchange(stage.frame.skin, nullptr);
  CHECK(stage.draw().pixels == box.pixels);
  stage.frame.skin = skin;
  stage.frame.solid.reset();
  CHECK(stage.draw().pixels == box.pixels);
}

TEST_CASE("a fine skin has the burns of the body's surface, and loses them with it") {
  Stage stage;
  stage.frame.skin = ball_skin(stage.mesh, 4, 0.03f);
  const Image fresh = stage.draw();
  const auto surface = stage.frame.surface_mesh;
  auto burnt = std::make_shared<SurfaceMesh>(*surface);
  burnt->burnt.assign(burnt->nodes.size(), 1);
  stage.frame.surface_mesh = burnt;
  const Image charred = stage.draw();
  CHECK(rms_difference(fresh, charred) > 5);
  stage.frame.surface_mesh = surface;
  CHECK(stage.draw().pixels == fresh.pixels);
}

TEST_CASE("a texture has its colours at its places, the first row on top") {
  const TemporaryFolder folder;
  Image halves(Size{8, 8});
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) {
      halves.at(x, y)[0] = y < 4 ? 230 : 20;
      halves.at(x, y)[1] = 20;
      halves.at(x, y)[2] = y < 4 ? 20 : 230;
    }
  write_png(folder / "halves.png", halves);
  Stage stage;
  const auto skin = ball_skin(stage.mesh, 4, 0.04f);
  for (const Vec3& x : skin->surface.mesh.nodes)
    skin->surface.places.push_back({0.5f, static_cast<float>(0.5 + x.y() / 0.09)});
  skin->surface.texture = folder / "halves.png";
  stage.frame.skin = skin;
  const Image image = stage.draw();
  const auto red = [](int r, int g, int b) { return r > 60 && r > 2 * g && r > 2 * b; };
  const auto blue = [](int r, int g, int b) { return b > 60 && b > 2 * r && b > 2 * g; };
  CHECK(count_where(image, red) > 200);
  CHECK(count_where(image, blue) > 200);
  int lowest_red = 0, highest_blue = size.height;
  for (int y = 0; y < size.height; ++y) {
    const std::uint8_t* p = image.at(size.width / 2, y);
    if (red(p[0], p[1], p[2])) lowest_red = y;
    if (blue(p[0], p[1], p[2])) highest_blue = std::min(highest_blue, y);
  }
  CHECK(lowest_red <= highest_blue + 2);  // v points up
  auto other = std::make_shared<Skin>(*skin);
  other->surface.texture = folder / "gone.png";
  stage.frame.skin = other;
  CHECK_THROWS_AS(stage.draw(), InputError);
}

TEST_CASE("colours of vertices are drawn, and a field over them") {
  Stage stage;
  const auto skin = ball_skin(stage.mesh, 3, 0.04f);
  skin->surface.colours.assign(skin->surface.mesh.nodes.size(), Vec3f(0.1f, 0.9f, 0.1f));
  stage.frame.skin = skin;
  const auto green = [](int r, int g, int b) { return g > 60 && g > 2 * r && g > 2 * b; };
  CHECK(count_where(stage.draw(), green) > 1000);
  stage.frame.field = Field::displacement;
  stage.frame.values.assign(stage.frame.positions.size(), 0.0f);
  CHECK(count_where(stage.draw(), green) < 50);
}

TEST_CASE("a frame of a fine skin takes little time") {
  Body body;
  const OsMesaContext context(size);
  FineSkin skin = made(body, ball_skin(body.mesh, 7, 0.045f));  // 327,680 triangles
  skin.update(body.frame, Range{});
  const double began = cpu_seconds_of_process();
  constexpr int frames = 10;
  for (int k = 0; k < frames; ++k) skin.update(body.frame, Range{});
  const double each = (cpu_seconds_of_process() - began) / frames;
  MESSAGE("327,680 triangles: ", 1e3 * each, " ms of processor time a frame");
  CHECK(each < 0.2);
}

}  // namespace heml::fine_skin_test
