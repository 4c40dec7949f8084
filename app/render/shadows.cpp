#include "app/render/shadows.hpp"

#include <stdexcept>

namespace heml::render {
namespace {

constexpr int map_side = 512;        // texels
constexpr int footprint_side = 128;  // texels
constexpr int border = 7;            // texels, wider than the blur

void attach(const Framebuffer& framebuffer, GLenum point, const Texture& texture) {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glFramebufferTexture2D(GL_FRAMEBUFFER, point, GL_TEXTURE_2D, texture, 0);
  if (point == GL_DEPTH_ATTACHMENT) {
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
  }
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw std::runtime_error("the graphics driver cannot draw shadows");
}

}  // namespace

ShadowMap::ShadowMap() {
  allocate_texture(depth_, GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, {map_side, map_side});
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  attach(framebuffer_, GL_DEPTH_ATTACHMENT, depth_);
}

void ShadowMap::draw(const BoundingSphere& ball, const Vec3f& key_direction, const DrawCasters& draw_casters) {
  const Vec3f right = key_direction.cross(Vec3f::UnitZ()).normalized();
  Eigen::Matrix3f axes;
  axes << right.transpose(), key_direction.cross(right).transpose(), -key_direction.transpose();
  matrix_.setIdentity();
  matrix_.block<3, 3>(0, 0) = axes / ball.radius;
  matrix_.block<3, 1>(0, 3) = -axes * ball.centre / ball.radius;

  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glViewport(0, 0, map_side, map_side);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glClear(GL_DEPTH_BUFFER_BIT);
  program_.use();
  program_.set("matrix", matrix_);
  draw_casters(program_);
}

Footprint::Footprint() {
  for (int i = 0; i < 2; ++i) {
    allocate_texture(pictures_[i], GL_RG8, GL_RG, GL_UNSIGNED_BYTE, {footprint_side, footprint_side});
    attach(framebuffers_[i], GL_COLOR_ATTACHMENT0, pictures_[i]);
  }
}

void Footprint::draw(const Vec3f& centre, float radius, float ground, const Vec3f& key_direction,
                     const DrawCasters& draw_casters) {
  const float scale = 1 / (extent * radius);
  // Maps x and z on the ground to clip x and y. lean: shift of the shadow per metre of height.
  const auto flatten = [&](const Vec2f& lean) {
    Mat4f matrix = Mat4f::Zero();
    matrix.row(0) << scale, -scale * lean.x(), 0, scale * (lean.x() * ground - centre.x());
    matrix.row(1) << 0, -scale * lean.y(), scale, scale * (lean.y() * ground - centre.z());
    matrix(3, 3) = 1;
    return matrix;
  };
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffers_[0]);
  glViewport(0, 0, footprint_side, footprint_side);
  glDisable(GL_DEPTH_TEST);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT);
  glEnable(GL_SCISSOR_TEST);  // the border stays clear: clamped texture reads outside the square return it
  glScissor(border, border, footprint_side - 2 * border, footprint_side - 2 * border);
  program_.use();
  program_.set("ground", ground);
  program_.set("radius", radius);
  glEnable(GL_BLEND);
  glBlendEquation(GL_MAX);
  glColorMask(GL_TRUE, GL_FALSE, GL_FALSE, GL_FALSE);
  program_.set("matrix", flatten(Vec2f(key_direction.x(), key_direction.z()) / key_direction.y()));
  draw_casters(program_);
  glColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_FALSE);
  program_.set("matrix", flatten(Vec2f::Zero()));
  draw_casters(program_);
  glDisable(GL_SCISSOR_TEST);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glBlendEquation(GL_FUNC_ADD);
  glDisable(GL_BLEND);
  blur(0, 1, {1.0f / footprint_side, 0});
  blur(1, 0, {0, 1.0f / footprint_side});
}

Eigen::AlignedBox2f Footprint::reach(std::span<const Eigen::AlignedBox3f> boxes, const Vec3f& centre, float radius,
                                     float ground, const Vec3f& key_direction) {
  Eigen::AlignedBox2f shadows;
  for (const Eigen::AlignedBox3f& box : boxes)
    for (int k = 0; k < 8; ++k) {
      const Vec3f corner = box.corner(static_cast<Eigen::AlignedBox3f::CornerType>(k));
      if (!corner.allFinite()) continue;
      const Vec2f below = Vec2f(corner.x() - centre.x(), corner.z() - centre.z()) / radius;
      const float height = (corner.y() - ground) / (key_direction.y() * radius);
      const Vec2f lean = height * Vec2f(key_direction.x(), key_direction.z());
      shadows.extend(below);
      shadows.extend(Vec2f(below - lean));
    }
  const Vec2f blurred = Vec2f::Constant((border + 1) * 2 * extent / footprint_side);
  if (!shadows.isEmpty()) shadows = {shadows.min() - blurred, shadows.max() + blurred};
  return shadows;
}

void Footprint::blur(int from, int to, const Vec2f& texel) const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffers_[to]);
  blur_.use();
  blur_.set("texel", texel);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, pictures_[from]);
  glBindVertexArray(empty_array_);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace heml::render
