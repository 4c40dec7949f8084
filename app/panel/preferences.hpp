#pragma once
// What the panel remembers between runs: a text of lines, in the user's state folder (window/state_folder.hpp).
//
//   hints off
//   device moves view
//   open Compare
//   closed Motion
#include <map>
#include <string>
#include <string_view>

namespace heml::panel {

struct Preferences {
  bool hints = true;                     ///< the hint line is shown
  std::map<std::string, bool> sections;  ///< by title: opened (true) or closed by hand
  bool device_moves_view = false;        ///< a SpaceMouse does, in place of a hand
  bool operator==(const Preferences&) const = default;
};

std::string to_text(const Preferences& preferences);

/// Lines that are not understood are skipped.
Preferences preferences_from(std::string_view text);

}  // namespace heml::panel
