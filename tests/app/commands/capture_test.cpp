#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <app/render/png.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <places.hpp>
#include <string>

namespace heml::capture_test {

namespace {

const std::filesystem::path golden = test::source_folder() / "tests" / "golden";
constexpr double limit = 3.0;  // of 255, per-pixel rms: allows for rounding of drivers

struct TemporaryFolder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("heml-capture-test-" + std::to_string(getpid()));
  TemporaryFolder() { std::filesystem::create_directories(path); }
  ~TemporaryFolder() { std::filesystem::remove_all(path); }
};

/// Frames of a scene as the program captures them, 320 × 180.
render::Image captured(const std::filesystem::path& scene, int frame, const TemporaryFolder& folder,
                       const std::string& more = "") {
  const auto out = folder.path / "frames";
  const std::string command = test::program().string() + " capture '" + scene.string() + "' --out '" + out.string() +
                              "' --size 320x180 --fps 10 --frames " + std::to_string(frame + 1) + more + " >/dev/null";
  REQUIRE(std::system(command.c_str()) == 0);
  return render::read_png(out / ("frame_0000" + std::to_string(frame) + ".png"));
}

std::filesystem::path scene(const char* name) {
  return test::source_folder() / "assets" / "scenes" / (std::string(name) + ".json");
}

/// Share of pixels that are clearly redder than they are green: the tissue.
double coverage(const render::Image& image) {
  int count = 0;
  for (int y = 0; y < image.size.height; ++y)
    for (int x = 0; x < image.size.width; ++x) count += image.at(x, y)[0] > 1.4 * image.at(x, y)[1];
  return count / static_cast<double>(image.size.width * image.size.height);
}

}  // namespace

TEST_CASE("a capture looks from the side that is asked for, without perspective where asked") {
  const TemporaryFolder folder;
  const render::Image given = captured(scene("kidney_pull"), 0, folder);
  const render::Image front = captured(scene("kidney_pull"), 0, folder, " --view front");
  const render::Image flat = captured(scene("kidney_pull"), 0, folder, " --view front --orthographic");
  CHECK(render::rms_difference(given, front) > 5);
  CHECK(render::rms_difference(front, flat) > 1);
  CHECK(coverage(flat) == doctest::Approx(coverage(front)).epsilon(0.1));  // of the same size
  const std::string wrong = test::program().string() + " capture --out x --view above 2>/dev/null >/dev/null";
  CHECK(std::system(wrong.c_str()) != 0);
}

TEST_CASE("captured frames are those committed, and show the body") {
  const TemporaryFolder folder;
  for (const char* name : {"kidney_pull", "uterus"}) {
    const render::Image frame = captured(scene(name), 5, folder);
    const auto file = golden / (std::string(name) + "_5.png");
    if (std::getenv("HEML_UPDATE_GOLDEN")) render::write_png(file, frame);
    const double rms = render::rms_difference(frame, render::read_png(file));
    MESSAGE(std::string(name) << ": rms " << rms << ", coverage " << coverage(frame));
    CHECK(rms <= limit);
    CHECK(coverage(frame) > 0.04);
    CHECK(coverage(frame) < 0.6);
  }
}

TEST_CASE("a later frame differs from the committed one by more than the limit") {
  const TemporaryFolder folder;
  CHECK(render::rms_difference(captured(scene("kidney_pull"), 8, folder),
                               render::read_png(golden / "kidney_pull_5.png")) > limit);
}

TEST_CASE("a colour map adds a legend at the bottom and --panel adds the panel's columns") {
  const TemporaryFolder folder;
  const auto plain = captured(scene("irregular_cube"), 0, folder),
             with_panel = captured(scene("irregular_cube"), 0, folder, " --panel");
  int left = 0;
  for (int y = 0; y < 180; ++y)
    for (int x = 0; x < 60; ++x) left += !std::equal(plain.at(x, y), plain.at(x, y) + 3, with_panel.at(x, y));
  CHECK(left > 60 * 180 / 2);
  // Tissue and displacement of the same scene: the bottom of the image, below the body, differs by the legend.
  std::ifstream in(scene("cube"));
  std::string text((std::istreambuf_iterator<char>(in)), {});
  const auto at = text.find("\"field\": \"");
  REQUIRE(at != std::string::npos);
  const auto end = text.find('"', at + 10);
  const auto changed = [&](const char* field) {
    std::ofstream(folder.path / "scene.json") << text.substr(0, at + 10) << field << text.substr(end);
    return captured(folder.path / "scene.json", 1, folder);
  };
  const auto tissue = changed("none"), coloured = changed("displacement");
  int legend = 0;
  for (int y = 166; y < 180; ++y)
    for (int x = 100; x < 220; ++x) legend += !std::equal(tissue.at(x, y), tissue.at(x, y) + 3, coloured.at(x, y));
  CHECK(legend > 200);
}

TEST_CASE("each comparison run is drawn in its own pane of the frame") {
  const TemporaryFolder folder;
  const render::Image frame = captured(scene("kidney_pull"), 3, folder, " --beside ogden,tr_bdf2,float");
  REQUIRE(frame.size == render::Size{320, 180});
  constexpr int line = 4;  // pixels left out round the lines between panes
  const auto part = [&](int column, int row, int from) {
    render::Image image({160 - line, 90 - from});
    for (int y = from; y < 90; ++y)
      std::copy_n(frame.at(160 * column + line, 90 * row + y), std::size_t{3} * (160 - line), image.at(0, y - from));
    return image;
  };
  for (const int row : {0, 1})
    for (const int column : {0, 1}) {
      CAPTURE(row);
      CAPTURE(column);
      CHECK(coverage(part(column, row, line)) > 0.04);
    }
  const auto apart = [&](int column, int row) {  // below the labels
    return render::rms_difference(part(0, 0, 40), part(column, row, 40));
  };
  MESSAGE("from the body: ogden " << apart(1, 0) << ", tr_bdf2 " << apart(0, 1) << ", float " << apart(1, 1));
  CHECK(apart(1, 1) < 1);            // the same motion, other noise of the backdrop
  CHECK(apart(1, 0) > apart(1, 1));  // another tissue
  const std::string wrong = test::program().string() + " capture '" + scene("kidney_pull").string() + "' --out '" +
                            folder.path.string() + "' --beside ogdn 2>/dev/null";
  CHECK(WEXITSTATUS(std::system(wrong.c_str())) == 3);
}

}  // namespace heml::capture_test
