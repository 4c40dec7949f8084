#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <app/window/library.hpp>
#include <app/window/state_folder.hpp>
#include <cstdlib>
#include <fstream>

namespace heml::library_test {

using namespace heml::window;
namespace fs = std::filesystem;

namespace {

/// A temporary folder, which also has the state folder.
struct Folder {
  fs::path path;
  Folder() {
    std::string name = (fs::temp_directory_path() / "heml-library-XXXXXX").string();
    REQUIRE(mkdtemp(name.data()));
    path = name;
    setenv("XDG_STATE_HOME", (path / ".state").c_str(), 1);
  }
  ~Folder() { fs::remove_all(path); }
  fs::path write(const std::string& name) const {
    std::ofstream(path / name) << "text";
    return path / name;
  }
};

}  // namespace

TEST_CASE("every installed scene is listed with title, description and thumbnail") {
  const Folder folder;
  const Listing listing = list_choices({}, true);
  CHECK(listing.choices.scenes.size() >= 14);
  CHECK(listing.choices.extreme.size() >= 20);
  for (const panel::OpenChoice& choice : listing.choices.scenes) {
    CAPTURE(choice.path.string());
    CHECK_FALSE(choice.title.empty());
    CHECK_FALSE(choice.description.empty());
    REQUIRE(listing.pictures.count(choice.path));
    const render::Size size = listing.pictures.at(choice.path).size;
    CHECK(size.width * 9 == size.height * 16);
  }
}

TEST_CASE("a folder lists its parent, folders and files that can be opened") {
  const Folder folder;
  fs::create_directory(folder.path / "organs");
  for (const char* name : {"liver.obj", "beam.json", "notes.txt", "Beam.JSONL", ".hidden.json", "box.msh"})
    folder.write(name);
  const auto files = list_choices(folder.path, false).choices.files;
  std::vector<std::string> titles;
  for (const panel::OpenChoice& choice : files) titles.push_back(choice.title);
  CHECK(titles == std::vector<std::string>{"..", "organs", "Beam.JSONL", "beam.json", "box.msh", "liver.obj"});
  CHECK(files[0].path == folder.path.parent_path());
  CHECK(files[1].is_folder);
  CHECK_FALSE(files[2].is_folder);
  CHECK(files[2].description.starts_with("recording"));
  CHECK(files[5].description.starts_with("surface"));
}

TEST_CASE("a folder that cannot be read has a message") {
  const Folder folder;
  const auto choices = list_choices(folder.path / "nowhere", false).choices;
  CHECK_FALSE(choices.problem.empty());
  CHECK(choices.files.size() == 1);
}

TEST_CASE("recent files are listed once, latest first, and missing ones are marked") {
  const Folder folder;
  const fs::path a = fs::canonical(folder.write("a.json")), b = fs::canonical(folder.write("b.json"));
  remember_file(a);
  remember_file(b);
  remember_file(a);
  CHECK(recent_files() == std::vector{a, b});
  fs::remove(b);
  const auto recent = list_choices({}, false).choices.recent;
  REQUIRE(recent.size() == 2);
  CHECK(recent[0].exists);
  CHECK_FALSE(recent[1].exists);
  for (int k = 0; k < 40; ++k) remember_file(folder.path / fmt::format("c{}", k));
  CHECK(recent_files().size() == 20);
}

}  // namespace heml::library_test
