#include <heml/scenario/build_identity.hpp>

namespace heml {
namespace {
#if defined(__x86_64__)
constexpr const char* processor = "x86_64";
#elif defined(__aarch64__)
constexpr const char* processor = "aarch64";
#else
constexpr const char* processor = "another processor";
#endif
}  // namespace

std::string compiler_name() {
#if defined(__clang__)
  return "Clang " __clang_version__;
#else
  return "GCC " __VERSION__;
#endif
}

std::string build_name() { return compiler_name() + ", " + processor; }

}  // namespace heml
