#include "app/render/renderer.hpp"

#include <doctest/doctest.h>
#include <imgui.h>

#include <app/render/imgui_renderer.hpp>
#include <app/render/osmesa_context.hpp>
#include <app/render/pick.hpp>
#include <app/render/wound.hpp>
#include <cmath>
#include <engine/session/cut_body.hpp>
#include <functional>
#include <numbers>
#include <set>

#include "shapes.hpp"

namespace heml::renderer_test {

using namespace heml::render;

namespace {

constexpr Size size{320, 180};

// A ball of radius 5 cm and a headless renderer.
struct Stage {
  OsMesaContext context{size};
  Renderer renderer;
  SurfaceMesh surface_mesh = ball_surface(3, 0.05f);
  Frame frame = frame_at_rest(surface_mesh);
  Camera camera;
  DrawOptions options;

  Stage() {
    const BoundingSphere ball = bounding_sphere(surface_mesh.rest);
    camera.fit(ball.centre, ball.radius, size);
  }
  // Radius of the ball in the picture, pixels: radius r at distance d subtends the half-angle asin(r/d).
  double rim() const {
    const double sine = 0.05 / (camera.eye() - camera.target()).norm();
    return std::tan(std::asin(sine)) * camera.projection(size)(1, 1) * size.height / 2;
  }
  Image draw() {
    renderer.draw(frame, camera, options, size);
    return read_pixels(size);
  }
};

double from_middle(int x, int y) { return std::hypot(x + 0.5 - size.width / 2.0, y + 0.5 - size.height / 2.0); }

bool same(const Image& a, const Image& b, int x, int y) { return std::equal(a.at(x, y), a.at(x, y) + 3, b.at(x, y)); }

int count_different(const Image& a, const Image& b) {
  int count = 0;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) count += !same(a, b, x, y);
  return count;
}

}  // namespace

TEST_CASE("a drawn ball covers the pixels a ball covers") {
  Stage stage;
  stage.options.ground = false;
  const Image with_body = stage.draw();
  const Image without = [&] {
    Renderer empty;
    empty.draw(Frame{}, stage.camera, stage.options, size);
    return read_pixels(size);
  }();
  const double rim = stage.rim();
  const int covered = count_different(with_body, without);
  CHECK(covered > 0.995 * std::numbers::pi * rim * rim);
  CHECK(covered < 1.005 * std::numbers::pi * (rim + 1) * (rim + 1));  // its edge fades out over one pixel

  int inside = 0;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const double away = from_middle(x, y);
      if (away < rim - 1) inside += same(with_body, without, x, y);
      if (away > rim + 2) CHECK(same(with_body, without, x, y));
    }
  CHECK(inside == 0);
}

TEST_CASE("the first image has many colours and the body is red") {
  Stage stage;
  const Image image = stage.draw();
  std::set<std::array<int, 3>> colours;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) colours.insert({image.at(x, y)[0], image.at(x, y)[1], image.at(x, y)[2]});
  CHECK(colours.size() > 2000);
  const std::uint8_t* middle = image.at(size.width / 2, size.height / 2);
  CHECK(middle[0] > 60);
  CHECK(middle[0] > 2 * middle[1]);
  CHECK(middle[0] > 2 * middle[2]);
}

TEST_CASE("the same frame gives the same bytes, also after other frames and in another context") {
  Stage stage;
  const Image first = stage.draw();
  stage.frame.positions[0] *= 1.5f;
  const Image other = stage.draw();
  stage.frame.positions = stage.surface_mesh.rest;
  const Image again = stage.draw();
  CHECK(first.pixels == again.pixels);
  CHECK(first.pixels != other.pixels);
  Stage second;
  CHECK(second.draw().pixels == first.pixels);
}

TEST_CASE("a field colours the body by its values over the range") {
  Stage stage;
  stage.options.ground = false;
  const Image tissue = stage.draw();
  stage.frame.field = Field::von_mises;
  stage.frame.values.assign(stage.surface_mesh.rest.size(), 0);
  stage.options.range = Range{0, 100};
  const Image low = stage.draw();
  stage.frame.values.assign(stage.surface_mesh.rest.size(), 100);
  const Image high = stage.draw();
  CHECK(rms_difference(tissue, low) > 5);
  const int x = size.width / 2, y = size.height / 2;
  CHECK(low.at(x, y)[2] > low.at(x, y)[1]);    // viridis: violet at the low end
  CHECK(high.at(x, y)[0] > high.at(x, y)[2]);  // yellow at the high end
  CHECK(high.at(x, y)[1] > high.at(x, y)[2]);
}

