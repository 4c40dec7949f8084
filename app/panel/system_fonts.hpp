#pragma once
// Fonts of the system for letters that the panel's own typeface lacks: those that fontconfig names (opened at run time,
// if it is installed), else those at well-known paths.
#include <set>
#include <string>
#include <vector>

namespace heml::panel {

struct FontFile {
  std::string path;
  int index = 0;  ///< of the face in the file
};

/// TrueType and OpenType files that together have as many of the letters (Unicode) as possible, in the order in which
/// the user's configuration prefers them.
std::vector<FontFile> fonts_with(const std::set<unsigned>& letters);

}  // namespace heml::panel
