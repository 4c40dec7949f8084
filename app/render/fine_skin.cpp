#include "app/render/fine_skin.hpp"

#include <fmt/format.h>

#include <app/render/palette.hpp>
#include <app/render/png.hpp>
#include <cstddef>
#include <heml/base/error.hpp>
#include <heml/mesh/improve/surface_tree.hpp>
#include <heml/mesh/weld.hpp>
#include <numeric>

namespace heml::render {
namespace {

constexpr std::size_t vertices_per_thread = 4000;

std::uint8_t as_byte(float value) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0f, 1.0f)));
}

std::vector<Vec3f> rest_of(const Skin& skin) {
  std::vector<Vec3f> rest;
  for (const Vec3& x : skin.surface.mesh.nodes) rest.push_back(x.cast<float>());
  return rest;
}

}  // namespace

FineSkin::FineSkin(std::shared_ptr<const Skin> skin, const SurfaceMesh& body, const TissueLook& look,
                   const BoundingSphere& rest, FineSkin* last)
    : skin_(std::move(skin)), team_(0), same_(skin_->same.empty() ? weld(rest_of(*skin_)) : skin_->same) {
  const TexturedSurface& surface = skin_->surface;
  painted_ = !surface.texture.empty() || !surface.colours.empty();
  for (const Triangle& t : surface.mesh.triangles)
    for (const int n : t) indices_.push_back(static_cast<std::uint32_t>(n));
  find_fans();
  if (skin_->anchors.empty())
    find_anchors(body);
  else
    take_anchors(body);
  std::vector<std::uint32_t> welded;  // a seam is no sharp edge
  for (const std::uint32_t v : indices_) welded.push_back(same_[v]);
  outline_.emplace(welded, same_);
  describe_vertices();
  upload_fixed(look, rest);
  if (painted_) upload_texture(last);
}

/// Triangles by the vertices round which they lie, seams closed.
void FineSkin::find_fans() {
  fan_first_.assign(same_.size() + 1, 0);
  for (const std::uint32_t v : indices_) ++fan_first_[same_[v] + 1];
  std::partial_sum(fan_first_.begin(), fan_first_.end(), fan_first_.begin());
  fans_.resize(indices_.size());
  std::vector<std::uint32_t> next(fan_first_.begin(), fan_first_.end() - 1);
  for (std::size_t i = 0; i < indices_.size(); ++i)
    fans_[next[same_[indices_[i]]]++] = static_cast<std::uint32_t>(i / 3);
}

void FineSkin::find_anchors(const SurfaceMesh& body) {
  TriangleMesh surface;
  for (const Vec3f& x : body.rest) surface.nodes.push_back(x.cast<double>());
  surface.triangles = body.triangles;
  const SurfaceTree tree(std::move(surface));
  const std::vector<Vec3>& nodes = skin_->surface.mesh.nodes;
  anchors_.resize(nodes.size());
  regions_.resize(nodes.size());
  team_.parallel_for(nodes.size(), vertices_per_thread, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const SurfaceTree::Nearest nearest = tree.nearest(nodes[v]);
      const auto [a, b, c] = tree.corners(nearest.triangle);
      const Vec3 normal = (b - a).cross(c - a);
      const double area = std::max(normal.squaredNorm(), 1e-300);
      const double second = (nearest.point - a).cross(c - a).dot(normal) / area;
      const double third = (b - a).cross(nearest.point - a).dot(normal) / area;
      anchors_[v] = {body.triangles[static_cast<std::size_t>(nearest.triangle)],
                     {static_cast<float>(1 - second - third), static_cast<float>(second), static_cast<float>(third)}};
      regions_[v] = body.regions.empty() ? 0 : body.regions[static_cast<std::size_t>(nearest.triangle)];
    }
  });
}

/// Those of a cut skin. Vertices that no triangle has may name nodes that the surface lacks.
void FineSkin::take_anchors(const SurfaceMesh& body) {
  anchors_.resize(skin_->anchors.size());
  regions_.resize(skin_->anchors.size());
  for (std::size_t v = 0; v < anchors_.size(); ++v) {
    const SkinAnchor& anchor = skin_->anchors[v];
    anchors_[v].weights = anchor.weights;
    regions_[v] = anchor.region;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto found = std::lower_bound(body.nodes.begin(), body.nodes.end(), anchor.nodes[k]);
      anchors_[v].nodes[k] = found == body.nodes.end() ? 0 : static_cast<int>(found - body.nodes.begin());
    }
  }
}

