#pragma once
// Substitutes for heml-mesher, and environment variables for tests.
#include <doctest/doctest.h>
#include <stdlib.h>

#include <filesystem>
#include <heml/mesh/textured_surface.hpp>
#include <optional>
#include <string>

#include "engine/mesh/files.hpp"

namespace heml {

/// Sanitizers reserve terabytes of address space, so helpers built with them have no memory limit.
#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool helpers_have_memory_limits = false;
#elif defined(__has_feature)
inline constexpr bool helpers_have_memory_limits = !__has_feature(address_sanitizer);
#else
inline constexpr bool helpers_have_memory_limits = true;
#endif

/// Sets an environment variable during its lifetime.
class Environment {
 public:
  Environment(const char* name, const std::string& value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    setenv(name, value.c_str(), 1);
  }
  ~Environment() { old_ ? setenv(name_, old_->c_str(), 1) : unsetenv(name_); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  const char* name_;
  std::optional<std::string> old_;
};

/// Whether this build reads surfaces to be drawn; prints a message if not.
inline bool reads_skins() {
  const TemporaryFolder folder;
  const std::string said = refusal([&] { read_textured_surface(folder.file("a.obj", "")); });
  const bool missing = said.find("HEML_ASSIMP") != said.npos;
  if (missing) MESSAGE("skipped: ", said);
  return !missing;
}

/// Creates a helper that runs a shell script; its answer goes to file descriptor 3. Returns its path.
inline std::string helper_of(const TemporaryFolder& folder, const std::string& script) {
  const auto path = folder.file("helper", "#!/bin/sh\n" + script + "\n");
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  return path.string();
}

}  // namespace heml
