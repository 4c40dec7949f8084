#pragma once
// A mesh file in memory.
#include <filesystem>
#include <string>

namespace heml {

/// All bytes of a plain file. Throws InputError for anything else (a device or a pipe could go on for ever), and for
/// more bytes than a mesh with 32-bit node numbers can have.
std::string file_contents(const std::filesystem::path& path);

}  // namespace heml
