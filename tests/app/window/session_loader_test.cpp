#include <doctest/doctest.h>

#include <algorithm>
#include <app/window/session_loader.hpp>
#include <app/window/state_folder.hpp>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <heml/mesh/generate.hpp>
#include <heml/mesh/write.hpp>
#include <thread>

namespace heml::session_loader_test {

using namespace heml::window;
namespace fs = std::filesystem;

namespace {

/// A temporary folder, which also has the state folder.
struct Folder {
  fs::path path;
  Folder() {
    std::string name = (fs::temp_directory_path() / "heml-loader-XXXXXX").string();
    REQUIRE(mkdtemp(name.data()));
    path = name;
    setenv("XDG_STATE_HOME", (path / "state").c_str(), 1);
  }
  ~Folder() { fs::remove_all(path); }
};

const char* const box = R"({"schema_version": 1, "name": "box",
  "mesh": {"box": {"size": [0.1, 0.1, 0.1], "cells": [1, 1, 1], "origin": [0, 0, 0]}},
  "materials": [{"law": "stvk", "young": 1e4, "poisson": 0.3}]})";

fs::path write(const Folder& folder, const char* name, const char* text) {
  std::ofstream(folder.path / name) << text;
  return folder.path / name;
}

std::variant<OpenScene, std::string> wait_for(window::SessionLoader& loader) {
  for (int k = 0; k < 3000; ++k) {
    if (auto result = loader.take()) return std::move(*result);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return std::string("no outcome");
}

}  // namespace

TEST_CASE("a dropped scene becomes a running session with a recording next to the first one") {
  const Folder folder;
  window::SessionLoader loader;
  loader.begin(write(folder, "box.json", box), folder.path / "out.jsonl");
  CHECK(loader.is_busy());
  auto result = wait_for(loader);
  auto* opened = std::get_if<OpenScene>(&result);
  REQUIRE(opened);
  CHECK(opened->scene.name == "box");
  CHECK(opened->session->latest().surface_mesh->nodes.size() == 8);
  CHECK_FALSE(loader.is_busy());
  CHECK(fs::exists(folder.path / "out-2.jsonl"));
  CHECK_FALSE(fs::exists(folder.path / "out.jsonl"));
  CHECK(next_recording(folder.path / "out.jsonl") == folder.path / "out-3.jsonl");
}

TEST_CASE("a past tick is resumed in a session of its own with a recording next to the old one") {
  const Folder folder;
  const auto file = write(folder, "box.json", box);
  OpenScene old = start(read_scene(file), folder.path / "out.jsonl");
  while (old.session->latest().tick < 30) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  old.session->pause();
  while (!old.session->latest().paused) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  Frame past = old.session->latest();
  past.tick = 17;
  window::SessionLoader loader;
  loader.resume(old.session->until(past), folder.path / "out.jsonl");
  CHECK(loader.progress());
  auto result = wait_for(loader);
  auto* resumed = std::get_if<OpenScene>(&result);
  REQUIRE(resumed);
  CHECK(resumed->resumed == 17);
  CHECK(resumed->was_recorded);
  CHECK(resumed->recording == folder.path / "out-2.jsonl");
  CHECK(resumed->session->latest().tick == 17);
  CHECK(resumed->session->latest().paused);
}

TEST_CASE("a cancelled resume leaves no session and no file") {
  const Folder folder;
  OpenScene old = start(read_scene(write(folder, "box.json", box)), std::nullopt);
  Frame past;
  past.tick = 1'000'000'000;
  window::SessionLoader loader;
  loader.resume(old.session->until(past), folder.path / "out.jsonl");
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  CHECK(*loader.progress() < 100);
  CHECK(loader.is_replaying());
  loader.cancel();
  CHECK_FALSE(loader.is_replaying());
  for (int k = 0; k < 500 && loader.is_busy(); ++k) {
    CHECK_FALSE(loader.take());
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  CHECK_FALSE(loader.is_busy());
  CHECK_FALSE(fs::exists(folder.path / "out-2.jsonl"));
}

TEST_CASE("a dropped file that is no scene gives a message and another file can follow") {
  const Folder folder;
  window::SessionLoader loader;
  loader.begin(write(folder, "bad.json", R"({"schema_version": 1, "mash": {}})"), std::nullopt);
  const auto result = wait_for(loader);
  const auto* problem = std::get_if<std::string>(&result);
  REQUIRE(problem);
  CHECK(problem->find("bad.json") != std::string::npos);
  CHECK(problem->find("mash") != std::string::npos);
  loader.begin(folder.path / "missing.msh", std::nullopt);
  CHECK(std::holds_alternative<std::string>(wait_for(loader)));
  loader.begin(write(folder, "box.json", box), std::nullopt);
  CHECK(std::holds_alternative<OpenScene>(wait_for(loader)));
  CHECK(recent_files() == std::vector{fs::canonical(folder.path / "box.json")});
}

TEST_CASE("a cancelled load that fails gives no message") {
  const Folder folder;
  window::SessionLoader loader;
  loader.begin(folder.path / "missing.msh", std::nullopt);
  loader.cancel();
  for (int k = 0; k < 3000 && !loader.is_ready(); ++k) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  REQUIRE(loader.is_ready());
  CHECK_FALSE(loader.take());
  CHECK_FALSE(loader.is_busy());
}

TEST_CASE("what was found and chosen for a bare mesh comes with its session, each once") {
  const Folder folder;
  TetMesh mesh = make_box(Vec3(15, 10, 10), {2, 2, 2});
  mesh.nodes.push_back(Vec3(1, 2, 3));  // of no tetrahedron
  write_tet_mesh(folder.path / "organ.msh", mesh);
  window::SessionLoader loader;
  loader.begin(folder.path / "organ.msh", std::nullopt);
  auto result = wait_for(loader);
  auto* opened = std::get_if<OpenScene>(&result);
  REQUIRE(opened);
  const auto count = [&](const char* word) {
    return std::count_if(opened->findings.begin(), opened->findings.end(),
                         [&](const std::string& text) { return text.find(word) != text.npos; });
  };
  CHECK(count("centimetres") == 1);
  CHECK(count("rests on the lowest") == 1);
  CHECK(count("node") == 1);
  CHECK(count("organ.msh") == 0);
}

TEST_CASE("a bare mesh is opened again with what was chosen, and compared as before") {
  const Folder folder;
  write_tet_mesh(folder.path / "organ.msh", make_box(Vec3(15, 10, 10), {2, 2, 2}));
  BareMeshOptions options;
  options.unit = LengthUnit{"millimetres", 0.001};
  options.supports = SupportKind::top;
  window::SessionLoader loader;
  loader.begin(folder.path / "organ.msh", folder.path / "out.jsonl", options, {"verlet"});
  auto result = wait_for(loader);
  auto* opened = std::get_if<OpenScene>(&result);
  REQUIRE(opened);
  CHECK(opened->scene.chosen->given == options);
  CHECK(opened->comparisons == std::vector<std::string>{"verlet"});
  opened->session.reset();
  const Scene recorded = read_scene(folder.path / "out-2.jsonl");
  CHECK(recorded.mesh.scale == 0.001);
  CHECK(load_setup(recorded).boundary[0].nodes == load_setup(opened->scene).boundary[0].nodes);
}

}  // namespace heml::session_loader_test
