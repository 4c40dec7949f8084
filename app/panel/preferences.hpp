#pragma once
// What the panel remembers between runs: a text of lines, in the user's state folder (window/state_folder.hpp). What is
// as at first has no line.
//
//   hints off
//   theme light
//   size 1.25
//   window 1600 900
//   tool jaw length 0.12
//   device moves view
//   open Compare
//   closed Motion
#include <app/panel/theme.hpp>
#include <app/render/image.hpp>
#include <map>
#include <string>
#include <string_view>

namespace heml::panel {

/// Of the panel and of what is written over the image.
struct Look {
  double size = 1;  ///< of texts and controls, times what suits the window; one of interface_sizes
  Theme theme = Theme::dark;
  bool operator==(const Look&) const = default;
};
constexpr render::Size first_window{1280, 720};
constexpr double interface_sizes[] = {0.75, 1, 1.25, 1.5, 2};

struct Preferences {
  bool hints = true;            ///< the hint line is shown
  bool ground = true;           ///< it is drawn
  bool constraints = true;      ///< beads at held nodes are drawn
  bool full_resolution = true;  ///< of the image
  Look look;
  render::Size window = first_window;    ///< its size, screen coordinates
  std::map<std::string, double> tools;   ///< settings by name (tool_section.cpp); lengths in radii of the body
  std::map<std::string, bool> sections;  ///< by title: opened (true) or closed by hand
  bool device_moves_view = false;        ///< a SpaceMouse does, in place of a hand
  bool operator==(const Preferences&) const = default;
};

std::string to_text(const Preferences& preferences);

/// Lines that are not understood are skipped.
Preferences preferences_from(std::string_view text);

}  // namespace heml::panel
