#pragma once
// Reads and writes PNG files.
#include <app/render/image.hpp>
#include <filesystem>

namespace heml::render {

/// Writes 8-bit RGB, fast rather than small (zlib level 1, SUB filter). Throws InputError if the file cannot be
/// written.
void write_png(const std::filesystem::path& path, const Image& image);

/// Reads any PNG as 8-bit RGB (alpha dropped, grey and palettes expanded, 16 bits cut to 8).
/// Throws InputError if the file is missing or not a valid PNG of at most 16384 pixels a side.
Image read_png(const std::filesystem::path& path);

}  // namespace heml::render
