#pragma once
// A state folder of a test's own, while it lives.
#include <unistd.h>

#include <app/window/state_folder.hpp>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace heml::test {

struct StateFolder {
  std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("heml-state-" + std::to_string(getpid()));
  StateFolder() { setenv("XDG_STATE_HOME", folder.c_str(), 1); }
  ~StateFolder() {
    unsetenv("XDG_STATE_HOME");
    std::filesystem::remove_all(folder);
  }
};

}  // namespace heml::test
