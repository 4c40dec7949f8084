#pragma once
// Files of saved images, and where files are saved that the person gives no name.
#include <app/render/image.hpp>
#include <filesystem>
#include <string>

namespace heml::window {

/// An unused path, in full: heml-<name><kind>-<local time><ending>, with a number if that exists. The name is shortened
/// and has dashes for what file systems or shells dislike. The folder is the working directory; where that is gone or
/// cannot be written, the home or else the temporary folder. Throws InputError if there is none of them.
std::filesystem::path unused_path(const std::string& name, const std::string& ending, const std::string& kind = "");

/// A line that says why a folder of unused_path() is not the working directory; empty where it is.
std::string why_saved_in(const std::filesystem::path& folder);

/// Writes heml-<name>-<local time>.png, never over another file. Throws InputError.
std::filesystem::path save_image(const render::Image& image, const std::string& name);

}  // namespace heml::window
