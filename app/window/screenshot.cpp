#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <app/render/png.hpp>
#include <app/window/screenshot.hpp>
#include <cctype>
#include <cstdlib>
#include <ctime>
#include <heml/base/error.hpp>
#include <string_view>

namespace heml::window {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t max_name = 100;  // bytes; file systems take 255, of the whole name

bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

/// Bytes of a character of UTF-8 by its first one; 0: no character begins so.
std::size_t length_from(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xc2 && first < 0xe0) return 2;
  if (first >= 0xe0 && first < 0xf0) return 3;
  return first >= 0xf0 && first < 0xf5 ? 4 : 0;
}

/// Whether two bytes begin what is no character (overlong, a surrogate, beyond the last one), or is one that does not
/// print: controls and the spaces and directions of "General Punctuation".
bool is_unfit(unsigned char first, unsigned char second) {
  if (first == 0xc2) return second <= 0xa0;
  if (first == 0xe0) return second < 0xa0;
  if (first == 0xe2) return second <= 0x81;
  if (first == 0xed) return second >= 0xa0;
  if (first == 0xf0) return second < 0x90;
  return first == 0xf4 && second >= 0x90;
}

/// Bytes of the character at the start of a text that may stand in the name of a file; 0: it may not.
std::size_t fit_length(std::string_view text) {
  const auto first = static_cast<unsigned char>(text[0]);
  if (first < 0x80) return std::isalnum(first) || first == '_' || first == '-' ? 1 : 0;
  const std::size_t length = length_from(first);
  if (length == 0 || length > text.size() || is_unfit(first, static_cast<unsigned char>(text[1]))) return 0;
  for (std::size_t k = 1; k < length; ++k)
    if (!is_continuation(text[k])) return 0;
  return length;
}

/// A name as part of that of a file.
std::string name_in_file(const std::string& name) {
  std::string stem;
  for (std::string_view rest = name; !rest.empty();) {
    const std::size_t length = fit_length(rest);
    if (stem.size() + std::max<std::size_t>(length, 1) > max_name) break;
    stem += length > 0 ? rest.substr(0, length) : "-";
    rest.remove_prefix(std::max<std::size_t>(length, 1));
    while (!rest.empty() && is_continuation(rest[0])) rest.remove_prefix(1);  // of what the dash stands for
  }
  return stem.empty() ? "body" : stem;
}

bool can_save_in(const fs::path& folder) {
  std::error_code failed;
  return !folder.empty() && fs::is_directory(folder, failed) && access(folder.c_str(), W_OK) == 0;
}

fs::path folder_to_save_in() {
  std::error_code failed;
  const char* home = std::getenv("HOME");
  for (const fs::path& folder : {fs::current_path(failed), fs::path(home ? home : ""), fs::temp_directory_path(failed)})
    if (can_save_in(folder)) return folder;
  throw InputError("", "the working directory", "is gone or cannot be written, and so are home and temporary folder",
                   "make one of them again, and save again: what is open stays as it is");
}

}  // namespace

fs::path unused_path(const std::string& name, const std::string& ending, const std::string& kind) {
  const std::string stem =
      fmt::format("heml-{}{}-{:%Y%m%d-%H%M%S}", name_in_file(name), kind, fmt::localtime(std::time(nullptr)));
  const fs::path folder = folder_to_save_in();
  fs::path path = folder / (stem + ending);
  std::error_code failed;
  for (int k = 2; fs::exists(path, failed); ++k) path = folder / fmt::format("{}-{}{}", stem, k, ending);
  return path;
}

std::string why_saved_in(const fs::path& folder) {
  std::error_code failed;
  const fs::path working = fs::current_path(failed);
  if (working.empty()) return "\nIt is there because the working folder is gone.";
  return folder == working ? "" : "\nIt is there because the working folder cannot be written.";
}

fs::path save_image(const render::Image& image, const std::string& name) {
  const fs::path path = unused_path(name, ".png");
  render::write_png(path, image);
  return path;
}

}  // namespace heml::window
