#pragma once
// Draws the body and its comparison runs (Frame::comparisons), each in a pane of the image.
#include <app/panel/camera_controller.hpp>
#include <app/render/renderer.hpp>
#include <memory>
#include <vector>

namespace heml::panel {

inline std::size_t body_count(const Frame& frame) { return 1 + frame.comparisons.size(); }
/// The body drawn in a pane.
inline const Frame& frame_in_pane(const Frame& frame, std::size_t pane) {
  return pane == 0 ? frame : frame.comparisons[pane - 1];
}

/// Calls visit(pane, body) for each pane, as the current one of the controller; then restores the current pane.
template <class Visit>
void each_pane(const Frame& frame, CameraController& controller, const Visit& visit) {
  const std::size_t before = controller.current();
  for (std::size_t pane = 0; pane < body_count(frame); ++pane) {
    controller.select_pane(pane);
    visit(pane, frame_in_pane(frame, pane));
  }
  controller.select_pane(before);
}

/// Needs the OpenGL context of its first draw() to be current in every call and in the destructor.
class ComparisonView {
 public:
  /// Fills framebuffer 0, which has the controller's size, with one pane per body.
  void draw(const Frame& frame, CameraController& controller, const render::DrawOptions& options);

 private:
  std::vector<std::unique_ptr<render::Renderer>> renderers_;  ///< one per pane: each caches buffers of a surface mesh
};

/// Labels each of several panes with the variant and its distance from the body. Draws into the current Dear ImGui
/// frame, behind the panel.
void draw_variant_labels(const Frame& frame, CameraController& controller);

}  // namespace heml::panel
