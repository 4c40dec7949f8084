#include <doctest/doctest.h>

#include <app/window/recording_file.hpp>
#include <cstdlib>
#include <fstream>
#include <heml/base/error.hpp>
#include <iterator>
#include <optional>
#include <string>

namespace heml::recording_file_test {

using window::RecordingFile;
namespace fs = std::filesystem;

namespace {

struct Folder {
  fs::path path;
  Folder() {
    std::string name = (fs::temp_directory_path() / "heml-recording-XXXXXX").string();
    REQUIRE(mkdtemp(name.data()));
    path = name;
  }
  ~Folder() { fs::remove_all(path); }
};

/// Why a file is refused; empty: it is not.
std::string refusal(const fs::path& file, const Scene& scene = {}) {
  try {
    const RecordingFile taken(file, scene);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string content(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("a file that holds something is refused and stays, an empty one is taken") {
  const Folder folder;
  const fs::path full = folder.path / "full.jsonl", empty = folder.path / "empty.jsonl";
  std::ofstream(full) << "a recording\n";
  std::ofstream{empty};
  CHECK(refusal(full).find("full.jsonl") != std::string::npos);
  CHECK(refusal(full).find("new file") != std::string::npos);
  CHECK(content(full) == "a recording\n");
  CHECK(refusal(empty).empty());
  CHECK(fs::exists(empty));
}

TEST_CASE("a file is taken by one window at a time, and its lock goes with the owner") {
  const Folder folder;
  const fs::path file = folder.path / "session.jsonl";
  std::optional<RecordingFile> first(std::in_place, file, Scene());
  CHECK(fs::exists(file));
  CHECK(refusal(file).find("another window") != std::string::npos);
  RecordingFile second(std::move(*first));
  first.reset();
  CHECK(refusal(file).find("another window") != std::string::npos);
  second = RecordingFile();
  CHECK(refusal(file).empty());
}

TEST_CASE("a file that nothing was recorded into is removed, one with a recording stays") {
  const Folder folder;
  const fs::path none = folder.path / "none.jsonl", some = folder.path / "some.jsonl";
  CHECK(refusal(none).empty());
  CHECK_FALSE(fs::exists(none));
  {
    const RecordingFile taken(some, {});
    std::ofstream(some) << "a line\n";
  }
  CHECK(content(some) == "a line\n");
}

TEST_CASE("devices are neither refused nor removed, and a scene's own file is refused") {
  const Folder folder;
  CHECK(refusal("/dev/null").empty());
  CHECK(fs::exists("/dev/null"));
  CHECK(refusal(folder.path / "none" / "session.jsonl").find("session.jsonl") != std::string::npos);
  Scene scene;
  scene.file = (folder.path / "scene.json").string();
  std::ofstream(scene.file) << "{}";
  CHECK(refusal(scene.file, scene).find("is read by this run") != std::string::npos);
}

}  // namespace heml::recording_file_test