TEST_CASE("edges, constrained nodes and the tool are drawn on request") {
  Stage stage;
  const Image plain = stage.draw();
  stage.options.wireframe = true;
  CHECK(count_different(plain, stage.draw()) > 500);
  stage.options.wireframe = false;

  SurfaceMesh pinned = stage.surface_mesh;
  for (int i = 0; i < static_cast<int>(pinned.rest.size()); i += 7) pinned.constrained.push_back(i);
  stage.frame.surface_mesh = std::make_shared<const SurfaceMesh>(pinned);
  CHECK(count_different(plain, stage.draw()) > 100);
  stage.options.constrained = false;
  CHECK(stage.draw().pixels == plain.pixels);

  stage.frame.tools.push_back(GraspState{.target = Vec3(0, 0.06, 0.03), .grip = Vec3(0, 0.04, 0.03)});
  CHECK(count_different(plain, stage.draw()) > 100);
  stage.options.tool = false;
  CHECK(stage.draw().pixels == plain.pixels);
}

TEST_CASE("an instrument over the skin casts a fine shadow towards which the lamp does not shine") {
  Stage stage;
  stage.options.ground = false;
  const Image plain = stage.draw();
  const Vec3f lamp = Vec3f(-0.50f, 0.78f, 0.38f).normalized();
  const Vec3f skin = 0.05f * lamp, tip = 0.08f * lamp - 0.02f * stage.camera.right();
  stage.frame.tools.push_back(
      ProbeState{{}, tip.cast<double>(), (tip + 0.04f * stage.camera.right()).cast<double>(), 0.003});
  const Image shaded = stage.draw();
  const auto brightness = [&](const Image& image, const Vec3f& point) {
    const Vec2f pixel = stage.camera.pixel(point, size);
    const auto colour = image.at(static_cast<int>(pixel.x()), static_cast<int>(pixel.y()));
    return static_cast<int>(colour[0]) + static_cast<int>(colour[1]) + static_cast<int>(colour[2]);
  };
  CHECK(brightness(shaded, skin) < 0.9 * brightness(plain, skin));
  const Vec3f away = 0.05f * (lamp - 1.2f * stage.camera.up()).normalized();
  CHECK(brightness(shaded, away) == brightness(plain, away));
}

TEST_CASE("scissors are drawn over the jaw line with a blade on each side, and meet on it when closed") {
  Stage stage;
  stage.options.ground = false;
  const Image plain = stage.draw();
  const Vec3f front = 0.05f * (stage.camera.eye() - stage.camera.target()).normalized(), up = stage.camera.up();
  const Vec3f right = stage.camera.right();
  const auto change = [&](const Image& image, const Vec3f& point) {
    const Vec2f pixel = stage.camera.pixel(point, size);
    const int x = static_cast<int>(pixel.x()), y = static_cast<int>(pixel.y());
    int sum = 0;
    for (int k = 0; k < 3; ++k) sum += std::abs(image.at(x, y)[k] - plain.at(x, y)[k]);
    return sum;
  };
  stage.options.stroke.scissors = Scissors{front, front + 0.02f * up, 0.02f, 0};
  const Image open = stage.draw();
  stage.options.stroke.scissors->closed = 1;
  const Image closed = stage.draw();
  const Vec3f beside = front + 0.016f * up;
  for (const float side : {-1.0f, 1.0f}) {
    int opened = 0, shut = 0;
    for (int k = 6; k < 24; ++k) {
      opened += change(open, beside + 0.0005f * static_cast<float>(k) * side * right) > 60;
      shut += change(closed, beside + 0.0005f * static_cast<float>(k) * side * right) > 60;
    }
    CHECK(opened > shut + 2);
  }
  stage.options.tool = false;
  CHECK(stage.draw().pixels == plain.pixels);
}

