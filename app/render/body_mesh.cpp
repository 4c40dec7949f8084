#include "app/render/body_mesh.hpp"

#include <app/render/palette.hpp>
#include <cmath>
#include <cstddef>

namespace heml::render {
namespace {

std::uint8_t byte(float value) { return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0f, 1.0f))); }

float mean_edge(const SurfaceMesh& surface_mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : surface_mesh.triangles)
    sum += (surface_mesh.rest[a] - surface_mesh.rest[b]).norm() + (surface_mesh.rest[b] - surface_mesh.rest[c]).norm() +
           (surface_mesh.rest[c] - surface_mesh.rest[a]).norm();
  return surface_mesh.triangles.empty()
             ? 0
             : static_cast<float>(sum / (3.0 * static_cast<double>(surface_mesh.triangles.size())));
}

// Mean tint of the triangles at each corner, which blends neighbouring regions.
std::vector<Vec3f> corner_tints(const SurfaceMesh& surface_mesh, const SurfaceTopology& topology) {
  std::vector<Vec3f> tints(topology.corner_nodes.size(), Vec3f::Zero());
  std::vector<float> counts(tints.size(), 0);
  for (std::size_t t = 0; t < topology.triangles.size(); ++t)
    for (const int corner : topology.triangles[t]) {
      tints[corner] += tissue_tint(t < surface_mesh.regions.size() ? surface_mesh.regions[t] : 0);
      counts[corner] += 1;
    }
  for (std::size_t c = 0; c < tints.size(); ++c) tints[c] /= counts[c];
  return tints;
}

}  // namespace

BodyMesh::BodyMesh(const SurfaceMesh& surface_mesh, const TissueLook& look, std::optional<Wound> wound)
    : wound_(wound && !wound->empty() ? std::move(wound) : std::nullopt),
      surface_(surface_mesh, SmoothSurface::suitable_segments(surface_mesh.triangles.size()),
               wound_ ? std::span<const char>(wound_->exposed()) : std::span<const char>()),
      nodes_(surface_mesh.rest.size()),
      rest_(bounding_sphere(uncut_surface(surface_mesh).rest)),
      is_burnt_(!surface_mesh.burnt.empty()),
      bead_radius_(std::min(0.4f * mean_edge(uncut_surface(surface_mesh)), 0.022f * rest_.radius)),
      outline_(surface_.triangles(), surface_.joined_vertices()) {
  if (wound_) find_wound_vertices();
  describe_vertices();
  upload_fixed(surface_mesh, look);
  upload_indices(surface_mesh);
}

void BodyMesh::find_wound_vertices() {
  in_wound_.assign(surface_.blends().size(), 0);
  for (std::size_t i = 0; i < surface_.triangles().size(); ++i)
    in_wound_[surface_.triangles()[i]] =
        wound_->exposed()[i / (surface_.triangles().size() / wound_->exposed().size())];
}

void BodyMesh::describe_vertices() {
  const auto moving = [](std::size_t stride) {
    vertex_attribute(0, 3, GL_FLOAT, stride, offsetof(Moving, position));
    vertex_attribute(1, 3, GL_FLOAT, stride, offsetof(Moving, normal));
    vertex_attribute(2, 1, GL_FLOAT, stride, offsetof(Moving, value));
  };
  const auto fixed = [](std::size_t stride, std::size_t offset) {
    vertex_attribute(3, 3, GL_FLOAT, stride, offset + offsetof(Fixed, rest));
    vertex_attribute(4, 3, GL_FLOAT, stride, offset + offsetof(Fixed, on_sphere));
    vertex_attribute(5, 4, GL_UNSIGNED_BYTE, stride, offset + offsetof(Fixed, surface));
    vertex_attribute(8, 1, GL_FLOAT, stride, offset + offsetof(Fixed, depth));
    vertex_attribute(11, 1, GL_FLOAT, stride, offset + offsetof(Fixed, burnt));
  };
  glBindVertexArray(array_);
  glBindBuffer(GL_ARRAY_BUFFER, moving_buffer_);
  moving(sizeof(Moving));
  glBindBuffer(GL_ARRAY_BUFFER, fixed_buffer_);
  fixed(sizeof(Fixed), 0);
  glBindVertexArray(strip_array_);
  glBindBuffer(GL_ARRAY_BUFFER, strip_buffer_);
  moving(sizeof(Strip));
  fixed(sizeof(Strip), offsetof(Strip, fixed));
  vertex_attribute(6, 3, GL_FLOAT, sizeof(Strip), offsetof(Strip, strip));
}

void BodyMesh::upload_indices(const SurfaceMesh& surface_mesh) {
  glBindVertexArray(array_);
  const auto fill = [](Indices& indices, const std::vector<std::uint32_t>& values) {
    upload(GL_ELEMENT_ARRAY_BUFFER, indices.buffer, std::span(values), GL_STATIC_DRAW);
    indices.count = static_cast<GLsizei>(values.size());
  };
  std::vector<std::uint32_t> skin, raw;
  for (const std::uint32_t vertex : surface_.triangles())
    (!in_wound_.empty() && in_wound_[vertex] ? raw : skin).push_back(vertex);
  fill(skin_, skin);
  fill(raw_, raw);
  fill(lines_, surface_.lines());
  std::vector<std::uint32_t> flat, constrained;
  for (const Triangle& corners : surface_.topology().triangles) flat.insert(flat.end(), corners.begin(), corners.end());
  fill(flat_, flat);
  std::vector<char> is_constrained(surface_mesh.rest.size(), 0);
  for (const int node : surface_mesh.constrained) is_constrained[node] = 1;
  const std::vector<int>& corner_nodes = surface_.topology().corner_nodes;
  for (std::size_t c = 0; c < corner_nodes.size(); ++c)
    if (std::exchange(is_constrained[corner_nodes[c]], 0)) constrained.push_back(static_cast<std::uint32_t>(c));
  fill(constrained_, constrained);
}