template <class Value>
Value FineSkin::value_at(std::size_t vertex, std::span<const Value> of_nodes) const {
  const auto& [n, w] = anchors_[vertex];
  return w[0] * of_nodes[static_cast<std::size_t>(n[0])] + w[1] * of_nodes[static_cast<std::size_t>(n[1])] +
         w[2] * of_nodes[static_cast<std::size_t>(n[2])];
}

void FineSkin::describe_vertices() {
  const auto moving = [](std::size_t stride) {
    vertex_attribute(0, 3, GL_FLOAT, stride, offsetof(Moving, position));
    vertex_attribute(1, 3, GL_FLOAT, stride, offsetof(Moving, normal));
    vertex_attribute(2, 1, GL_FLOAT, stride, offsetof(Moving, value));
  };
  const auto fixed = [](std::size_t stride, std::size_t offset) {
    vertex_attribute(3, 3, GL_FLOAT, stride, offset + offsetof(Fixed, rest));
    vertex_attribute(4, 3, GL_FLOAT, stride, offset + offsetof(Fixed, on_sphere));
    vertex_attribute(5, 4, GL_UNSIGNED_BYTE, stride, offset + offsetof(Fixed, surface));
    vertex_attribute(9, 2, GL_FLOAT, stride, offset + offsetof(Fixed, place));
    vertex_attribute(10, 4, GL_UNSIGNED_BYTE, stride, offset + offsetof(Fixed, colour));
    vertex_attribute(11, 1, GL_FLOAT, stride, offset + offsetof(Fixed, burnt));
  };
  glBindVertexArray(array_);
  glBindBuffer(GL_ARRAY_BUFFER, moving_buffer_);
  moving(sizeof(Moving));
  glBindBuffer(GL_ARRAY_BUFFER, fixed_buffer_);
  fixed(sizeof(Fixed), 0);
  upload(GL_ELEMENT_ARRAY_BUFFER, index_buffer_, std::span<const std::uint32_t>(indices_), GL_STATIC_DRAW);
  glBindVertexArray(strip_array_);
  glBindBuffer(GL_ARRAY_BUFFER, strip_buffer_);
  moving(sizeof(Strip));
  fixed(sizeof(Strip), offsetof(Strip, fixed));
  vertex_attribute(6, 3, GL_FLOAT, sizeof(Strip), offsetof(Strip, strip));
}

void FineSkin::upload_fixed(const TissueLook& look, const BoundingSphere& rest) {
  const TexturedSurface& surface = skin_->surface;
  fixed_.resize(anchors_.size());
  for (std::size_t v = 0; v < fixed_.size(); ++v) {
    const auto& [n, w] = anchors_[v];
    const Vec3f tint = tissue_tint(regions_[v]).cwiseSqrt();
    Vec3f on_sphere = Vec3f::Zero();
    for (std::size_t i = 0; i < 3; ++i) on_sphere += w[i] * look.on_sphere[static_cast<std::size_t>(n[i])];
    Fixed& fixed = fixed_[v];
    fixed.rest = (surface.mesh.nodes[v].cast<float>() - rest.centre) / rest.radius;
    fixed.on_sphere = on_sphere;
    fixed.surface = {as_byte(tint.x()), as_byte(tint.y()), as_byte(tint.z()),
                     as_byte(value_at(v, std::span<const float>(look.ambient_occlusion)))};
    fixed.place = surface.places.empty() ? Vec2f(Vec2f::Zero()) : Vec2f(surface.places[v][0], surface.places[v][1]);
    // A texture is the whole colour: exporters leave a white or grey diffuse factor beside it.
    const Vec3f colour =
        surface.colours.empty() || !surface.texture.empty() ? Vec3f(Vec3f::Ones()) : surface.colours[v];
    fixed.colour = {as_byte(colour.x()), as_byte(colour.y()), as_byte(colour.z()), 255};
  }
  upload(GL_ARRAY_BUFFER, fixed_buffer_, std::span<const Fixed>(fixed_), GL_STATIC_DRAW);
}

void FineSkin::set_burnt(std::span<const float> burnt) {
  if (burnt.empty() && !is_burnt_) return;
  is_burnt_ = !burnt.empty();
  for (std::size_t v = 0; v < fixed_.size(); ++v) fixed_[v].burnt = is_burnt_ ? value_at(v, burnt) : 0;
  glBindVertexArray(array_);
  upload(GL_ARRAY_BUFFER, fixed_buffer_, std::span<const Fixed>(fixed_), GL_STATIC_DRAW);
}

