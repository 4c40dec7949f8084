#pragma once
// What can be opened, as the open dialog shows it. Whoever owns the panel lists it (window/library.hpp).
#include <imgui.h>

#include <filesystem>
#include <string>
#include <vector>

namespace heml::panel {

struct OpenChoice {
  std::filesystem::path path;
  std::string title;
  std::string about;              ///< what it is: a sentence of a scene, "recording, 1.2 MB" of a file
  ImTextureID picture = nullptr;  ///< 16:9; none: it has none
  bool is_folder = false;
  bool is_there = true;
};

struct OpenChoices {
  std::vector<OpenChoice> scenes, extreme;  ///< that come with heml; those of the stability study
  std::vector<OpenChoice> recent;           ///< the latest first
  std::filesystem::path folder;             ///< that is looked into
  std::vector<OpenChoice> files;            ///< there: folders first; the one above before all
  std::string problem;                      ///< why it cannot be looked into; empty: it can
};

}  // namespace heml::panel
