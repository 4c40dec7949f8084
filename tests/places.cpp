#include <places.hpp>

namespace heml::test {

std::filesystem::path source_folder() { return HEML_SOURCE_DIR; }
std::filesystem::path build_folder() { return HEML_BINARY_DIR; }
std::filesystem::path program() { return HEML_BINARY; }

}  // namespace heml::test