TEST_CASE("a surface mesh after a removal is drawn with its frame and the rest of the image stays") {
  Stage stage;
  stage.options.ground = false;
  const Image before = stage.draw();
  const auto whole = stage.frame.surface_mesh;
  SurfaceMesh cut = *whole;  // an open surface, which is drawn all the same
  cut.version = 1;
  cut.whole = whole;
  const Vec3f right = stage.camera.right();
  std::erase_if(cut.triangles, [&](const Triangle& t) { return whole->rest[t[0]].dot(right) > 0.04f; });
  cut.regions.resize(cut.triangles.size());
  stage.frame.surface_mesh = std::make_shared<const SurfaceMesh>(cut);
  const Image after = stage.draw();
  int left = 0, gone = 0;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      if (!same(before, after, x, y)) ++(x < size.width / 2 ? left : gone);
  CHECK(gone > 30);
  CHECK(left == 0);
  stage.frame.surface_mesh = whole;
  CHECK(stage.draw().pixels == before.pixels);
}

TEST_CASE("a scalpel is drawn over the body, its part in the tissue shows through, fainter, and so does its line") {
  Stage stage;
  stage.options.ground = false;
  const Image plain = stage.draw();
  const Vec3f back = (stage.camera.eye() - stage.camera.target()).normalized(), right = stage.camera.right();
  // Straight down through the front of the ball, seen from the side: half of the edge is inside.
  const Vec3f middle = 0.05f * stage.camera.up(), up = 0.02f * stage.camera.up();
  stage.options.stroke.blade = Blade{{middle - up, middle + up}, right};
  const Image cutting = stage.draw();
  const auto change = [&](const Image& image, const Vec3f& point) {
    const Vec2f pixel = stage.camera.pixel(point, size);
    const int x = static_cast<int>(pixel.x()), y = static_cast<int>(pixel.y());
    int sum = 0;
    for (int k = 0; k < 3; ++k) sum += std::abs(image.at(x, y)[k] - plain.at(x, y)[k]);
    return sum;
  };
  const Vec3f behind_edge = -0.0015f * right;  // the blade trails behind its edge
  CHECK(change(cutting, middle + 0.5f * up + behind_edge) > 60);
  CHECK(change(cutting, middle - 0.5f * up + behind_edge) > 25);
  CHECK(change(cutting, middle - 2.0f * up + behind_edge) == 0);
  stage.options.stroke.blade.reset();
  stage.options.stroke.line = {{0.05f * back - 0.02f * right, 0.05f * back + 0.02f * right}};
  CHECK(change(stage.draw(), 0.05f * back) > 60);
  stage.options.tool = false;
  CHECK(stage.draw().pixels == plain.pixels);
}

TEST_CASE("a closed cut is a dark line along the blade's path, and a gaping one shows raw faces darker than the skin") {
  const OsMesaContext context(size);
  Renderer renderer;
  const CutBody body;
  Frame frame = frame_at_rest(*body.whole);
  DrawOptions options;
  options.ground = options.constrained = false;
  Camera camera;
  camera.fit(Vec3f::Constant(0.04f), 0.05f, size);
  camera.look(0, 0);  // on the face that is cut
  const auto draw = [&] {
    renderer.draw(frame, camera, options, size);
    return read_pixels(size);
  };
  const Image whole = draw();
  frame = frame_at_rest(*body.cut);
  const Image closed = draw();
  CHECK(draw().pixels == closed.pixels);
  const auto path = [](float y) { return Vec3f(0.033f + 0.14f * (y + 0.01f), y, 0.08f); };
  int dark = 0, beside = 0;
  for (float y = 0.012f; y < 0.07f; y += 0.002f) {
    const Vec2f at = camera.pixel(path(y), size);
    const auto is_darker = [&](int x) {
      return closed.at(x, static_cast<int>(at.y()))[0] + 15 < whole.at(x, static_cast<int>(at.y()))[0];
    };
    const int x = static_cast<int>(at.x());
    dark += is_darker(x - 1) || is_darker(x) || is_darker(x + 1);
    beside += is_darker(x - 12) || is_darker(x + 12);
  }
  CHECK(dark >= 24);  // of 29
  CHECK(beside == 0);

  for (Vec3f& x : frame.positions)  // the right half turns away about the cut's lower end
    if (const float above = x.z() - 0.041f; above > 0 && x.x() > path(x.y()).x() + 0.006f) x.x() += 0.3f * above;
  for (const WoundSite& site : wound_sites(*body.cut, OriginalSkin(*body.cut).exposed()))
    if (site.nodes.size() == 2) {
      const bool first_is_right = [&] {  // its faces look to the left
        float sum = 0;
        for (const Triangle& t : body.cut->triangles)
          if (std::find(t.begin(), t.end(), site.nodes[0]) != t.end())
            for (const int n : t) sum += body.cut->rest[n].x() - body.cut->rest[site.nodes[0]].x();
        return sum > 0;
      }();
      Vec3f& x = frame.positions[site.nodes[first_is_right ? 0 : 1]];
      x.x() += 0.3f * (x.z() - 0.041f);
    }
  const Image gaping = draw();
  const Vec2f at = camera.pixel(path(0.04f) + Vec3f(0.005f, 0, 0), size);
  const std::uint8_t* raw = gaping.at(static_cast<int>(at.x()), static_cast<int>(at.y()));
  const std::uint8_t* skin = whole.at(static_cast<int>(at.x()), static_cast<int>(at.y()));
  CHECK(raw[0] < 0.7 * skin[0]);
  CHECK(raw[0] > raw[1] + 5);
  frame.field = Field::von_mises;  // a field is drawn on wounds as on the skin
  frame.values.assign(frame.positions.size(), 0);
  CHECK_NOTHROW(draw());
}

