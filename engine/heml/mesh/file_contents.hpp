#pragma once
// Reads a mesh file into memory.
#include <filesystem>
#include <string>

namespace heml {

/// All bytes of a regular file. Throws InputError for other kinds (a device or pipe may be endless), and for more bytes
/// than a mesh with 32-bit node numbers can have.
std::string file_contents(const std::filesystem::path& path);

}  // namespace heml
