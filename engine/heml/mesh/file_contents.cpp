#include <fmt/format.h>

#include <cstdint>
#include <fstream>
#include <heml/base/error.hpp>
#include <heml/mesh/file_contents.hpp>

namespace heml {

std::string file_contents(const std::filesystem::path& path) {
  constexpr std::uintmax_t max_bytes = 4'000'000'000;  // nodes and faces have 32-bit numbers
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw InputError(path.string(), "", "there is no such file");
  if (!std::filesystem::is_regular_file(status)) throw InputError(path.string(), "", "is not a plain file");
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) throw InputError(path.string(), "", "cannot be read: " + error.message());
  if (size > max_bytes) throw InputError(path.string(), "", fmt::format("has {} bytes", size), "too large for a mesh");
  std::ifstream in(path, std::ios::binary);
  std::string text(size, '\0');
  in.read(text.data(), static_cast<std::streamsize>(size));
  if (!in) throw InputError(path.string(), "", "cannot be read", "check the file's permissions");
  return text;
}

}  // namespace heml
