#pragma once
// Two inexpensive shadows: a depth map for the key light's shadow on the body, and a blurred footprint on the ground.
#include <app/render/bounds.hpp>
#include <app/render/gl_objects.hpp>
#include <functional>
#include <span>

namespace heml::render {

/// Draws all shadow casters with the program in use; sets its uniform `model` for each part.
using DrawCasters = std::function<void(const Program&)>;

/// Depth map from the key light.
class ShadowMap {
 public:
  ShadowMap();
  /// Everything within the ball casts and receives shadows. key_direction: unit, towards the light.
  void draw(const BoundingSphere& ball, const Vec3f& key_direction, const DrawCasters& draw_casters);
  const Mat4f& matrix() const { return matrix_; }    ///< world to the map's clip space
  const Texture& texture() const { return depth_; }  ///< for a sampler2DShadow

 private:
  Program program_{"depth.vert", "depth.frag"};
  Texture depth_;
  Framebuffer framebuffer_;
  Mat4f matrix_ = Mat4f::Identity();
};

/// Blurred projections of the body onto the ground. r: shadow of the key light; g: proximity, for the contact shadow.
class Footprint {
 public:
  static constexpr float extent = 3.4f;  ///< half the side of the square covered, in radii

  Footprint();
  /// ground: y, m. radius: length unit of the square round centre, m.
  void draw(const Vec3f& centre, float radius, float ground, const Vec3f& key_direction,
            const DrawCasters& draw_casters);
  const Texture& texture() const { return pictures_[0]; }
  /// Where the shadows of what lies in the boxes (m) may be other than 0: in radii from the centre. As of draw().
  static Eigen::AlignedBox2f reach(std::span<const Eigen::AlignedBox3f> boxes, const Vec3f& centre, float radius,
                                   float ground, const Vec3f& key_direction);

 private:
  void blur(int from, int to, const Vec2f& texel) const;

  Program program_{"depth.vert", "footprint.frag"};
  Program blur_{"screen.vert", "blur.frag"};
  VertexArray empty_array_;
  std::array<Texture, 2> pictures_;
  std::array<Framebuffer, 2> framebuffers_;
};

}  // namespace heml::render
