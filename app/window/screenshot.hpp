#pragma once
// Files of saved images.
#include <app/render/image.hpp>
#include <filesystem>
#include <string>

namespace heml::window {

/// An unused path in the working directory, in full: heml-<name>-<local time><ending>, with a number if that exists.
std::filesystem::path unused_path(const std::string& name, const std::string& ending);

/// Writes heml-<name>-<local time>.png into the working directory, never over another file. Throws InputError.
std::filesystem::path save_image(const render::Image& image, const std::string& name);

}  // namespace heml::window
