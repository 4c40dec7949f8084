#include <doctest/doctest.h>
#include <unistd.h>

#include <app/window/screenshot.hpp>
#include <cstdlib>
#include <fstream>
#include <string>

#include "workplace.hpp"

namespace heml::saved_file_names_test {

using test::Workplace;
using window::unused_path;
namespace fs = std::filesystem;

namespace {

/// What stands for a name in the path of a file.
std::string stem_of(const std::string& name) {
  const std::string file = unused_path(name, ".json").filename().string();
  constexpr std::size_t before = 5, after = 21;  // "heml-", and "-20300102-030405.json"
  REQUIRE(file.size() > before + after);
  return file.substr(before, file.size() - before - after);
}

}  // namespace

TEST_CASE("a name keeps its letters in every script and has dashes for what shells dislike") {
  const Workplace workplace;
  CHECK(stem_of("") == "body");
  CHECK(stem_of("kidney_2-b") == "kidney_2-b");
  CHECK(stem_of("a/b c\n;d") == "a-b-c--d");
  CHECK(stem_of("Leber größer") == "Leber-größer");
  CHECK(stem_of("肝臓 печень") == "肝臓-печень");
  CHECK(stem_of("a\u2013b\u00a0c") == "a-b-c");
  CHECK(stem_of("bad \xff\xc3") == "bad---");
}

TEST_CASE("a long name is cut between letters and its file can be written") {
  const Workplace workplace;
  CHECK(stem_of(std::string(300, 'x')) == std::string(100, 'x'));
  std::string long_name = "x";
  for (int k = 0; k < 100; ++k) long_name += "ö";
  const std::string stem = stem_of(long_name);
  CHECK(stem.size() == 99);
  CHECK(long_name.starts_with(stem));
  const fs::path path = unused_path(long_name, ".vtu", "-refined");
  CHECK(path.filename().string().find("-refined-") != std::string::npos);
  CHECK(std::ofstream(path).good());
  CHECK(unused_path(long_name, ".vtu", "-refined") != path);
}

TEST_CASE("files are saved in the home folder when the working directory is gone") {
  const Workplace workplace;
  CHECK(unused_path("kidney", ".json").parent_path() == workplace.path);
  CHECK(window::why_saved_in(workplace.path).empty());
  fs::remove(workplace.path);
  CHECK(unused_path("kidney", ".json").parent_path() == workplace.home);
  CHECK(window::why_saved_in(workplace.home).find("working folder is gone") != std::string::npos);
}

}  // namespace heml::saved_file_names_test
