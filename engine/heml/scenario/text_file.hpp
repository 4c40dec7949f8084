#pragma once
// Whole text files, and small things to do with text.
#include <filesystem>
#include <string>
#include <string_view>

namespace heml {

/// A file's content. Throws InputError when there is none, it is not a regular file, or it is over 1 GB.
std::string read_text_file(const std::filesystem::path& path);

bool is_blank(std::string_view text);           ///< spaces, tabs and line ends only
std::string lower_case(std::string_view text);  ///< of ASCII letters

}  // namespace heml
