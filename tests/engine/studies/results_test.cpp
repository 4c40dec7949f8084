#include <doctest/doctest.h>

#include <fstream>
#include <heml/scenario/text_file.hpp>
#include <places.hpp>
#include <studies/results.hpp>

namespace heml::results_test {

namespace {
std::filesystem::path fresh_file(const char* name) {
  const auto file = test::build_folder() / name;
  std::filesystem::remove(file);
  return file;
}
}  // namespace

TEST_CASE("results of a study are there for the next run, bit for bit") {
  const auto file = fresh_file("results_kept.jsonl");
  {
    Results results(file);
    CHECK(results.find("a") == nullptr);
    results.add("a", {{"figure", 0.1}});
    results.add("b", 2);
  }
  const Results again(file);
  REQUIRE(again.find("a"));
  CHECK((*again.find("a"))["figure"] == 0.1);
  CHECK(*again.find("b") == 2);
}

TEST_CASE("results of another build are measured again") {
  const auto file = fresh_file("results_build.jsonl");
  Results(file, "old").add("a", 1);
  CHECK(Results(file, "new").find("a") == nullptr);
  CHECK(Results(file, "old").find("a"));
  CHECK(Results::build_identity().size() == 16);
}

TEST_CASE("a line cut off by an interruption is dropped and written again") {
  const auto file = fresh_file("results_cut.jsonl");
  Results(file, "one").add("a", 1);
  std::ofstream(file, std::ios::app) << R"({"key":"b","build":"one","res)";
  Results results(file, "one");
  CHECK(results.find("a"));
  CHECK(results.find("b") == nullptr);
  results.add("b", 2);
  CHECK(Results(file, "one").find("b"));
}

}  // namespace heml::results_test
