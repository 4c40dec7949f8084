#pragma once
// A temporary working folder in a home of its own, for tests of files that the window writes.
#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace heml::test {

struct Workplace {
  std::filesystem::path before = std::filesystem::current_path(), home, path;
  std::string home_before = std::getenv("HOME") ? std::getenv("HOME") : "";
  Workplace() {
    std::string name = (std::filesystem::temp_directory_path() / "heml-workplace-XXXXXX").string();
    REQUIRE(mkdtemp(name.data()));
    home = name;
    path = home / "work";
    std::filesystem::create_directory(path);
    std::filesystem::current_path(path);
    setenv("HOME", home.c_str(), 1);
  }
  ~Workplace() {
    std::filesystem::current_path(before);
    setenv("HOME", home_before.c_str(), 1);
    std::filesystem::remove_all(home);
  }
};

}  // namespace heml::test
