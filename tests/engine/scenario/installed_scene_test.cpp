#include <doctest/doctest.h>
#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <heml/scenario/installed_scene.hpp>
#include <heml/scenario/scene.hpp>

#include "engine/mesh/files.hpp"

namespace heml::installed_scene_test {

TEST_CASE("names of installed scenes stand for their files, in folders too") {
  const std::filesystem::path scenes = assets_folder() / "scenes";
  CHECK(scene_path("cantilever") == (scenes / "cantilever.json").string());
  CHECK(scene_path("extreme/01_force") == (scenes / "extreme/01_force.json").string());
  CHECK(read_scene(scene_path("cantilever")).name == "cantilever");
}

TEST_CASE("a misspelt name of an installed scene is told with the one that may be meant") {
  const std::pair<const char*, const char*> names[] = {{"cantilevr", "cantilever"},
                                                       {"extreme/1_force", "extreme/01_force"},
                                                       {"kidney-grasp", "kidney_grasp"},
                                                       {"livercut", "liver_cut"}};
  for (const auto& name : names) {
    const std::string said = refusal([&] { scene_path(name.first); });
    CHECK(said.find(fmt::format("did you mean '{}'?", name.second)) != std::string::npos);
  }
}

TEST_CASE("what is no name of an installed scene, or a file here, stays as given") {
  for (const char* given : {"", "no_such_scene", "extreme", "cantilever.json", "../scenes/cantilever", "/cantilever",
                            "./cantilever", "extreme/", "kidney grasp"})
    CHECK(scene_path(given) == given);
  const std::filesystem::path before = std::filesystem::current_path();
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("heml-installed-scene-test-" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  std::filesystem::current_path(folder);
  std::ofstream("twist") << "{}";
  CHECK(scene_path("twist") == "twist");
  CHECK(scene_path("cube") != "cube");
  std::filesystem::current_path(before);
  std::filesystem::remove_all(folder);
}

}  // namespace heml::installed_scene_test
