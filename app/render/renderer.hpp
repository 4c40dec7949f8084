#pragma once
// Draws a body and what is round it. The order of drawing puts what hides most first, because software OpenGL pays for
// every pixel it shades:
//
//    shadow map, footprint ──► body ► edges ► held nodes ► tool ► ground ► backdrop ► outlines of body and tool
#include <app/render/camera.hpp>
#include <app/render/field_colours.hpp>
#include <heml/session/frame.hpp>
#include <memory>
#include <optional>
#include <span>

namespace heml::render {

struct DrawOptions {
  bool wireframe = false;         ///< the mesh's true edges over the surface
  bool ground = true;             ///< the drape and the shadow on it
  bool constrained = true;        ///< beads on nodes with a boundary condition
  bool tool = true;               ///< forceps and spring while something is grasped
  std::optional<Range> range;     ///< of the colour map; none: what the frame's values ask for
  std::span<const float> beyond;  ///< #S, hatched where above 0; empty: no hatching, which then costs nothing
  float resolution = 1;           ///< of the picture before it is scaled to its size, 0.25 to 1: speed for sharpness
  int left = 0, bottom = 0;       ///< where in framebuffer 0 the picture lies, pixels from its lower left corner
};

/// Belongs to the context that was current when it was made, and needs it current in every call.
class Renderer {
 public:
  /// Throws std::runtime_error when the driver cannot do what drawing needs.
  Renderer();
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// Draws over a rectangle of framebuffer 0, which has depth. The picture depends on the arguments alone.
  /// A frame without a skin has no body. A skin that the frame before did not have is taken up first, which takes as
  /// long as its ambient occlusion: about a second for 50,000 nodes, far less where a body has lost a part. Throws
  /// std::invalid_argument for a frame or a `beyond` with another number of nodes than the skin.
  void draw(const Frame& frame, const Camera& camera, const DrawOptions& options, Size size);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace heml::render
