#pragma once
// Entries of the open dialog. The panel's owner lists them (window/library.hpp).
#include <imgui.h>

#include <filesystem>
#include <string>
#include <vector>

namespace heml::panel {

struct OpenChoice {
  std::filesystem::path path;
  std::string title;
  std::string description;          ///< description of a scene; "recording, 1.2 MB" for a file
  ImTextureID thumbnail = nullptr;  ///< 16:9; nullptr: none
  bool is_folder = false;
  bool exists = true;
};

struct OpenChoices {
  std::vector<OpenChoice> scenes, extreme;  ///< installed with heml; of the stability study
  std::vector<OpenChoice> recent;           ///< latest first
  std::filesystem::path folder;             ///< the listed folder
  std::vector<OpenChoice> files;            ///< in it: the parent, folders, files
  std::string problem;                      ///< why the list is incomplete; empty: it is not
};

}  // namespace heml::panel
