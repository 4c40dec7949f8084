#include <app/panel/preferences.hpp>
#include <sstream>

namespace heml::panel {
namespace {
constexpr std::string_view no_hints = "hints off", moves_view = "device moves view", open = "open ", closed = "closed ";
}

std::string to_text(const Preferences& preferences) {
  std::string text;
  if (!preferences.hints) text += std::string(no_hints) + '\n';
  if (preferences.device_moves_view) text += std::string(moves_view) + '\n';
  for (const auto& [title, is_open] : preferences.sections) text += std::string(is_open ? open : closed) + title + '\n';
  return text;
}

Preferences preferences_from(std::string_view text) {
  Preferences preferences;
  std::istringstream lines{std::string(text)};
  for (std::string line; std::getline(lines, line);) {
    if (line == no_hints) preferences.hints = false;
    if (line == moves_view) preferences.device_moves_view = true;
    if (line.starts_with(open)) preferences.sections[line.substr(open.size())] = true;
    if (line.starts_with(closed)) preferences.sections[line.substr(closed.size())] = false;
  }
  return preferences;
}

}  // namespace heml::panel
