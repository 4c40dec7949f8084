#include <algorithm>
#include <app/render/palette.hpp>
#include <app/render/section_cap.hpp>
#include <cmath>
#include <cstddef>

namespace heml::render {
namespace {

std::array<std::uint8_t, 4> tint_bytes(int region) {
  std::array<std::uint8_t, 4> bytes{0, 0, 0, 255};
  const Vec3f tint = tissue_tint(region).cwiseSqrt();
  for (int k = 0; k < 3; ++k)
    bytes[static_cast<std::size_t>(k)] =
        static_cast<std::uint8_t>(std::lround(255 * std::clamp(tint[k], 0.0f, 1.0f)));
  return bytes;
}

}  // namespace

void SectionCap::adopt(const Frame& frame) {
  if (frame.solid == solid_) return;
  solid_ = frame.solid;
  depths_.assign(solid_->rest.size(), std::nanf(""));
  const auto& whole = frame.surface_mesh->whole ? frame.surface_mesh->whole : frame.surface_mesh;
  if (whole == whole_) return;
  whole_ = whole;
  TriangleMesh skin;
  for (const Vec3f& node : whole->rest) skin.nodes.push_back(node.cast<double>());
  skin.triangles = whole->triangles;
  skin_.emplace(std::move(skin));
}

float SectionCap::depth_of(int node) {
  const auto n = static_cast<std::size_t>(node);
  if (std::isnan(depths_[n])) depths_[n] = static_cast<float>(skin_->nearest(solid_->rest[n].cast<double>()).distance);
  return depths_[n];
}

void SectionCap::update(const Frame& frame, const SectionPlane& plane, const Range& range, const BoundingSphere& rest) {
  vertices_.clear();
  if (!frame.solid || !frame.surface_mesh || frame.solid_positions.size() != frame.solid->rest.size()) return;
  adopt(frame);
  const bool has_values = frame.solid_values.size() == solid_->rest.size();
  const float scale = 1 / std::max(range.high - range.low, 1e-30f);
  for (const SectionTriangle& triangle : cut_section(*solid_, frame.solid_positions, plane))
    for (const SectionCorner& corner : triangle.corners) {
      const float near = depth_of(corner.nodes[0]), far = depth_of(corner.nodes[1]);
      vertices_.push_back({at_corner(corner, frame.solid_positions), plane.normal,
                           has_values ? (at_corner(corner, frame.solid_values) - range.low) * scale : 1,
                           (at_corner(corner, solid_->rest) - rest.centre) / rest.radius,
                           tint_bytes(solid_->regions[static_cast<std::size_t>(triangle.element)]),
                           (near + corner.share * (far - near)) / rest.radius,
                           is_burnt() ? at_corner(corner, solid_->burnt) : 0});
    }
  glBindVertexArray(array_);
  upload(GL_ARRAY_BUFFER, buffer_, std::span<const Vertex>(vertices_), GL_STREAM_DRAW);
  vertex_attribute(0, 3, GL_FLOAT, sizeof(Vertex), offsetof(Vertex, position));
  vertex_attribute(1, 3, GL_FLOAT, sizeof(Vertex), offsetof(Vertex, normal));
  vertex_attribute(2, 1, GL_FLOAT, sizeof(Vertex), offsetof(Vertex, value));
  vertex_attribute(3, 3, GL_FLOAT, sizeof(Vertex), offsetof(Vertex, rest));
  vertex_attribute(5, 4, GL_UNSIGNED_BYTE, sizeof(Vertex), offsetof(Vertex, surface));
  vertex_attribute(8, 1, GL_FLOAT, sizeof(Vertex), offsetof(Vertex, depth));
  vertex_attribute(11, 1, GL_FLOAT, sizeof(Vertex), offsetof(Vertex, burnt));
}

void SectionCap::draw() const {
  glBindVertexArray(array_);
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(vertices_.size()));
}

}  // namespace heml::render
