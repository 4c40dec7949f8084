#pragma once
// Draws a body, its tools and the ground. Objects that hide most are drawn first, because the cost of software OpenGL
// is in shaded pixels:
//
//    shadow map, footprint ──► body ► edges ► constrained nodes ► tools ► ground ► backdrop ► outlines of body and tool
#include <app/render/camera.hpp>
#include <app/render/field_colours.hpp>
#include <app/render/grasp_pose.hpp>
#include <app/render/section.hpp>
#include <app/render/stroke_drawing.hpp>
#include <heml/session/frame.hpp>
#include <memory>
#include <optional>
#include <span>

namespace heml::render {

struct DrawOptions {
  bool wireframe = false;          ///< the mesh's edges over the surface
  bool ground = true;              ///< the drape and the shadow on it
  bool constrained = true;         ///< beads on nodes with a boundary condition
  bool tool = true;                ///< forceps while something is grasped, pins, scalpel and the like
  HandDrawing hands;               ///< of the mouse and of other devices
  StrokeDrawing stroke;            ///< of the scalpel
  std::optional<SectionPlane> section;  ///< leaves out what lies beyond; closed by a cap where the frame has a solid
  std::optional<Range> range;      ///< of the colour map; none: natural_range() of the frame's values
  std::span<const float> hatched;  ///< #S, hatched where above 0; empty: no hatching, at no cost
  bool old_shadows = false;        ///< those of the picture before, where its body was the same: a tenth faster
  float resolution = 1;            ///< of rendering, relative to the picture, 0.25 to 1: lower is faster
  int left = 0, bottom = 0;        ///< of the picture in framebuffer 0, pixels from its lower left corner
};

/// Bound to the context that is current at construction; every call needs that context current.
class Renderer {
 public:
  /// Throws std::runtime_error if the driver lacks a required framebuffer.
  Renderer();
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// Draws into a rectangle of framebuffer 0, which must have depth. Without old shadows the picture depends only on the
  /// arguments; where the view is that of the picture before, backdrop and ground are not shaded again. A frame without
  /// a surface mesh has no body. A surface mesh that the previous frame did not have is uploaded first, which takes as
  /// long as its ambient occlusion: about a second for 50,000 nodes, far less after a removal or for one of the last
  /// eight bodies. A frame with a skin and a solid shows the skin in place of the uncut body. Throws
  /// std::invalid_argument if the frame, its solid or `hatched` has another number of nodes than its mesh, and
  /// InputError for a skin's texture that cannot be read.
  void draw(const Frame& frame, const Camera& camera, const DrawOptions& options, Size size);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace heml::render
