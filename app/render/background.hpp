#pragma once
// What is behind and under the body: a backdrop, and a drape with the shadows of body and tools. Software renderers
// spend a third of a picture on them. So while camera and ground stay, both are kept without shadows, and a picture is
//
//   what is kept, copied, then
//   body and tools, then
//   the squares of the drape that shadows fall on,
//
// with the same bits as if drape and backdrop were drawn. Where something reaches below the drape, the drape comes
// before body and tools, which it would hide.
#include <app/render/gl_objects.hpp>
#include <app/render/tool_drawing.hpp>
#include <optional>

namespace heml::render {

class Background {
 public:
  /// The drape, a plane of constant y.
  struct Ground {
    bool shown = true;             ///< and the eye is above it
    Vec3f centre = Vec3f::Zero();  ///< m
    float radius = 1;              ///< m, of the body at rest
    GLuint footprint = 0;          ///< texture of shadows, shadows.hpp
    Eigen::AlignedBox2f shadowed;  ///< where that is not 0, in radii from the centre
    bool is_lowest = true;         ///< nothing that is drawn reaches below it
  };
  /// The picture's lower left corner in the bound framebuffer, pixels.
  struct Place {
    int left = 0, bottom = 0;
  };

  Background();
  /// Before a picture: sees what is kept, and puts it into the picture. May leave any depths.
  void prepare(const ViewContext& shot, const Ground& ground, const Place& place);
  /// Draws what the picture lacks of it.
  void draw(const ViewContext& shot, const Ground& ground) const;

 private:
  /// All that backdrop and drape depend on, but for shadows.
  struct Scenery {
    Mat4f view_projection;
    Size size;
    int left, bottom;
    bool with_ground;
    Vec3f centre;
    float radius;
    bool operator==(const Scenery&) const = default;
  };
  void keep(const ViewContext& shot, const Ground& ground, const Place& place);
  void put_back(const ViewContext& shot, const Place& place) const;
  void draw_all(const ViewContext& shot, const Ground& ground) const;
  void draw_ground(const ViewContext& shot, const Ground& ground, const Eigen::AlignedBox2f* within) const;

  Program ground_{"ground.vert", "ground.frag"};
  Program backdrop_{"screen.vert", "backdrop.frag"};
  VertexArray empty_array_;  // for shapes that need only gl_VertexID
  Texture no_shadow_;        // one texel
  std::optional<Scenery> last_;
  Texture kept_;
  Framebuffer kept_frame_;  // reads from it
  Size kept_size_{0, 0};
  bool is_kept_ = false;  // of last_
};

}  // namespace heml::render
