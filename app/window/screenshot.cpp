#include <fmt/chrono.h>
#include <fmt/format.h>

#include <app/render/png.hpp>
#include <app/window/screenshot.hpp>
#include <cctype>
#include <ctime>

namespace heml::window {

std::filesystem::path unused_path(const std::string& name, const std::string& ending) {
  std::string plain = name.empty() ? "body" : name;
  for (char& c : plain)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_' && c != '-') c = '-';
  const std::string stem = fmt::format("heml-{}-{:%Y%m%d-%H%M%S}", plain, fmt::localtime(std::time(nullptr)));
  const std::filesystem::path folder = std::filesystem::current_path();
  std::filesystem::path path = folder / (stem + ending);
  for (int k = 2; std::filesystem::exists(path); ++k) path = folder / fmt::format("{}-{}{}", stem, k, ending);
  return path;
}

std::filesystem::path save_image(const render::Image& image, const std::string& name) {
  const std::filesystem::path path = unused_path(name, ".png");
  render::write_png(path, image);
  return path;
}

}  // namespace heml::window
