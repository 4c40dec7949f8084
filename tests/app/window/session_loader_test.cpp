#include <doctest/doctest.h>

#include <app/window/session_loader.hpp>
#include <app/window/state_folder.hpp>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <thread>

namespace heml::opening_test {

using namespace heml::window;
namespace fs = std::filesystem;

namespace {

/// A temporary folder, which also has the state folder.
struct Folder {
  fs::path path;
  Folder() {
    std::string name = (fs::temp_directory_path() / "heml-opening-XXXXXX").string();
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

std::variant<OpenScene, std::string> wait_for(window::SessionLoader& opening) {
  for (int k = 0; k < 3000; ++k) {
    if (auto result = opening.take()) return std::move(*result);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return std::string("nothing came of it");
}

}  // namespace

TEST_CASE("a dropped scene becomes a running session, recorded beside the first one") {
  const Folder folder;
  window::SessionLoader opening;
  opening.begin(write(folder, "box.json", box), folder.path / "out.jsonl");
  CHECK(opening.under_way());
  auto result = wait_for(opening);
  auto* opened = std::get_if<OpenScene>(&result);
  REQUIRE(opened);
  CHECK(opened->scene.name == "box");
  CHECK(opened->session->latest().surface_mesh->nodes.size() == 8);
  CHECK_FALSE(opening.under_way());
  CHECK(fs::exists(folder.path / "out-2.jsonl"));
  CHECK_FALSE(fs::exists(folder.path / "out.jsonl"));
  CHECK(next_recording(folder.path / "out.jsonl") == folder.path / "out-3.jsonl");
}

TEST_CASE("a moment is gone back to in a session of its own, recorded beside the old one") {
  const Folder folder;
  const auto file = write(folder, "box.json", box);
  OpenScene old = start(read_scene(file), folder.path / "out.jsonl");
  while (old.session->latest().tick < 30) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  old.session->pause();
  while (!old.session->latest().paused) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  Frame moment = old.session->latest();
  moment.tick = 17;
  window::SessionLoader opening;
  opening.resume(old.session->until(moment), folder.path / "out.jsonl");
  CHECK(opening.progress());
  auto result = wait_for(opening);
  auto* resumed = std::get_if<OpenScene>(&result);
  REQUIRE(resumed);
  CHECK(resumed->resumed == 17);
  CHECK(resumed->was_recorded);
  CHECK(resumed->recording == folder.path / "out-2.jsonl");
  CHECK(resumed->session->latest().tick == 17);
  CHECK(resumed->session->latest().paused);
}

TEST_CASE("going back can be given up, and leaves nothing behind") {
  const Folder folder;
  OpenScene old = start(read_scene(write(folder, "box.json", box)), std::nullopt);
  Frame moment;
  moment.tick = 1'000'000'000;
  window::SessionLoader opening;
  opening.resume(old.session->until(moment), folder.path / "out.jsonl");
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  CHECK(*opening.progress() < 100);
  opening.cancel();
  for (int k = 0; k < 500 && opening.under_way(); ++k) {
    CHECK_FALSE(opening.take());
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  CHECK_FALSE(opening.under_way());
  CHECK_FALSE(fs::exists(folder.path / "out-2.jsonl"));
}

TEST_CASE("a dropped file that is no scene says what is wrong with it, and another may follow") {
  const Folder folder;
  window::SessionLoader opening;
  opening.begin(write(folder, "bad.json", R"({"schema_version": 1, "mash": {}})"), std::nullopt);
  const auto result = wait_for(opening);
  const auto* problem = std::get_if<std::string>(&result);
  REQUIRE(problem);
  CHECK(problem->find("bad.json") != std::string::npos);
  CHECK(problem->find("mash") != std::string::npos);
  opening.begin(folder.path / "missing.msh", std::nullopt);
  CHECK(std::holds_alternative<std::string>(wait_for(opening)));
  opening.begin(write(folder, "box.json", box), std::nullopt);
  CHECK(std::holds_alternative<OpenScene>(wait_for(opening)));
  CHECK(recent_files() == std::vector{fs::canonical(folder.path / "box.json")});
}

}  // namespace heml::opening_test
