#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <heml/base/byte_order_mark.hpp>
#include <heml/base/error.hpp>
#include <heml/scenario/text_file.hpp>

namespace heml {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t max_file = 1'000'000'000;  // bytes

}  // namespace

std::string read_text_file(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status))
    throw InputError(path.string(), "", fmt::format("cannot be read: {}", error ? error.message() : "no such file"),
                     "check the path");
  if (!fs::is_regular_file(status)) throw InputError(path.string(), "", "is not a file", "give the path of a file");
  const std::uintmax_t size = fs::file_size(path, error);
  if (error || size > max_file)
    throw InputError(path.string(), "", fmt::format("is {} bytes", size), fmt::format("at most {}", max_file));
  std::string text(size, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(text.data(), static_cast<std::streamsize>(size));
  if (!file)
    throw InputError(path.string(), "", fmt::format("cannot be read: {}", std::strerror(errno)),
                     "check its permissions");
  text.erase(0, byte_order_mark_size(text));
  return text;
}

bool is_blank(std::string_view text) { return text.find_first_not_of(" \t\r\n") == text.npos; }

std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

}  // namespace heml
