#include <app/panel/camera_controller.hpp>
#include <app/panel/frame_drawing.hpp>
#include <app/panel/legend.hpp>
#include <app/panel/scripted_stroke.hpp>
#include <app/panel/section_control.hpp>
#include <heml/scenario/skin.hpp>

namespace heml::panel {

FrameDrawing::FrameDrawing(const Scene& scene, const World& world, render::Size size, bool panel, bool comparisons)
    : size_(size), context_(size_) {
  show(scene, world, panel, comparisons, false);
}

void FrameDrawing::show(const Scene& scene, const World& world, bool panel, bool comparisons, bool is_same_world) {
  if (!is_same_world) {
    surface_mesh_ = nullptr;
    solid_ = nullptr;
    skin_ = SkinAttachment(load_skin(scene, world.setup().mesh));
  }
  surface_mesh_ = make_surface_mesh(world, std::move(surface_mesh_), scene.view.hidden);
  view_ = scene.view;
  colours_ = {};
  panel_.reset();
  interface_.reset();
  strokes_.clear();
  if (panel || comparisons || view_.field != Field::none) interface_.emplace(Interface::suitable_scale(size_));
  if (panel) panel_.emplace(scene, *surface_mesh_);
  if (view_.range) colours_.fix({static_cast<float>((*view_.range)[0]), static_cast<float>((*view_.range)[1])});
  for (const Event& event : scene.events)
    if (continues_stroke(event.command)) strokes_.push_back(event);
}

render::StrokeDrawing FrameDrawing::stroke() const {
  // An event of tick k takes effect at the start of that tick, so that frame k does not show it yet.
  return scripted_stroke(strokes_, frame_.tick - 1, frame_.pace.rate);
}

render::Image FrameDrawing::draw(World& world, double ahead, double seconds, ComparisonRuns* comparison_runs) {
  surface_mesh_ = make_surface_mesh(world, std::move(surface_mesh_), view_.hidden);
  fill_frame(world, surface_mesh_, view_.field, ahead, frame_, panel_ && panel_->wants_stretches());
  if (view_.section || skin_.exists()) fill_solid(world, ahead, solid_, frame_);
  skin_.attach(world, frame_);
  if (comparison_runs) comparison_runs->fill(world, frame_, ahead, skin_);
  frame_.pace.rate = 1 / world.setup().solver.tick();
  if (panel_)
    draw_with_panel(static_cast<float>(seconds));
  else
    draw_alone(static_cast<float>(seconds));
  return render::read_pixels(size_);
}

void FrameDrawing::draw_with_panel(float seconds) {
  panel_->update(frame_, seconds);
  CameraController controller;
  controller.fit(view_, uncut_surface(*surface_mesh_), size_,
                 panel_->insets({static_cast<float>(size_.width), static_cast<float>(size_.height)}),
                 body_count(frame_));
  render::DrawOptions options = panel_->drawing();
  options.stroke = stroke();
  bodies_.draw(frame_, controller, options);
  interface_->begin(size_, seconds);
  draw_variant_labels(frame_, controller);
  panel_->draw(frame_);
  interface_->end();
}

void FrameDrawing::draw_alone(float seconds) {
  render::DrawOptions options;
  options.wireframe = view_.wireframe;
  if (view_.section) options.section = SectionControl(view_, *surface_mesh_).plane();
  options.stroke = stroke();
  if (interface_) options.range = colours_.update(frame_.field, frame_.values, seconds);
  CameraController controller;
  controller.fit(view_, uncut_surface(*surface_mesh_), size_, {}, body_count(frame_));
  bodies_.draw(frame_, controller, options);
  if (!interface_) return;
  interface_->begin(size_, seconds);
  draw_variant_labels(frame_, controller);
  draw_legend(frame_.field, *options.range,
              {{0, 0}, {static_cast<float>(size_.width), static_cast<float>(size_.height)}}, !(frame_.min_J > 0));
  interface_->end();
}

}  // namespace heml::panel
