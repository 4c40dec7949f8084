#include <doctest/doctest.h>
#include <fmt/format.h>
#include <unistd.h>

#include <app/window/unsaved_work.hpp>
#include <fstream>
#include <thread>

#include "temporary_state.hpp"

namespace heml::unsaved_work_test {

using namespace heml::window;
namespace fs = std::filesystem;

namespace {

struct StateFolder : test::StateFolder {
  std::size_t files() const {
    std::error_code failed;
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(state_folder(), failed), {}));
  }
};

Scene small_work() {
  Scene scene;
  scene.name = "small";
  scene.mesh.asset = "kidney";
  scene.materials = {{std::nullopt, {"stvk", {2e4, 1e4}, 1000}}};
  scene.events = {{3, SetDamping{2}}, {5, Reset{}}};
  scene.recorded_ticks = 9;
  return scene;
}

}  // namespace

TEST_CASE("settings are saved by a scene file, what tools did by recordings alone") {
  const StateFolder state;
  UnsavedWork work;
  CHECK_FALSE(work.any());
  work.done(SetDamping{2});
  CHECK(work.any());
  CHECK_FALSE(work.is_due());  // not at once
  work.scene_saved();
  CHECK_FALSE(work.any());
  work.done(Grasp{});
  work.scene_saved();
  CHECK(work.any());
  work.saved();
  CHECK_FALSE(work.any());
}

TEST_CASE("a reset or a release alone is no work") {
  const StateFolder state;
  UnsavedWork work;
  work.done(Reset{});
  work.done(Release{});
  CHECK_FALSE(work.any());
  work.done(Grasp{});
  work.scene_saved();
  work.done(Reset{});
  CHECK(work.any());
}

TEST_CASE("what is in a recording that ended early is unsaved, and written at once") {
  const StateFolder state;
  UnsavedWork work;
  work.recording_ended();
  CHECK(work.any());
  CHECK(work.is_due());
  work.scene_saved();
  CHECK(work.any());
}

TEST_CASE("work is written to a file that goes when it is saved") {
  const StateFolder state;
  UnsavedWork work;
  work.done(Grasp{});
  work.save(small_work());
  for (int k = 0; k < 1000 && state.files() == 0; ++k) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  CHECK(state.files() == 1);
  CHECK_FALSE(UnsavedWork::left_behind());  // this program still runs
  work.saved();
  CHECK(state.files() == 0);
}

TEST_CASE("the file of a program that ended is offered and taken over") {
  const StateFolder state;
  fs::create_directories(state_folder());
  const fs::path left = state_folder() / "unsaved-2147480000.jsonl";  // no such process
  std::ofstream(left) << recording_of(small_work(), state_folder());
  std::ofstream(state_folder() / "unsaved-words.jsonl") << "{}";
  CHECK(UnsavedWork::left_behind() == left);
  const Scene scene = read_scene(left);
  CHECK(scene.events.size() == 2);
  CHECK(scene.recorded_ticks == 9);
  UnsavedWork work;
  work.adopt(left);
  CHECK(work.any());
  CHECK_FALSE(fs::exists(left));
  CHECK_FALSE(UnsavedWork::left_behind());
}

TEST_CASE("the file of a program whose number another has now is offered, this one's too, and stays") {
  const StateFolder state;
  fs::create_directories(state_folder());
  const auto long_ago = fs::file_time_type::clock::now() - std::chrono::hours(24 * 3650);
  const fs::path first = state_folder() / "unsaved-1.jsonl";  // process 1 always runs
  std::ofstream(first) << recording_of(small_work(), state_folder());
  CHECK_FALSE(UnsavedWork::left_behind());
  fs::last_write_time(first, long_ago);
  CHECK(UnsavedWork::left_behind() == first);
  const fs::path own = state_folder() / fmt::format("unsaved-{}.jsonl", getpid());
  fs::rename(first, own);
  const auto left = UnsavedWork::left_behind();
  REQUIRE(left);
  CHECK(*left != own);
  CHECK(UnsavedWork::left_behind() == left);  // later
  UnsavedWork work;
  work.adopt(*left);
  CHECK(fs::exists(own));
  CHECK_FALSE(UnsavedWork::left_behind());  // now it is this program's
}

}  // namespace heml::unsaved_work_test