TEST_CASE("burnt tissue is black at the path of the electrode, pale and without gloss about it, and else as it was") {
  Stage stage;
  stage.options.ground = false;
  const Image fresh = stage.draw();
  const auto draw = [&](const std::function<float(const Vec3f&)>& level) {
    auto burnt = std::make_shared<SurfaceMesh>(stage.surface_mesh);
    for (const Vec3f& X : burnt->rest) burnt->burnt.push_back(level(X));
    stage.frame.surface_mesh = burnt;
    return stage.draw();
  };
  const auto brightness = [&](const Image& image, int x, int y) {
    const std::uint8_t* p = image.at(x, y);
    return p[0] + p[1] + p[2];
  };
  const int x = size.width / 2, y = size.height / 2;
  const auto sum = [&](const Image& image, int channel) {
    int all = 0;
    for (int i = -15; i <= 15; ++i)
      for (int k = -15; k <= 15; ++k) all += image.at(x + i, y + k)[channel];
    return all;
  };
  const Image charred = draw([](const Vec3f&) { return 1.0f; }), pale = draw([](const Vec3f&) { return 0.3f; });
  CHECK(4 * sum(charred, 0) < sum(fresh, 0));
  CHECK(sum(pale, 1) > 1.3 * sum(fresh, 1));  // greyer than red flesh
  CHECK(sum(pale, 0) / double(sum(pale, 1)) < 0.7 * sum(fresh, 0) / sum(fresh, 1));
  const auto brightest = [&](const Image& image) {
    int most = 0;
    for (int j = 0; j < size.height; ++j)
      for (int i = 0; i < size.width; ++i)
        if (from_middle(i, j) < stage.rim() - 2) most = std::max(most, brightness(image, i, j));
    return most;
  };
  CHECK(2 * brightest(charred) < brightest(fresh));  // where the lamp is reflected
  // One half burnt: the other half has the colours it had.
  const Vec3f right = stage.camera.right();
  const Image half = draw([&](const Vec3f& X) { return right.dot(X) < -0.01f ? 1.0f : 0.0f; });
  const int reach = static_cast<int>(0.6 * stage.rim());
  CHECK(brightness(half, x - reach, y) < brightness(fresh, x - reach, y) / 2);
  CHECK(std::abs(brightness(half, x + reach, y) - brightness(fresh, x + reach, y)) <= 6);
  // A field covers it.
  stage.frame.field = Field::displacement;
  stage.frame.values.assign(stage.surface_mesh.rest.size(), 0.5f);
  const Image field = stage.draw();
  stage.frame.surface_mesh = std::make_shared<SurfaceMesh>(stage.surface_mesh);
  CHECK(count_different(field, stage.draw()) == 0);
}

TEST_CASE("an electrode is drawn on the skin, from its tip towards the eye") {
  Stage stage;
  const Image without = stage.draw();
  const Vec3f to_eye = (stage.camera.eye() - stage.camera.target()).normalized();
  stage.options.stroke.electrode = Electrode{stage.camera.target() + 0.05f * to_eye};
  const Image with = stage.draw();
  CHECK(count_different(with, without) > 100);
  CHECK_FALSE(same(with, without, size.width / 2 + 2, size.height / 2 - 3));
  CHECK(same(with, without, size.width / 2, size.height / 2 + 40));
}