void BodyMesh::upload_fixed(const SurfaceMesh& surface_mesh, const TissueLook& look) {
  const std::vector<Vec3f> tints = corner_tints(surface_mesh, surface_.topology());
  std::vector<Vec3f> rest, on_sphere;
  std::vector<float> open, burnt;
  surface_.spread(std::span<const Vec3f>(surface_mesh.rest), rest);
  surface_.spread(std::span<const Vec3f>(look.on_sphere), on_sphere);
  surface_.spread(std::span<const float>(look.ambient_occlusion), open);
  if (is_burnt_) surface_.spread(std::span<const float>(surface_mesh.burnt), burnt);
  fixed_.resize(rest.size());
  for (std::size_t p = 0; p < fixed_.size(); ++p) {
    const auto& [c, w] = surface_.blends()[p];
    const Vec3f tint = (w[0] * tints[c[0]] + w[1] * tints[c[1]] + w[2] * tints[c[2]]).cwiseSqrt();
    fixed_[p] = {(rest[p] - rest_.centre) / rest_.radius,
                 on_sphere[p],
                 {byte(tint.x()), byte(tint.y()), byte(tint.z()), byte(open[p])},
                 wound_ && in_wound_[p] ? wound_->skin().nearest(rest[p]).depth / rest_.radius : 0,
                 is_burnt_ ? burnt[p] : 0};
  }
  upload(GL_ARRAY_BUFFER, fixed_buffer_, std::span<const Fixed>(fixed_), GL_STATIC_DRAW);
}

void BodyMesh::update(const Frame& frame, const Range& range) {
  if (wound_) placed_ = wound_->place(frame.positions);
  surface_.update(wound_ ? placed_ : frame.positions);
  moving_.resize(surface_.positions().size());
  const bool has_values = frame.values.size() == nodes_;
  if (has_values) surface_.spread(std::span<const float>(frame.values), values_);
  if (wound_ && !has_values) surface_.spread(std::span<const float>(wound_->openness()), values_);
  const float scale = 1 / std::max(range.high - range.low, 1e-30f);
  for (std::size_t p = 0; p < moving_.size(); ++p)
    moving_[p] = {surface_.positions()[p], surface_.normals()[p],
                  has_values ? (values_[p] - range.low) * scale
                  : wound_   ? values_[p]
                             : 0};
  upload(GL_ARRAY_BUFFER, moving_buffer_, std::span<const Moving>(moving_), GL_STREAM_DRAW);
}

void BodyMesh::update_hatching(std::span<const float> beyond) {
  glBindVertexArray(array_);
  if (beyond.empty()) return glDisableVertexAttribArray(7);
  surface_.spread(beyond, beyond_);
  upload(GL_ARRAY_BUFFER, beyond_buffer_, std::span<const float>(beyond_), GL_STREAM_DRAW);
  vertex_attribute(7, 1, GL_FLOAT, sizeof(float), 0);
}

void BodyMesh::update_outline(const Vec3f& eye, const Mat4f& view_projection, Size size) {
  strips_.clear();
  const std::vector<Outline::Piece>& pieces = outline_.find(surface_.positions(), eye, view_projection, size);
  const auto add = [&](bool of_wound) {
    Outline::for_each_corner(pieces, [&](std::uint32_t vertex, const Vec2f& outward, float cover) {
      if (in_wound_.empty() || (in_wound_[vertex] != 0) == of_wound)
        strips_.push_back({moving_[vertex], fixed_[vertex], {outward.x(), outward.y(), cover}});
    });
  };
  add(false);
  skin_strips_ = strips_.size();
  if (wound_) add(true);
  upload(GL_ARRAY_BUFFER, strip_buffer_, std::span<const Strip>(strips_), GL_STREAM_DRAW);
}

void BodyMesh::draw_strips(std::size_t first, std::size_t last) const {
  glBindVertexArray(strip_array_);
  glDrawArrays(GL_TRIANGLES, static_cast<GLint>(first), static_cast<GLsizei>(last - first));
}

void BodyMesh::draw(GLenum mode, const Indices& indices) const {
  glBindVertexArray(array_);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices.buffer);
  glDrawElements(mode, indices.count, GL_UNSIGNED_INT, nullptr);
}

void BodyMesh::draw_skin() const { draw(GL_TRIANGLES, skin_); }
void BodyMesh::draw_skin_outline() const { draw_strips(0, skin_strips_); }
void BodyMesh::draw_wound() const { draw(GL_TRIANGLES, raw_); }
void BodyMesh::draw_wound_outline() const { draw_strips(skin_strips_, strips_.size()); }
void BodyMesh::draw_flat() const { draw(GL_TRIANGLES, flat_); }
void BodyMesh::draw_edges() const { draw(GL_LINES, lines_); }
void BodyMesh::draw_constrained() const { draw(GL_POINTS, constrained_); }

}  // namespace heml::render
