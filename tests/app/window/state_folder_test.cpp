#include <doctest/doctest.h>

#include <fstream>

#include "temporary_state.hpp"

namespace heml::state_folder_test {

using namespace heml::window;
using Views = panel::CameraController::SavedViews;
namespace fs = std::filesystem;

namespace {

struct StateFolder : test::StateFolder {
  void write(const char* name, const std::string& text) const {
    fs::create_directories(state_folder());
    std::ofstream(state_folder() / name) << text;
  }
};

Views views_of(float turn) {
  Views views;
  views[0] = render::CameraPose{{0.1f, -2e-7f, 3}, 0.07f, 0.31f, turn, -0.5f, true};
  views[3] = render::CameraPose{{0, 0, 0}, 1, 4, 2 * turn, 0, false};
  return views;
}

}  // namespace

TEST_CASE("camera views are kept by the scene's file") {
  const StateFolder state;
  CHECK(saved_views("a scene.json") == Views{});
  remember_views("a scene.json", views_of(1.0f / 3));
  remember_views("b.json", views_of(1));
  CHECK(saved_views("a scene.json") == views_of(1.0f / 3));
  CHECK(saved_views(fs::current_path() / "b.json") == views_of(1));
  remember_views("a scene.json", views_of(2));
  CHECK(saved_views("a scene.json") == views_of(2));
  CHECK(saved_views("") == Views{});
}

TEST_CASE("a mesh whose section was folded away is remembered by its file alone") {
  const StateFolder state;
  CHECK_FALSE(is_mesh_folded("a.mesh"));
  remember_mesh_folded("a.mesh", true);
  CHECK(is_mesh_folded("a.mesh"));
  CHECK(is_mesh_folded(fs::current_path() / "a.mesh"));
  CHECK_FALSE(is_mesh_folded("b.mesh"));
  CHECK_FALSE(is_mesh_folded(""));
  remember_mesh_folded("b.mesh", true);
  remember_mesh_folded("a.mesh", false);
  CHECK_FALSE(is_mesh_folded("a.mesh"));
  CHECK(is_mesh_folded("b.mesh"));
  for (int k = 0; k < 100; ++k) remember_mesh_folded("mesh" + std::to_string(k), true);
  CHECK_FALSE(is_mesh_folded("b.mesh"));
  CHECK(is_mesh_folded("mesh0"));
}

TEST_CASE("nothing is kept of a scene whose working directory is gone") {
  const StateFolder state;
  const fs::path before = fs::current_path(), gone = fs::temp_directory_path() / "heml-gone";
  fs::create_directories(gone);
  fs::current_path(gone);
  fs::remove(gone);
  remember_views("a.json", views_of(1));
  remember_mesh_folded("a.mesh", true);
  CHECK(saved_views("a.json") == Views{});
  CHECK_FALSE(is_mesh_folded("a.mesh"));
  fs::current_path(before);
}

TEST_CASE("views of a hundred scenes are kept, those written last") {
  const StateFolder state;
  for (int k = 0; k <= 100; ++k) remember_views("scene" + std::to_string(k), views_of(1));
  CHECK(saved_views("scene0") == Views{});
  CHECK(saved_views("scene1") == views_of(1));
  CHECK(saved_views("scene100") == views_of(1));
}

TEST_CASE("lines of no use are skipped among the kept views") {
  const StateFolder state;
  const std::string path = (fs::current_path() / "a.json").string();
  state.write("views", "0 0 0 0 1 4 0 0 0 " + path + "\n5 0 0 0 1 4 0 0 0 " + path + "\n1 0 0 0 -1 4 0 0 0 " + path +
                           "\n1 0 0 0 nan 4 0 0 0 " + path + "\n2 0 0\n\nwords\n3 0 0 0 1 4 0 0 0 " + path + "\n");
  Views third;
  third[2] = render::CameraPose{{0, 0, 0}, 1, 4, 0, 0, false};
  CHECK(saved_views("a.json") == third);
}

TEST_CASE("preferences are kept in a file, and as at first without one") {
  const StateFolder state;
  CHECK(read_preferences() == panel::Preferences{});
  panel::Preferences kept;
  kept.look.theme = panel::Theme::light;
  write_preferences(kept);
  CHECK(read_preferences() == kept);
}

}  // namespace heml::state_folder_test
