#include "app/render/background.hpp"

#include <app/render/shadows.hpp>
#include <array>
#include <cmath>

namespace heml::render {
namespace {

constexpr float ground_extent = 7;  // half the ground's side, in body radii
constexpr GLenum colour_read_format = 0x8B9B;  // GL_IMPLEMENTATION_COLOR_READ_FORMAT of OpenGL 4.1; older ones say nothing
constexpr int ground_grid = 36;     // squares a side, the same as in ground.vert

/// Where grid line i of the ground lies, in radii from its centre; as in ground.vert.
float grid_line(int i) {
  const float at = static_cast<float>(i) * (2.0f / ground_grid) - 1;
  return ground_extent * at * (0.35f + 0.65f * std::abs(at));
}

}  // namespace

Background::Background() {
  allocate_texture(no_shadow_, GL_RG8, GL_RG, GL_UNSIGNED_BYTE, {1, 1});
  const std::array<std::uint8_t, 4> texel{};
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 1, 1, GL_RG, GL_UNSIGNED_BYTE, texel.data());
}

void Background::prepare(const ViewContext& shot, const Ground& ground, const Place& place) {
  const Scenery scenery{shot.view_projection, shot.size,     place.left,   place.bottom,
                        ground.shown,         ground.centre, ground.radius};
  if (last_ == scenery) {
    if (!is_kept_) keep(shot, ground, place);
    put_back(shot, place);
    return;
  }
  last_ = scenery;
  is_kept_ = false;
}

/// Draws into the picture and copies from there: elsewhere some pixels would be rounded in another way.
void Background::keep(const ViewContext& shot, const Ground& ground, const Place& place) {
  const Size size{place.left + shot.size.width, place.bottom + shot.size.height};
  if (!(kept_size_ == size)) {
    // In the picture's own order of colours, so that a software renderer copies bytes.
    GLint order = 0;
    glGetIntegerv(colour_read_format, &order);
    if (order == GL_BGRA)
      allocate_texture(kept_, GL_RGBA8, GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV, size);
    else
      allocate_texture(kept_, GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, size);
  }
  kept_size_ = size;
  glClear(GL_DEPTH_BUFFER_BIT);
  Ground bare = ground;
  bare.footprint = no_shadow_;
  draw_all(shot, bare);
  glBindTexture(GL_TEXTURE_2D, kept_);
  glCopyTexSubImage2D(GL_TEXTURE_2D, 0, place.left, place.bottom, place.left, place.bottom, shot.size.width,
                      shot.size.height);
  is_kept_ = true;
}

void Background::put_back(const ViewContext& shot, const Place& place) const {
  GLint picture = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &picture);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, kept_frame_);
  glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, kept_, 0);
  const int right = place.left + shot.size.width, top = place.bottom + shot.size.height;
  glBlitFramebuffer(place.left, place.bottom, right, top, place.left, place.bottom, right, top, GL_COLOR_BUFFER_BIT,
                    GL_NEAREST);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(picture));
}

void Background::draw(const ViewContext& shot, const Ground& ground) const {
  if (!is_kept_) return draw_all(shot, ground);
  if (ground.shown) draw_ground(shot, ground, &ground.shadowed);
}

void Background::draw_all(const ViewContext& shot, const Ground& ground) const {
  if (ground.shown) draw_ground(shot, ground, nullptr);
  backdrop_.use();
  backdrop_.set("aspect", shot.size.aspect());
  glBindVertexArray(empty_array_);
  glDrawArrays(GL_TRIANGLES, 0, 3);  // all pixels at which nothing is nearer
}

/// The squares that meet `within`; without it all.
void Background::draw_ground(const ViewContext& shot, const Ground& ground, const Eigen::AlignedBox2f* within) const {
  ground_.use();
  ground_.set("view_projection", shot.view_projection);
  ground_.set("centre", ground.centre);
  ground_.set("radius", ground.radius);
  ground_.set("extent", ground_extent);
  ground_.set("footprint_extent", Footprint::extent);
  ground_.set("aspect", shot.size.aspect());
  ground_.set("key_direction", shot.key_direction);
  ground_.set("footprint", 0);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, ground.footprint);
  glBindVertexArray(empty_array_);
  if (!within) return glDrawArrays(GL_TRIANGLES, 0, 6 * ground_grid * ground_grid);
  std::array<int, 2> first{ground_grid, ground_grid}, end{0, 0};
  for (int axis = 0; axis < 2; ++axis)
    for (int i = 0; i < ground_grid; ++i) {
      if (grid_line(i + 1) < within->min()[axis] || grid_line(i) > within->max()[axis]) continue;
      first[axis] = std::min(first[axis], i);
      end[axis] = i + 1;
    }
  if (first[0] >= end[0]) return;
  for (int row = first[1]; row < end[1]; ++row)
    glDrawArrays(GL_TRIANGLES, 6 * (row * ground_grid + first[0]), 6 * (end[0] - first[0]));
}

}  // namespace heml::render
