#include <app/commands/chart_picture.hpp>
#include <app/panel/interface.hpp>
#include <app/render/osmesa_context.hpp>
#include <app/render/png.hpp>

namespace heml {
namespace {
constexpr float text_scale = 1.5f;  // larger than in a panel: charts are shown small

/// Writes an image drawn by draw(list, area), where the area is all of it.
template <class Draw>
void write_picture(const std::filesystem::path& path, render::Size size, const Draw& draw) {
  render::OsMesaContext context(size);
  panel::Interface interface(text_scale);
  interface.begin(size, 0);
  const panel::Area whole{{0, 0}, {static_cast<float>(size.width), static_cast<float>(size.height)}};
  draw(*ImGui::GetBackgroundDrawList(), whole);
  interface.end();
  render::write_png(path, render::read_pixels(size));
}

}  // namespace

void write_chart(const std::filesystem::path& path, const panel::Chart& chart, render::Size size) {
  write_picture(path, size, [&](ImDrawList& list, const panel::Area& area) {
    panel::draw_chart(list, area, chart, panel::light_chart);
  });
}

void write_chart(const std::filesystem::path& path, const panel::BarChart& chart, render::Size size) {
  write_picture(path, size, [&](ImDrawList& list, const panel::Area& area) {
    panel::draw_bars(list, area, chart, panel::light_chart);
  });
}

}  // namespace heml
