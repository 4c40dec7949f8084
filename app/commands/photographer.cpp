#include <fmt/format.h>

#include <app/commands/photographer.hpp>
#include <app/panel/eye.hpp>
#include <app/panel/legend.hpp>
#include <app/render/png.hpp>
#include <heml/base/write_file.hpp>
#include <heml/session/skin.hpp>

namespace heml {

Photographer::Photographer(const Scene& scene, const World& world, PictureSize size, bool panel, bool beside,
                           std::filesystem::path folder)
    : folder_(std::move(folder)),
      size_{size.width, size.height},
      context_(size_),
      skin_(skin_of(world)),
      view_(scene.view) {
  make_folder(folder_);
  if (panel || beside || view_.field != Field::none) interface_.emplace(panel::Interface::suitable_scale(size_));
  if (panel) panel_.emplace(scene, *skin_);
}

void Photographer::take(World& world, double ahead, double seconds, Companions* companions) {
  skin_ = skin_of(world, std::move(skin_));
  fill_frame(world, skin_, view_.field, ahead, frame_, panel_ && panel_->wants_stretches());
  if (companions) companions->fill(world, frame_, ahead);
  frame_.pace.rate = 1 / world.setup().solver.tick();
  if (panel_)
    draw_with_panel(static_cast<float>(seconds));
  else
    draw_alone(static_cast<float>(seconds));
  render::write_png(folder_ / fmt::format("frame_{:05}.png", taken_), render::read_pixels(size_));
  ++taken_;
}

void Photographer::draw_with_panel(float seconds) {
  panel_->take(frame_, seconds);
  panel::Eye eye;
  eye.fit(view_, whole_of(*skin_), size_,
          panel_->insets({static_cast<float>(size_.width), static_cast<float>(size_.height)}),
          panel::bodies_of(frame_));
  bodies_.draw(frame_, eye, panel_->drawing());
  interface_->begin(size_, seconds);
  panel::draw_ways(frame_, eye);
  panel_->draw(frame_);
  interface_->end();
}

void Photographer::draw_alone(float seconds) {
  render::DrawOptions options;
  options.wireframe = view_.wireframe;
  if (interface_) options.range = colours_.update(frame_.field, frame_.values, seconds);
  panel::Eye eye;
  eye.fit(view_, whole_of(*skin_), size_, {}, panel::bodies_of(frame_));
  bodies_.draw(frame_, eye, options);
  if (!interface_) return;
  interface_->begin(size_, seconds);
  panel::draw_ways(frame_, eye);
  panel::draw_legend(frame_.field, *options.range,
                     {{0, 0}, {static_cast<float>(size_.width), static_cast<float>(size_.height)}},
                     !(frame_.min_J > 0));
  interface_->end();
}

}  // namespace heml
