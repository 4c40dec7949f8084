#pragma once
// Draws a world headless: the body and its comparison runs, with the panel or a legend.
#include <app/panel/comparison_view.hpp>
#include <app/panel/interface.hpp>
#include <app/panel/panel.hpp>
#include <app/render/osmesa_context.hpp>
#include <heml/scenario/scene.hpp>
#include <heml/session/comparison_runs.hpp>
#include <heml/session/surface_mesh.hpp>
#include <heml/world/world.hpp>
#include <optional>

namespace heml::panel {

/// Owns an OpenGL context: one thread at a time. At most one drawing exists at a time.
class FrameDrawing {
 public:
  /// panel: draws the panel; otherwise only a legend, if the scene shows a field. comparisons: there will be comparison
  /// runs, which are labelled.
  FrameDrawing(const Scene& scene, const World& world, render::Size size, bool panel, bool comparisons);

  /// Draws a world from now on as if the drawing had been made for it, at the price of a frame: shaders are kept, and
  /// of the world that it has drawn the surface too. panel, comparisons: as of the constructor.
  void show(const Scene& scene, const World& world, bool panel, bool comparisons, bool is_same_world);
  /// Another thread may draw then, after take_up().
  void lay_down() { context_.release(); }
  void take_up() { context_.make_current(); }

  /// Draws the world extrapolated by `ahead` (s). seconds: simulated since the last frame. comparison_runs: drawn in
  /// further panes.
  render::Image draw(World& world, double ahead, double seconds, ComparisonRuns* comparison_runs = nullptr);

 private:
  void draw_with_panel(float seconds);
  void draw_alone(float seconds);
  render::StrokeDrawing stroke() const;

  render::Size size_;
  render::OsMesaContext context_;
  ComparisonView bodies_;
  std::shared_ptr<const SurfaceMesh> surface_mesh_;  ///< of the last frame
  std::shared_ptr<const Solid> solid_;                ///< of the last frame, for a section or a skin
  SkinAttachment skin_;
  View view_;
  std::vector<Event> strokes_;  ///< of the scene, for the blade or the electrode
  Frame frame_;
  render::ColourRange colours_;
  std::optional<Interface> interface_;  ///< none if only bodies are drawn
  std::optional<Panel> panel_;
};

}  // namespace heml::panel
