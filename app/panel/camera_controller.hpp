#pragma once
// The camera: keeps the body centred in what the panel leaves free. Comparison runs split that area into panes, one per
// body, all with the same view; outer panes extend under the panel:
//
//    ┌ panel ┬──────────┬──────────┬ panel ┐
//    │       │    0     │    1     │       │      pane 0 is the body, the others are comparison runs
//    └───────┴──────────┴──────────┴───────┘
#include <app/panel/area.hpp>
#include <app/render/scene_camera.hpp>
#include <array>
#include <heml/session/frame.hpp>
#include <optional>
#include <vector>

namespace heml::panel {

/// Pixels from the top left corner of the image.
struct Pane {
  int left = 0, top = 0;
  render::Size size;
  Insets covered;  ///< part of the pane under the panel
  bool contains(const render::Vec2f& at) const;
};

/// Panes of up to four bodies, of the same height: one row, or two rows of two for four.
std::vector<Pane> make_panes(render::Size picture, const Insets& covered, std::size_t count);

class CameraController {
 public:
  /// Sets the camera to the scene's view so that the ball fits into the uncovered part of a pane.
  void fit(const View& view, const render::BoundingSphere& ball, render::Size size, const Insets& covered,
           std::size_t bodies = 1);
  /// The same for a body at rest.
  void fit(const View& view, const SurfaceMesh& surface_mesh, render::Size size, const Insets& covered,
           std::size_t bodies = 1) {
    fit(view, render::bounding_sphere(surface_mesh.rest), size, covered, bodies);
  }
  /// Updates the panes for another image size, panel or number of bodies; the view stays.
  void resize(render::Size size, const Insets& covered, std::size_t bodies = 1);

  /// By pixels of mouse travel; the body turns with the mouse. pivot: m, stays where it is in the image; none: the
  /// middle of the view.
  void orbit(float right, float down, const std::optional<Vec3f>& pivot = std::nullopt);
  void pan(float right, float down);    ///< by pixels of mouse travel; the body moves with the mouse
  void zoom(float notches);             ///< of the wheel; positive: nearer

  void look(StandardView view);  ///< turns there about the middle of the view
  void set_orthographic(bool on) { centred_.set_orthographic(on); }
  bool is_orthographic() const { return centred_.is_orthographic(); }

  static constexpr std::size_t views = 4;
  using SavedViews = std::array<std::optional<render::CameraPose>, views>;
  void save_view(std::size_t view) { saved_[view] = centred_.pose(); }  ///< saves the view
  bool restore_view(std::size_t view);                           ///< restores it; false: none is saved
  bool has_view(std::size_t view) const { return saved_[view].has_value(); }
  const SavedViews& saved_views() const { return saved_; }
  void set_saved_views(const SavedViews& saved) { saved_ = saved; }

  /// Makes the pane at a pixel the current one, to which the functions below refer.
  void select_pane_at(const render::Vec2f& at);
  void select_pane(std::size_t pane) { current_ = pane; }
  std::size_t current() const { return current_; }
  const std::vector<Pane>& panes() const { return panes_; }
  const Pane& pane() const { return panes_[current_]; }

  // In the current pane; pixels of the whole image.
  render::Camera camera() const;  ///< shifted so that the body is centred in the free part
  render::Ray ray(const render::Vec2f& at) const;
  Vec3f drag(const render::Vec2f& at, const Vec3f& point) const;  ///< Camera::drag()
  render::Vec2f pixel(const Vec3f& point) const;                  ///< of a point (m)

  render::Size size() const { return size_; }  ///< of the image

 private:
  render::Vec2f corner() const { return {static_cast<float>(pane().left), static_cast<float>(pane().top)}; }

  render::Camera centred_;  ///< without the shift
  render::Size size_;       ///< pixels
  std::vector<Pane> panes_{Pane{}};
  std::size_t current_ = 0;
  SavedViews saved_;
};

}  // namespace heml::panel
