#include <fmt/format.h>

#include <algorithm>
#include <app/panel/preferences.hpp>
#include <charconv>
#include <cmath>
#include <iterator>
#include <sstream>

namespace heml::panel {
namespace {

/// A line, and what it says.
struct Switch {
  std::string_view line;
  bool Preferences::*value;
  bool is_on;
};
constexpr Switch switches[] = {{"hints off", &Preferences::hints, false},
                               {"ground off", &Preferences::ground, false},
                               {"constraints off", &Preferences::constraints, false},
                               {"full resolution off", &Preferences::full_resolution, false},
                               {"device moves view", &Preferences::device_moves_view, true}};
constexpr std::string_view light = "theme light", ui_size = "size ", window = "window ", tool = "tool ", open = "open ",
                           closed = "closed ";
constexpr int least_window = 200, largest_window = 16384;  // screen coordinates

/// NaN: it is none.
double number_from(std::string_view text) {
  double number = std::nan("");
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
  return problem == std::errc() && end == text.data() + text.size() ? number : std::nan("");
}

/// Of "WIDTH HEIGHT", where a window may have them.
render::Size window_from(const std::string& text) {
  render::Size given;
  std::istringstream numbers(text);
  const auto fits = [](int length) { return length >= least_window && length <= largest_window; };
  if (!(numbers >> given.width >> given.height) || !fits(given.width) || !fits(given.height)) return first_window;
  return given;
}

/// Of "NAME NUMBER".
void read_tool(std::string_view line, std::map<std::string, double>& tools) {
  const std::size_t gap = line.rfind(' ');
  if (gap == std::string_view::npos || gap == 0) return;
  const double number = number_from(line.substr(gap + 1));
  if (std::isfinite(number)) tools[std::string(line.substr(0, gap))] = number;
}

}  // namespace

std::string to_text(const Preferences& preferences) {
  std::string text;
  for (const auto& [line, value, is_on] : switches)
    if (preferences.*value == is_on) text += fmt::format("{}\n", line);
  if (preferences.look.theme == Theme::light) text += fmt::format("{}\n", light);
  if (preferences.look.size != 1) text += fmt::format("{}{}\n", ui_size, preferences.look.size);
  if (preferences.window != first_window)
    text += fmt::format("{}{} {}\n", window, preferences.window.width, preferences.window.height);
  for (const auto& [name, value] : preferences.tools) text += fmt::format("{}{} {}\n", tool, name, value);
  for (const auto& [title, is_open] : preferences.sections)
    text += fmt::format("{}{}\n", is_open ? open : closed, title);
  return text;
}

Preferences preferences_from(std::string_view text) {
  Preferences preferences;
  std::istringstream lines{std::string(text)};
  for (std::string line; std::getline(lines, line);) {
    for (const auto& [said, value, is_on] : switches)
      if (line == said) preferences.*value = is_on;
    if (line == light) preferences.look.theme = Theme::light;
    if (line.starts_with(ui_size)) {
      const double given = number_from(std::string_view(line).substr(ui_size.size()));
      if (std::find(std::begin(interface_sizes), std::end(interface_sizes), given) != std::end(interface_sizes))
        preferences.look.size = given;
    }
    if (line.starts_with(window)) preferences.window = window_from(line.substr(window.size()));
    if (line.starts_with(tool)) read_tool(std::string_view(line).substr(tool.size()), preferences.tools);
    if (line.starts_with(open)) preferences.sections[line.substr(open.size())] = true;
    if (line.starts_with(closed)) preferences.sections[line.substr(closed.size())] = false;
  }
  return preferences;
}

}  // namespace heml::panel
