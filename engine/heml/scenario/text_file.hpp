#pragma once
// Reading of text files, and small text helpers.
#include <filesystem>
#include <string>
#include <string_view>

namespace heml {

/// Content of a file, without the byte order mark it may begin with. Throws InputError when it is missing, unreadable,
/// not a regular file, or over 1 GB.
std::string read_text_file(const std::filesystem::path& path);

bool is_blank(std::string_view text);           ///< spaces, tabs and line ends only
std::string lower_case(std::string_view text);  ///< of ASCII letters

}  // namespace heml
