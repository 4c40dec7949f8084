#pragma once
// Where tests find things. One file alone is told, so that all others compile to the same in whatever folder.
#include <filesystem>

namespace heml::test {

std::filesystem::path source_folder();
std::filesystem::path build_folder();
std::filesystem::path program();  ///< heml

}  // namespace heml::test
