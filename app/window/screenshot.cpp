#include <fmt/chrono.h>
#include <fmt/format.h>

#include <app/render/png.hpp>
#include <app/window/screenshot.hpp>
#include <cctype>
#include <ctime>

namespace heml::window {

std::filesystem::path save_picture(const render::Image& picture, const std::string& name) {
  std::string plain = name.empty() ? "body" : name;
  for (char& c : plain)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_' && c != '-') c = '-';
  const std::string stem = fmt::format("heml-{}-{:%Y%m%d-%H%M%S}", plain, fmt::localtime(std::time(nullptr)));
  std::filesystem::path path = stem + ".png";
  for (int k = 2; std::filesystem::exists(path); ++k) path = fmt::format("{}-{}.png", stem, k);
  render::write_png(path, picture);
  return path;
}

}  // namespace heml::window
