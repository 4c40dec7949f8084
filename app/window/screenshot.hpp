#pragma once
// Pictures of the window.
#include <app/render/image.hpp>
#include <filesystem>
#include <string>

namespace heml::window {

/// Writes heml-<name>-<local time>.png into the working directory, never over another file. Throws InputError.
std::filesystem::path save_picture(const render::Image& picture, const std::string& name);

}  // namespace heml::window
