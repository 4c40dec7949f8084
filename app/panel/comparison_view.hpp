#pragma once
// The body and those beside it (Frame::beside), each in its pane of the picture.
#include <app/panel/camera_controller.hpp>
#include <app/render/renderer.hpp>
#include <memory>
#include <vector>

namespace heml::panel {

inline std::size_t bodies_of(const Frame& frame) { return 1 + frame.comparisons.size(); }
/// What is in a pane.
inline const Frame& body_in(const Frame& frame, std::size_t pane) {
  return pane == 0 ? frame : frame.comparisons[pane - 1];
}

/// Calls visit(pane, body) with each pane of an eye as the current one, and leaves the eye as it was.
template <class Visit>
void each_pane(const Frame& frame, CameraController& controller, const Visit& visit) {
  const std::size_t before = controller.current();
  for (std::size_t pane = 0; pane < bodies_of(frame); ++pane) {
    controller.enter_pane(pane);
    visit(pane, body_in(frame, pane));
  }
  controller.enter_pane(before);
}

/// Belongs to the context that is current when it first draws, and needs it current in every call.
class ComparisonView {
 public:
  /// Draws over all of framebuffer 0, which is of the eye's size, in as many panes as there are bodies.
  void draw(const Frame& frame, CameraController& controller, const render::DrawOptions& options);

 private:
  std::vector<std::unique_ptr<render::Renderer>> renderers_;  ///< one a pane: each keeps what it made of a skin
};

/// Over each of several panes: in what way its body is computed, and how far it is from the first. Into the current
/// Dear ImGui frame, behind the panel.
void draw_variant_labels(const Frame& frame, CameraController& controller);

}  // namespace heml::panel
