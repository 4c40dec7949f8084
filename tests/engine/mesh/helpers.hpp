#pragma once
// Stand-ins for heml-mesher, and what the program finds in its environment.
#include <stdlib.h>

#include <filesystem>
#include <optional>
#include <string>

#include "engine/mesh/files.hpp"

namespace heml {

/// Sanitizers reserve terabytes of addresses: helpers built with them have no limit on memory.
#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool helpers_have_memory_limits = false;
#elif defined(__has_feature)
inline constexpr bool helpers_have_memory_limits = !__has_feature(address_sanitizer);
#else
inline constexpr bool helpers_have_memory_limits = true;
#endif

/// A variable of the environment, for as long as this lives.
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

/// A helper that does as a shell script says; its answer goes to file descriptor 3.
inline std::string helper_of(const TemporaryFolder& folder, const std::string& script) {
  const auto path = folder.file("helper", "#!/bin/sh\n" + script + "\n");
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  return path.string();
}

}  // namespace heml
