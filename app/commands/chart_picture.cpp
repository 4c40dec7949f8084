#include <app/commands/chart_picture.hpp>
#include <app/panel/interface.hpp>
#include <app/render/osmesa_context.hpp>
#include <app/render/png.hpp>

namespace heml {
namespace {
constexpr float text_scale = 1.5f;  // larger than in a panel: charts are shown small
}

void write_chart(const std::filesystem::path& path, const panel::Chart& chart, render::Size size) {
  render::OsMesaContext context(size);
  panel::Interface interface(text_scale);
  interface.begin(size, 0);
  const panel::Area whole{{0, 0}, {static_cast<float>(size.width), static_cast<float>(size.height)}};
  panel::draw_chart(*ImGui::GetBackgroundDrawList(), whole, chart, panel::light_chart);
  interface.end();
  render::write_png(path, render::read_pixels(size));
}

}  // namespace heml