TEST_CASE("nodes above their limit are hatched on tissue and on a colour map, and nothing else changes") {
  Stage stage;
  stage.options.ground = false;
  std::vector<float> excess(stage.surface_mesh.rest.size());
  for (std::size_t n = 0; n < excess.size(); ++n) excess[n] = stage.surface_mesh.rest[n].dot(stage.camera.right());
  for (const bool field : {false, true}) {
    CAPTURE(field);
    if (field) {
      stage.frame.field = Field::von_mises;
      stage.frame.values.assign(stage.surface_mesh.rest.size(), 50);
      stage.options.range = Range{0, 100};
    }
    stage.options.hatched = {};
    const Image plain = stage.draw();
    stage.options.hatched = excess;
    const Image hatched = stage.draw();
    int left = 0, right = 0;
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x) (x < size.width / 2 - 3 ? left : right) += !same(plain, hatched, x, y);
    CHECK(left == 0);
    const double half_disc = std::numbers::pi * stage.rim() * stage.rim() / 2;
    CHECK(right > 0.15 * half_disc);
    CHECK(right < 0.8 * half_disc);
    stage.options.hatched = {};
    CHECK(stage.draw().pixels == plain.pixels);
  }
}

TEST_CASE("picking a pixel returns the drawn surface point") {
  Stage stage;
  stage.options.ground = false;
  const Image image = stage.draw();
  Renderer empty;
  empty.draw(Frame{}, stage.camera, stage.options, size);
  const Image background = read_pixels(size);
  int wrong = 0, body = 0;
  for (int y = 0; y < size.height; y += 3)
    for (int x = 0; x < size.width; x += 3) {
      if (std::abs(from_middle(x, y) - stage.rim()) < 2) continue;  // antialiased edge, bulge of curved patches
      const bool shown = !same(image, background, x, y);
      const bool hit = pick(stage.frame, stage.surface_mesh, stage.camera.ray(x + 0.5f, y + 0.5f, size)).has_value();
      wrong += shown != hit;
      body += hit;
    }
  CHECK(body > 1000);
  CHECK(wrong == 0);
}

TEST_CASE("half resolution gives nearly the same image") {
  Stage stage;
  const Image whole = stage.draw();
  stage.options.resolution = 0.5f;
  const double difference = rms_difference(whole, stage.draw());
  CHECK(difference > 0);
  CHECK(difference < 8);
}

TEST_CASE("the ground stays where it is when the body falls, and hides nothing of it") {
  Stage stage;
  stage.camera.fit(Vec3f(0, -0.1f, 0), 0.25f, size);
  const Vec3f beside(0.3f, -0.055f, 0), body(0, 0, 0);
  const auto pixel = [&](const Image& image, const Vec3f& point) {
    const Vec2f at = stage.camera.pixel(point, size);
    const std::uint8_t* colour = image.at(static_cast<int>(at.x()), static_cast<int>(at.y()));
    return std::array{colour[0], colour[1], colour[2]};
  };
  const auto is_tissue = [](const std::array<std::uint8_t, 3>& colour) { return colour[0] > 1.5 * colour[2]; };
  const Image at_rest = stage.draw();
  REQUIRE(is_tissue(pixel(at_rest, body)));
  REQUIRE_FALSE(is_tissue(pixel(at_rest, beside)));
  for (const float fall : {0.02f, 0.07f, 0.2f}) {
    CAPTURE(fall);
    for (std::size_t k = 0; k < stage.frame.positions.size(); ++k)
      stage.frame.positions[k] = stage.surface_mesh.rest[k] - fall * Vec3f::UnitY();
    const Image fallen = stage.draw();
    CHECK(pixel(fallen, beside) == pixel(at_rest, beside));
    CHECK(is_tissue(pixel(fallen, body - fall * Vec3f::UnitY())));
  }
}

TEST_CASE("the ground is below a table, which it would hide") {
  Stage stage;
  stage.camera.fit(Vec3f(0, -0.1f, 0), 0.25f, size);
  TableState table;
  table.table.point = Vec3(0, -0.15, 0);
  const auto change = [&] {
    stage.frame.tools.clear();
    const Image bare = stage.draw();
    stage.frame.tools.push_back(table);
    const Image with_table = stage.draw();
    const Vec2f at = stage.camera.pixel(Vec3f(0, -0.15f, 0.07f), size);
    const int x = static_cast<int>(at.x()), y = static_cast<int>(at.y());
    return !same(bare, with_table, x, y);
  };
  CHECK(change());
}

