#include <fmt/format.h>

#include <app/commands/frame_capture.hpp>
#include <app/panel/camera_controller.hpp>
#include <app/panel/legend.hpp>
#include <app/render/png.hpp>
#include <heml/base/write_file.hpp>
#include <heml/session/surface_mesh.hpp>

namespace heml {

FrameCapture::FrameCapture(const Scene& scene, const World& world, ImageSize size, bool panel, bool comparisons,
                           std::filesystem::path folder)
    : folder_(std::move(folder)),
      size_{size.width, size.height},
      context_(size_),
      surface_mesh_(make_surface_mesh(world)),
      view_(scene.view) {
  make_folder(folder_);
  if (panel || comparisons || view_.field != Field::none) interface_.emplace(panel::Interface::suitable_scale(size_));
  if (panel) panel_.emplace(scene, *surface_mesh_);
}

void FrameCapture::capture(World& world, double ahead, double seconds, ComparisonRuns* comparison_runs) {
  surface_mesh_ = make_surface_mesh(world, std::move(surface_mesh_));
  fill_frame(world, surface_mesh_, view_.field, ahead, frame_, panel_ && panel_->wants_stretches());
  if (comparison_runs) comparison_runs->fill(world, frame_, ahead);
  frame_.pace.rate = 1 / world.setup().solver.tick();
  if (panel_)
    draw_with_panel(static_cast<float>(seconds));
  else
    draw_alone(static_cast<float>(seconds));
  render::write_png(folder_ / fmt::format("frame_{:05}.png", taken_), render::read_pixels(size_));
  ++taken_;
}

void FrameCapture::draw_with_panel(float seconds) {
  panel_->update(frame_, seconds);
  panel::CameraController controller;
  controller.fit(view_, uncut_surface(*surface_mesh_), size_,
                 panel_->insets({static_cast<float>(size_.width), static_cast<float>(size_.height)}),
                 panel::body_count(frame_));
  bodies_.draw(frame_, controller, panel_->drawing());
  interface_->begin(size_, seconds);
  panel::draw_variant_labels(frame_, controller);
  panel_->draw(frame_);
  interface_->end();
}

void FrameCapture::draw_alone(float seconds) {
  render::DrawOptions options;
  options.wireframe = view_.wireframe;
  if (interface_) options.range = colours_.update(frame_.field, frame_.values, seconds);
  panel::CameraController controller;
  controller.fit(view_, uncut_surface(*surface_mesh_), size_, {}, panel::body_count(frame_));
  bodies_.draw(frame_, controller, options);
  if (!interface_) return;
  interface_->begin(size_, seconds);
  panel::draw_variant_labels(frame_, controller);
  panel::draw_legend(frame_.field, *options.range,
                     {{0, 0}, {static_cast<float>(size_.width), static_cast<float>(size_.height)}},
                     !(frame_.min_J > 0));
  interface_->end();
}

}  // namespace heml
