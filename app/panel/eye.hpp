#pragma once
// The camera beside a panel: the body stays in the middle of what the panel leaves free.
#include <app/panel/area.hpp>
#include <app/render/scene_camera.hpp>
#include <array>
#include <optional>

namespace heml::panel {

class Eye {
 public:
  /// Looks at the body as the scene's view says, so that it fits between what is covered.
  void fit(const View& view, const Skin& skin, render::Size size, const Insets& covered);
  /// The picture or the panel changed: the body stays as large as it is.
  void resize(render::Size size, const Insets& covered);

  void orbit(float right, float down);  ///< by pixels of mouse travel: the body turns with the mouse
  void pan(float right, float down);    ///< by pixels: the body goes with the mouse
  void zoom(float notches);             ///< of the wheel; up: nearer

  static constexpr std::size_t views = 4;
  void keep(std::size_t view) { kept_[view] = centred_; }  ///< as it looks now, under a number
  bool go_to(std::size_t view);                            ///< false where nothing was kept
  bool has(std::size_t view) const { return kept_[view].has_value(); }
  void forget() { kept_ = {}; }

  render::Camera camera() const;  ///< to draw and to pick with
  render::Size size() const { return size_; }

 private:
  render::Camera centred_;  ///< as if nothing were covered
  render::Size size_;       ///< pixels
  Insets covered_;
  std::array<std::optional<render::Camera>, views> kept_;
};

}  // namespace heml::panel
