#pragma once
// Paths for tests. Only places.cpp is compiled with them, so that all other objects are the same in any folder.
#include <filesystem>

namespace heml::test {

std::filesystem::path source_folder();
std::filesystem::path build_folder();
std::filesystem::path program();  ///< heml

}  // namespace heml::test