void FineSkin::upload_texture(FineSkin* last) {
  if (last && last->painted_ && last->skin_->surface.texture == skin_->surface.texture) {
    texture_ = std::move(last->texture_);
    return;
  }
  Image image(Size{1, 1});
  std::fill(image.pixels.begin(), image.pixels.end(), std::uint8_t{255});
  const std::filesystem::path& file = skin_->surface.texture;
  if (!file.empty()) image = read_png(file);
  GLint largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  if (image.size.width > largest || image.size.height > largest)
    throw InputError(file.string(), "", fmt::format("is {} x {} pixels", image.size.width, image.size.height),
                     fmt::format("at most {} a side on this machine", largest));
  allocate_texture(texture_, GL_RGB8, GL_RGB, GL_UNSIGNED_BYTE, image.size);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  // Images begin with the top row, textures with the lowest.
  for (int y = 0; y < image.size.height; ++y)
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, image.size.height - 1 - y, image.size.width, 1, GL_RGB, GL_UNSIGNED_BYTE,
                    image.at(0, y));
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glGenerateMipmap(GL_TEXTURE_2D);
}

void FineSkin::move(const Frame& frame, std::span<const Vec3f> placed) {
  const Embedding& embedding = skin_->embedding;
  std::vector<Vec3f> shifts(placed.size());
  for (std::size_t n = 0; n < placed.size(); ++n) shifts[n] = placed[n] - frame.positions[n];
  positions_.resize(embedding.size());
  team_.parallel_for(positions_.size(), vertices_per_thread, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      positions_[v] = embedding.at<Vec3f>(v, frame.solid_positions);
      if (!shifts.empty()) positions_[v] += value_at(v, std::span<const Vec3f>(shifts));
    }
  });
}

/// Means of the triangles round a vertex, weighted by area.
void FineSkin::find_normals() {
  face_normals_.resize(indices_.size() / 3);
  team_.parallel_for(face_normals_.size(), vertices_per_thread, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const Vec3f &a = positions_[indices_[3 * t]], &b = positions_[indices_[3 * t + 1]],
                  &c = positions_[indices_[3 * t + 2]];
      face_normals_[t] = (b - a).cross(c - a);
    }
  });
  normals_.resize(positions_.size());
  team_.parallel_for(normals_.size(), vertices_per_thread, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      Vec3f sum = Vec3f::Zero();
      for (std::uint32_t k = fan_first_[same_[v]]; k < fan_first_[same_[v] + 1]; ++k) sum += face_normals_[fans_[k]];
      const float length = sum.norm();
      normals_[v] = length > 0 ? Vec3f(sum / length) : Vec3f(Vec3f::Zero());
    }
  });
}

void FineSkin::update(const Frame& frame, const Range& range, std::span<const Vec3f> placed) {
  move(frame, placed);
  find_normals();
  const float scale = 1 / std::max(range.high - range.low, 1e-30f);
  const bool has_values = !frame.values.empty();
  moving_.resize(positions_.size());
  team_.parallel_for(moving_.size(), vertices_per_thread, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v)
      moving_[v] = {positions_[v], normals_[v],
                    has_values ? (value_at(v, std::span<const float>(frame.values)) - range.low) * scale : 0};
  });
  upload(GL_ARRAY_BUFFER, moving_buffer_, std::span<const Moving>(moving_), GL_STREAM_DRAW);
}

void FineSkin::update_hatching(std::span<const float> beyond) {
  glBindVertexArray(array_);
  if (beyond.empty()) return glDisableVertexAttribArray(7);
  beyond_.resize(anchors_.size());
  for (std::size_t v = 0; v < beyond_.size(); ++v) beyond_[v] = value_at(v, beyond);
  upload(GL_ARRAY_BUFFER, beyond_buffer_, std::span<const float>(beyond_), GL_STREAM_DRAW);
  vertex_attribute(7, 1, GL_FLOAT, sizeof(float), 0);
}

void FineSkin::update_outline(const Vec3f& eye, const Mat4f& view_projection, Size size) {
  strips_.clear();
  const std::vector<Outline::Piece>& pieces = outline_->find(positions_, eye, view_projection, size);
  Outline::for_each_corner(pieces, [&](std::uint32_t vertex, const Vec2f& outward, float cover) {
    strips_.push_back({moving_[vertex], fixed_[vertex], {outward.x(), outward.y(), cover}});
  });
  upload(GL_ARRAY_BUFFER, strip_buffer_, std::span<const Strip>(strips_), GL_STREAM_DRAW);
}

void FineSkin::draw() const {
  glBindVertexArray(array_);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, index_buffer_);
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(indices_.size()), GL_UNSIGNED_INT, nullptr);
}

void FineSkin::draw_outline() const {
  glBindVertexArray(strip_array_);
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(strips_.size()));
}

}  // namespace heml::render
