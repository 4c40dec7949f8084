#include "app/render/solid_mesh.hpp"

#include <cmath>
#include <cstddef>
#include <heml/mesh/weld.hpp>
#include <numbers>

namespace heml::render {
namespace {

constexpr int sides = 14;

std::vector<Vec3f> positions_of(const SolidShape& shape) {
  std::vector<Vec3f> positions;
  for (const SolidShape::Vertex& vertex : shape.vertices) positions.push_back(vertex.position);
  return positions;
}

}  // namespace

void add_tube(SolidShape& shape, const std::vector<Ring>& rings, const Vec3f& depth_axis) {
  const auto first = static_cast<std::uint32_t>(shape.vertices.size());
  const std::size_t last = rings.size() - 1;
  for (std::size_t i = 0; i <= last; ++i) {
    const Vec3f along = (rings[std::min(i + 1, last)].centre - rings[i > 0 ? i - 1 : 0].centre).normalized();
    const Vec3f across = along.cross(depth_axis).normalized();
    for (int k = 0; k < sides; ++k) {
      const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(k) / sides;
      const float c = std::cos(angle), s = std::sin(angle);
      const Vec3f offset = rings[i].width * c * across + rings[i].depth * s * depth_axis;
      const Vec3f normal = rings[i].depth * c * across + rings[i].width * s * depth_axis;  // normal of an ellipse
      const Vec3f cap = i == 0 ? Vec3f(-along) : i == last ? along : Vec3f(Vec3f::Zero());
      shape.vertices.push_back({rings[i].centre + offset, (normal.normalized() + 0.7f * cap).normalized()});
    }
  }
  const auto vertex = [&](std::size_t ring, int k) {
    return first + static_cast<std::uint32_t>(ring * sides + k % sides);
  };
  for (std::size_t i = 0; i < last; ++i)
    for (int k = 0; k < sides; ++k)
      shape.triangles.insert(shape.triangles.end(), {vertex(i, k), vertex(i, k + 1), vertex(i + 1, k), vertex(i, k + 1),
                                                     vertex(i + 1, k + 1), vertex(i + 1, k)});
  for (const std::size_t ring : {std::size_t{0}, last})
    for (int k = 1; k + 1 < sides; ++k)
      shape.triangles.insert(shape.triangles.end(), {vertex(ring, 0), vertex(ring, k), vertex(ring, k + 1)});
}

void add_ball(SolidShape& shape, const Vec3f& centre, float radius) {
  std::vector<Ring> rings;
  constexpr int steps = 12;
  for (int i = 0; i <= steps; ++i) {
    const float angle = std::numbers::pi_v<float> * static_cast<float>(i) / steps;
    const float across = std::max(1e-3f, std::sin(angle)) * radius;
    rings.push_back({centre - Vec3f(0, radius * std::cos(angle), 0), across, across});
  }
  const std::size_t first = shape.vertices.size();
  add_tube(shape, rings, Vec3f::UnitZ());
  for (std::size_t k = first; k < shape.vertices.size(); ++k)
    shape.vertices[k].normal = (shape.vertices[k].position - centre).normalized();
}

SolidShape rod() {
  SolidShape shape;
  add_tube(shape, {{Vec3f::Zero(), 1, 1}, {Vec3f::UnitY(), 1, 1}}, Vec3f::UnitZ());
  return shape;
}

SolidShape forceps_jaw() {
  SolidShape shape;
  std::vector<Ring> rings;
  constexpr int steps = 28;
  for (int i = 0; i <= steps; ++i) {
    const float t = static_cast<float>(i) / steps;
    const float bow = std::pow(std::sin(std::numbers::pi_v<float> * std::pow(t, 0.8f)), 1.2f);
    const float swell = std::sin(0.5f * std::numbers::pi_v<float> * std::min(1.0f, 1.6f * t));
    rings.push_back(
        {Vec3f(0.006f + 0.052f * bow, t, 0), 0.006f + 0.004f * t, 0.007f + 0.020f * std::pow(swell, 1.5f)});
  }
  add_tube(shape, rings, Vec3f::UnitZ());
  add_tube(shape, {{Vec3f(0, 0.93f, 0), 0.012f, 0.024f}, {Vec3f(0, 1.03f, 0), 0.014f, 0.022f}}, Vec3f::UnitZ());
  return shape;
}

SolidShape ball() {
  SolidShape shape;
  add_ball(shape, Vec3f::Zero(), 1);
  return shape;
}

SolidShape disc() {
  constexpr std::uint32_t round = 96, rings = 40;
  SolidShape shape;
  const auto vertex = [&](const Vec3f& position, const Vec3f& normal) { shape.vertices.push_back({position, normal}); };
  const auto at = [](std::uint32_t k) {
    const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(k) / round;
    return Vec3f(std::cos(angle), 0, std::sin(angle));
  };
  const Vec3f up = Vec3f::UnitY();
  vertex(Vec3f::Zero(), up);
  vertex(-up, -up);
  for (std::uint32_t k = 0; k < round; ++k) {  // round the side and the bottom
    vertex(at(k), at(k));
    vertex(at(k) - up, at(k));
    vertex(at(k) - up, -up);
  }
  for (std::uint32_t ring = 1; ring <= rings; ++ring)
    for (std::uint32_t k = 0; k < round; ++k) vertex(static_cast<float>(ring) / rings * at(k), up);
  const std::uint32_t top = 2 + 3 * round;  // the innermost ring
  for (std::uint32_t k = 0; k < round; ++k) {
    const std::uint32_t next = (k + 1) % round, a = 2 + 3 * k, b = 2 + 3 * next;
    for (const std::uint32_t i : {a, b, a + 1, b, b + 1, a + 1, 1u, a + 2, b + 2, 0u, top + next, top + k})
      shape.triangles.push_back(i);
    for (std::uint32_t inner = top; inner < top + (rings - 1) * round; inner += round)
      for (const std::uint32_t i :
           {inner + k, inner + next, inner + round + k, inner + next, inner + round + next, inner + round + k})
        shape.triangles.push_back(i);
  }
  return shape;
}

SolidShape needle() {
  SolidShape shape;
  add_tube(shape,
           {{Vec3f::Zero(), 0.004f, 0.004f}, {Vec3f(0, 0.15f, 0), 0.02f, 0.02f}, {Vec3f(0, 0.9f, 0), 0.02f, 0.02f}},
           Vec3f::UnitZ());
  add_ball(shape, Vec3f(0, 0.88f, 0), 0.12f);
  return shape;
}

SolidShape scalpel_blade() {
  constexpr float thickness = 0.06f, bevel = 0.4f, shoulder = 0.3f;
  SolidShape shape;
  // Cross-sections from the tip up: the back comes forward to the tip below the shoulder.
  constexpr int steps = 10;
  const auto facet = [&](const std::array<Vec3f, 4>& corners, const Vec3f& outward) {
    const Vec3f normal = (corners[2] - corners[0]).cross(corners[3] - corners[1]);
    const bool turned = normal.dot(outward) < 0;
    const auto first = static_cast<std::uint32_t>(shape.vertices.size());
    for (std::size_t k = 0; k < 4; ++k)
      shape.vertices.push_back({corners[turned ? 3 - k : k], (turned ? Vec3f(-normal) : normal).normalized()});
    for (const std::uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) shape.triangles.push_back(first + k);
  };
  const auto profile = [&](int step) {
    const float y = step < steps ? shoulder * static_cast<float>(step) / steps : 1;
    const float back = step < steps ? std::max(0.02f, std::sin(0.5f * std::numbers::pi_v<float> * y / shoulder)) : 1;
    return std::array{Vec3f(0, y, 0), Vec3f(bevel * back, y, thickness), Vec3f(back, y, thickness),
                      Vec3f(back, y, -thickness), Vec3f(bevel * back, y, -thickness)};
  };
  const std::array outwards{Vec3f(-0.2f, 0, 1), Vec3f(0, 0, 1), Vec3f(1, -0.2f, 0), Vec3f(0, 0, -1),
                            Vec3f(-0.2f, 0, -1)};
  for (int step = 0; step < steps; ++step) {
    const auto low = profile(step), high = profile(step + 1);
    for (std::size_t k = 0; k < 5; ++k) facet({low[k], low[(k + 1) % 5], high[(k + 1) % 5], high[k]}, outwards[k]);
  }
  const auto top = profile(steps);
  facet({top[0], top[1], top[2], top[3]}, Vec3f::UnitY());
  facet({top[0], top[3], top[4], top[0]}, Vec3f::UnitY());
  return shape;
}

SolidShape scalpel_handle() {
  SolidShape shape;
  add_tube(shape,
           {{Vec3f(0, -0.02f, 0), 0.028f, 0.010f},
            {Vec3f(0, 0.05f, 0), 0.032f, 0.013f},
            {Vec3f(0, 0.16f, 0), 0.024f, 0.014f},
            {Vec3f(0, 0.35f, 0), 0.034f, 0.015f},
            {Vec3f(0, 0.90f, 0), 0.036f, 0.014f},
            {Vec3f(0, 1, 0), 0.026f, 0.010f}},
           Vec3f::UnitZ());
  return shape;
}

SolidShape scissors_half() {
  constexpr float beside = 0.014f;  // the halves lie on each other
  SolidShape shape;
  add_tube(shape,
           {{Vec3f(0, -0.06f, beside), 0.030f, 0.012f},
            {Vec3f(0.006f, 0.05f, beside), 0.050f, 0.013f},
            {Vec3f(0.010f, 0.5f, beside), 0.040f, 0.011f},
            {Vec3f(0.004f, 0.9f, beside), 0.018f, 0.009f},
            {Vec3f(0, 1, beside), 0.004f, 0.004f}},
           Vec3f::UnitZ());
  add_tube(shape,
           {{Vec3f(0, 0, beside), 0.040f, 0.014f},
            {Vec3f(-0.02f, -0.3f, beside), 0.026f, 0.018f},
            {Vec3f(-0.06f, -0.8f, beside), 0.024f, 0.020f},
            {Vec3f(-0.10f, -1.02f, beside), 0.022f, 0.020f}},
           Vec3f::UnitZ());
  std::vector<Ring> rings;
  constexpr int steps = 20;
  for (int i = 0; i <= steps; ++i) {
    const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / steps;
    rings.push_back({Vec3f(-0.15f + 0.13f * std::sin(angle), -1.18f + 0.17f * std::cos(angle), beside), 0.024f, 0.022f});
  }
  add_tube(shape, rings, Vec3f::UnitZ());
  return shape;
}

SolidMesh::SolidMesh(SolidShape shape)
    : shape_(std::move(shape)), positions_(positions_of(shape_)), outline_(shape_.triangles, weld(positions_)) {
  for (const Vec3f& position : positions_) box_.extend(position);
  const auto describe = [](std::size_t stride) {
    vertex_attribute(0, 3, GL_FLOAT, stride, offsetof(SolidShape::Vertex, position));
    vertex_attribute(1, 3, GL_FLOAT, stride, offsetof(SolidShape::Vertex, normal));
  };
  glBindVertexArray(array_);
  upload(GL_ARRAY_BUFFER, vertices_, std::span<const SolidShape::Vertex>(shape_.vertices), GL_STATIC_DRAW);
  upload(GL_ELEMENT_ARRAY_BUFFER, triangles_, std::span<const std::uint32_t>(shape_.triangles), GL_STATIC_DRAW);
  describe(sizeof(SolidShape::Vertex));
  glBindVertexArray(strip_array_);
  glBindBuffer(GL_ARRAY_BUFFER, strip_buffer_);
  describe(sizeof(Strip));
  vertex_attribute(2, 3, GL_FLOAT, sizeof(Strip), offsetof(Strip, strip));
}

void SolidMesh::draw() const {
  glBindVertexArray(array_);
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(shape_.triangles.size()), GL_UNSIGNED_INT, nullptr);
}

void SolidMesh::draw_outline(const Vec3f& eye, const Mat4f& to_clip, Size size) {
  strips_.clear();
  Outline::for_each_corner(outline_.find(positions_, eye, to_clip, size),
                           [&](std::uint32_t vertex, const Vec2f& outward, float cover) {
                             strips_.push_back({shape_.vertices[vertex], {outward.x(), outward.y(), cover}});
                           });
  upload(GL_ARRAY_BUFFER, strip_buffer_, std::span<const Strip>(strips_), GL_STREAM_DRAW);
  glBindVertexArray(strip_array_);
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(strips_.size()));
}

}  // namespace heml::render
