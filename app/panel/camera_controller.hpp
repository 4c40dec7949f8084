#pragma once
// The camera beside a panel: the body stays in the middle of what the panel leaves free. Several bodies share what is
// free, each in a pane of the picture, all seen alike; what the panel covers belongs to the outer panes:
//
//    ┌ panel ┬──────────┬──────────┬ panel ┐
//    │       │    0     │    1     │       │      pane 0 is the body, the others are what is beside it
//    └───────┴──────────┴──────────┴───────┘
#include <app/panel/area.hpp>
#include <app/render/scene_camera.hpp>
#include <array>
#include <optional>
#include <vector>

namespace heml::panel {

/// Pixels from the top left corner of the picture.
struct Pane {
  int left = 0, top = 0;
  render::Size size;
  Insets covered;  ///< of it
  bool contains(const render::Vec2f& at) const;
};

/// Up to four, of the same height; two rows of two where they are four.
std::vector<Pane> panes_of(render::Size picture, const Insets& covered, std::size_t count);

class CameraController {
 public:
  /// Looks at the body as the scene's view says, so that it fits between what is covered.
  void fit(const View& view, const SurfaceMesh& surface_mesh, render::Size size, const Insets& covered,
           std::size_t bodies = 1);
  /// The picture, the panel or the number of bodies changed: the body stays as large as it is.
  void resize(render::Size size, const Insets& covered, std::size_t bodies = 1);

  void orbit(float right, float down);  ///< by pixels of mouse travel: the body turns with the mouse
  void pan(float right, float down);    ///< by pixels: the body goes with the mouse
  void zoom(float notches);             ///< of the wheel; up: nearer

  static constexpr std::size_t views = 4;
  void keep(std::size_t view) { kept_[view] = centred_; }  ///< as it looks now, under a number
  bool go_to(std::size_t view);                            ///< false where nothing was kept
  bool has(std::size_t view) const { return kept_[view].has_value(); }
  void clear_views() { kept_ = {}; }

  /// The pane at a pixel is the one that is meant from now on: by the mouse, and by what is marked.
  void enter(const render::Vec2f& at);
  void enter_pane(std::size_t pane) { current_ = pane; }
  std::size_t current() const { return current_; }
  const std::vector<Pane>& panes() const { return panes_; }
  const Pane& pane() const { return panes_[current_]; }

  // In the current pane, pixels of the whole picture.
  render::Camera camera() const;  ///< to draw with
  render::Ray ray(const render::Vec2f& at) const;
  Vec3f drag(const render::Vec2f& at, const Vec3f& point) const;  ///< Camera::drag()
  render::Vec2f pixel(const Vec3f& point) const;                  ///< where a point (m) appears

  render::Size size() const { return size_; }  ///< of the picture

 private:
  render::Vec2f corner() const { return {static_cast<float>(pane().left), static_cast<float>(pane().top)}; }

  render::Camera centred_;  ///< as if nothing were covered
  render::Size size_;       ///< pixels
  std::vector<Pane> panes_{Pane{}};
  std::size_t current_ = 0;
  std::array<std::optional<render::Camera>, views> kept_;
};

}  // namespace heml::panel
