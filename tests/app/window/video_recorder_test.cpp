#include <doctest/doctest.h>

#include <algorithm>
#include <app/render/png.hpp>
#include <app/window/video_recorder.hpp>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <thread>

namespace heml::filming_test {

using window::VideoRecorder;
namespace fs = std::filesystem;

namespace {

/// A temporary working directory, with a PATH of its own.
struct Workplace {
  fs::path before = fs::current_path(), path;
  std::string search = std::getenv("PATH");
  Workplace() {
    std::string name = (fs::temp_directory_path() / "heml-filming-XXXXXX").string();
    REQUIRE(mkdtemp(name.data()));
    path = name;
    fs::current_path(path);
    setenv("PATH", (path / "bin").c_str(), 1);
  }
  ~Workplace() {
    fs::current_path(before);
    setenv("PATH", search.c_str(), 1);
    fs::remove_all(path);
  }
  /// A fake ffmpeg: fails for the first codec; for the second writes its arguments into the video.
  void install_ffmpeg() const {
    fs::create_directory(path / "bin");
    std::ofstream(path / "bin" / "ffmpeg") << "#!/bin/sh\n"
                                              "for last; do :; done\n"
                                              "case \"$*\" in *libx264*) echo half > \"$last\"; exit 1;; esac\n"
                                              "echo \"$*\" > \"$last\"\n";
    fs::permissions(path / "bin" / "ffmpeg", fs::perms::owner_all);
  }
  std::vector<fs::path> all(const std::string& ending) const {
    std::vector<fs::path> found;
    for (const auto& entry : fs::recursive_directory_iterator(path))
      if (entry.path().extension() == ending) found.push_back(entry.path());
    std::sort(found.begin(), found.end());
    return found;
  }
};

render::Image grey(int level) {
  render::Image image({8, 6});
  std::fill(image.pixels.begin(), image.pixels.end(), static_cast<std::uint8_t>(level));
  return image;
}

/// As the window does: adds a frame once it is due.
void film(VideoRecorder& filming, double time, int level) {
  for (int wait = 0; wait < 400 && filming.pictures() > 0 && !filming.due(time); ++wait)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  filming.add_frame(grey(level), time);
}

std::string outcome_of(VideoRecorder& filming) {
  filming.finish();
  for (int wait = 0; wait < 3000; ++wait) {
    if (const auto outcome = filming.take_outcome()) return *outcome;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return "nothing came of it";
}

}  // namespace

TEST_CASE("pictures are even in simulated time: what was too late stands for what was missed") {
  const Workplace workplace;
  VideoRecorder filming("a body", {8, 6});
  film(filming, 5.0, 10);
  CHECK_FALSE(filming.due(5.02));
  CHECK(filming.due(5.04));
  film(filming, 5.04, 20);   // number 1
  film(filming, 5.14, 30);   // number 4: 2 and 3 repeat 1
  film(filming, 60.0, 40);   // a gap is cut out: number 5
  film(filming, 1.0, 50);    // so is a step back: number 6
  film(filming, 1.034, 60);  // number 7
  const std::string outcome = outcome_of(filming);
  CHECK(outcome.find("8 frames") != std::string::npos);
  CHECK(outcome.find("ffmpeg is not installed") != std::string::npos);
  std::vector<int> levels;
  for (const fs::path& file : workplace.all(".png")) levels.push_back(render::read_png(file).pixels[0]);
  CHECK(levels == std::vector{10, 20, 20, 20, 30, 40, 50, 60});
}

TEST_CASE("a video is made of the pictures, by another codec where the first is refused") {
  const Workplace workplace;
  workplace.install_ffmpeg();
  VideoRecorder filming("body", {8, 6});
  for (int k = 0; k < 5; ++k) film(filming, k / VideoRecorder::rate + 1e-4, 10 * k);
  const std::string outcome = outcome_of(filming);
  CHECK(workplace.all(".png").size() == 5);
  CHECK(workplace.all(".mp4").empty());
  const auto videos = workplace.all(".webm");
  REQUIRE(videos.size() == 1);
  CHECK(outcome.find(videos[0].filename().string()) != std::string::npos);
  std::ifstream file(videos[0]);
  const std::string words{std::istreambuf_iterator<char>(file), {}};
  CHECK(words.find("-framerate 30") != std::string::npos);
  CHECK(words.find("/frame_%05d.png") != std::string::npos);
}

TEST_CASE("a film of nothing leaves nothing, and one that is left has all its pictures") {
  const Workplace workplace;
  {
    VideoRecorder filming("body", {8, 6});
    CHECK(outcome_of(filming).find("Nothing") != std::string::npos);
  }
  CHECK(fs::is_empty(workplace.path));
  {
    VideoRecorder filming("body", {8, 6});
    for (int k = 0; k < 6; ++k) film(filming, k / VideoRecorder::rate + 1e-4, k);
  }
  CHECK(workplace.all(".png").size() == 6);
}

}  // namespace heml::filming_test
