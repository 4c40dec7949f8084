#include <doctest/doctest.h>

#include <algorithm>
#include <engine/mesh/files.hpp>
#include <engine/scenario/samples.hpp>
#include <heml/mesh/generate.hpp>
#include <heml/mesh/write.hpp>
#include <heml/scenario/input_files.hpp>
#include <heml/scenario/positions_csv.hpp>
#include <heml/scenario/solve.hpp>
#include <iterator>

namespace heml::input_files_test {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A scene in report.json with positions.csv and mesh.vtu: input files named like outputs of commands.
fs::path scene_of_files(const TemporaryFolder& folder) {
  const TetMesh mesh = make_box(Vec3(0.2, 0.1, 0.1), {2, 1, 1});
  write_tet_mesh(folder / "mesh.vtu", mesh);
  write_positions_csv(folder / "positions.csv", mesh.nodes);
  return folder.file("report.json", test::scene_with(R"({"mesh": {"box": null, "file": "mesh.vtu"},
                                                         "initial": {"positions": "positions.csv"}})"));
}

}  // namespace

TEST_CASE("a scene's files are its own, its mesh's and its positions'") {
  const TemporaryFolder folder;
  const Scene scene = read_scene(scene_of_files(folder));
  const auto files = input_files(scene);
  for (const char* name : {"report.json", "mesh.vtu", "positions.csv"})
    CHECK(std::count(files.begin(), files.end(), folder / name) >= 1);
  Scene tetgen = scene;
  tetgen.mesh.file = folder / "body.ele";
  const auto both = input_files(tetgen);
  CHECK(std::count(both.begin(), both.end(), folder / "body.node") == 1);
}

TEST_CASE("what is read is not written over, by whatever name") {
  const TemporaryFolder folder;
  const fs::path input = folder.file("in.csv", "kept");
  fs::create_symlink("in.csv", folder / "link.csv");
  fs::create_hard_link(input, folder / "hard.csv");
  fs::create_directory(folder / "sub");
  for (const fs::path& output : {input, folder / "link.csv", folder / "hard.csv", folder / "sub/../in.csv"}) {
    const std::string why = refusal([&] { refuse_overwriting({input}, {output}, "--plot"); });
    CHECK(says(why, output.string() + ": is read by this run"));
    CHECK(says(why, "give another --plot"));
  }
  CHECK(refusal([&] { refuse_overwriting({input}, {folder / "out.csv", folder / "sub"}); }) == "");
  CHECK(refusal([&] { refuse_overwriting({"/dev/null"}, {"/dev/null"}); }) == "");
}

TEST_CASE("solve refuses to replace or take away what its scene reads, before it computes") {
  const TemporaryFolder folder;
  const fs::path file = scene_of_files(folder);
  const std::string text = text_of(file), positions = text_of(folder / "positions.csv");
  CHECK(says(refusal([&] { solve(read_scene(file), folder / ""); }), "report.json: is read by this run"));
  fs::rename(file, folder / "scene.json");
  CHECK(says(refusal([&] { solve(read_scene(folder / "scene.json"), folder / ""); }),
                   "positions.csv: is read by this run"));
  CHECK(text_of(folder / "scene.json") == text);
  CHECK(text_of(folder / "positions.csv") == positions);
  CHECK(std::distance(fs::directory_iterator(folder / ""), {}) == 3);
  solve(read_scene(folder / "scene.json"), folder / "out");
  CHECK(fs::exists(folder / "out/report.json"));
}

TEST_CASE("frames of an earlier run are known by their names") {
  const TemporaryFolder folder;
  for (const char* name :
       {"frame_00000.png", "frame_123456.png", "frame_.png", "frame_1a.png", "frame_00001.vtu", "a.png"})
    folder.file(name, "");
  auto frames = frames_in(folder / "", ".png");
  std::sort(frames.begin(), frames.end());
  CHECK(frames == std::vector<fs::path>{folder / "frame_00000.png", folder / "frame_123456.png"});
  CHECK(frames_in(folder / "none", ".png").empty());
}

}  // namespace heml::input_files_test
