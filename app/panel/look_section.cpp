#include <fmt/format.h>

#include <algorithm>
#include <app/panel/look_section.hpp>
#include <iterator>

namespace heml::panel {
namespace {

const std::vector<std::string>& size_names() {
  static const auto all = [] {
    std::vector<std::string> names;
    for (const double size : interface_sizes) names.push_back(fmt::format("{:.0f} %", 100 * size));
    return names;
  }();
  return all;
}

}  // namespace

void draw_look(Rows& rows, Look& look) {
  const auto now = std::find(std::begin(interface_sizes), std::end(interface_sizes), look.size);
  int size = static_cast<int>(now - std::begin(interface_sizes));
  if (rows.choice({"Text size",
                   "Size of texts and controls, of the one that suits the screen and the window. It is "
                   "kept for the next start."},
                  size, size_names()))
    look.size = interface_sizes[size];
  bool light = look.theme == Theme::light;
  if (rows.check({"Light theme", "Dark texts on light ground, for bright rooms. It is kept for the next start."},
                 light))
    look.theme = light ? Theme::light : Theme::dark;
}

}  // namespace heml::panel
