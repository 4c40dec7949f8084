#pragma once
// Pictures of the window.
#include <app/render/image.hpp>
#include <filesystem>
#include <string>

namespace heml::window {

/// heml-<name>-<local time><ending> in the working directory, or with a number where that is taken.
std::filesystem::path free_name(const std::string& name, const std::string& ending);

/// Writes heml-<name>-<local time>.png into the working directory, never over another file. Throws InputError.
std::filesystem::path save_picture(const render::Image& picture, const std::string& name);

}  // namespace heml::window