TEST_CASE("tissue casts a shadow on a table") {
  Stage stage;
  stage.options.ground = false;
  TableState table;
  table.table.point = Vec3(0, -0.06, 0);
  stage.frame.tools.push_back(table);
  stage.camera.look(0, 1.2f);
  const auto brightness = [&](float height, const Vec3f& point) {
    for (std::size_t k = 0; k < stage.frame.positions.size(); ++k)
      stage.frame.positions[k] = stage.surface_mesh.rest[k] + height * Vec3f::UnitY();
    const Image image = stage.draw();
    const Vec2f at = stage.camera.pixel(point, size);
    const auto colour = image.at(static_cast<int>(at.x()), static_cast<int>(at.y()));
    return static_cast<int>(colour[0]) + static_cast<int>(colour[1]) + static_cast<int>(colour[2]);
  };
  // The lamp shines from (-0.50, 0.78, 0.38): the middle of the shadow is at (0.038, -0.06, -0.029).
  const Vec3f shaded(0.065f, -0.06f, -0.035f), lit(-0.06f, -0.06f, 0.04f);
  CHECK(brightness(0, shaded) < 0.7 * brightness(1, shaded));
  CHECK(brightness(0, lit) == brightness(1, lit));
}

TEST_CASE("refuses a frame of another body") {
  Stage stage;
  stage.frame.positions.pop_back();
  CHECK_THROWS_AS(stage.draw(), std::invalid_argument);
}

TEST_CASE("refuses to hatch another body") {
  Stage stage;
  const float one = 1;
  stage.options.hatched = std::span(&one, 1);
  CHECK_THROWS_AS(stage.draw(), std::invalid_argument);
}

TEST_CASE("survives frames with positions that are not finite") {
  Stage stage;
  for (Vec3f& node : stage.frame.positions) node.setConstant(std::nanf(""));
  CHECK_NOTHROW(stage.draw());
}

TEST_CASE("a section plane lays the inside open in the field's colours, and one beside it leaves the body whole") {
  Stage stage;
  const int middle = static_cast<int>(stage.surface_mesh.rest.size());
  Solid solid;
  solid.rest = stage.surface_mesh.rest;
  solid.rest.emplace_back(Vec3f::Zero());
  for (const auto& [a, b, c] : stage.surface_mesh.triangles) solid.tets.push_back({middle, a, b, c});
  solid.regions.assign(solid.tets.size(), 0);
  stage.frame.field = Field::displacement;
  stage.frame.values.assign(stage.surface_mesh.rest.size(), 0);
  stage.frame.solid = std::make_shared<const Solid>(solid);
  stage.frame.solid_positions = solid.rest;
  stage.frame.solid_values.assign(solid.rest.size(), 0);
  stage.options.range = Range{0, 1};
  const Image whole = stage.draw();
  stage.options.section = SectionPlane{Vec3f::UnitZ(), 0.06f};
  CHECK(count_different(whole, stage.draw()) < 10);  // at the rim, where back faces are no longer culled
  stage.options.section = SectionPlane{Vec3f::UnitZ(), 0};
  const Image opened = stage.draw();
  CHECK(count_different(whole, opened) > 1000);
  stage.frame.solid_values.back() = 1;
  const Image coloured = stage.draw();
  CHECK_FALSE(same(opened, coloured, size.width / 2, size.height / 2));
  stage.frame.solid_values.back() = 0;
  stage.options.section = SectionPlane{Vec3f(0.3f, 0.2f, 1).normalized(), 0.0031f};  // where round-off is either side
  const Image oblique = stage.draw();
  int least = 255, most = 0;
  for (int x = size.width / 2 - 30; x <= size.width / 2 + 30; x += 3)
    for (int y = size.height / 2 - 30; y <= size.height / 2 + 30; y += 3) {
      const int blue = oblique.at(x, y)[2];
      least = std::min(least, blue);
      most = std::max(most, blue);
    }
  CAPTURE(least);
  CHECK(most - least < 30);  // the cap has no holes
  stage.options.section.reset();
  CHECK(count_different(whole, stage.draw()) == 0);
}

}  // namespace heml::renderer_test
