#include <doctest/doctest.h>

#include <algorithm>
#include <app/render/png.hpp>
#include <app/window/video_recorder.hpp>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <thread>

namespace heml::video_recorder_test {

using window::VideoRecorder;
namespace fs = std::filesystem;

namespace {

/// A temporary working directory, with a PATH of its own.
struct Workplace {
  fs::path before = fs::current_path(), path;
  std::string search = std::getenv("PATH");
  Workplace() {
    std::string name = (fs::temp_directory_path() / "heml-recorder-XXXXXX").string();
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
void record(VideoRecorder& recorder, double time, int level) {
  for (int wait = 0; wait < 400 && recorder.frame_count() > 0 && !recorder.due(time); ++wait)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  recorder.add_frame(grey(level), time);
}

std::string outcome_of(VideoRecorder& recorder) {
  recorder.finish();
  for (int wait = 0; wait < 3000; ++wait) {
    if (const auto outcome = recorder.take_outcome()) return *outcome;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return "no outcome";
}

}  // namespace

TEST_CASE("frames are evenly spaced in simulated time and a missed one repeats the frame before") {
  const Workplace workplace;
  VideoRecorder recorder("a body", {8, 6});
  record(recorder, 5.0, 10);
  CHECK_FALSE(recorder.due(5.02));
  CHECK(recorder.due(5.04));
  record(recorder, 5.04, 20);   // number 1
  record(recorder, 5.14, 30);   // number 4: 2 and 3 repeat 1
  record(recorder, 60.0, 40);   // a gap is cut out: number 5
  record(recorder, 1.0, 50);    // so is a step back: number 6
  record(recorder, 1.034, 60);  // number 7
  const std::string outcome = outcome_of(recorder);
  CHECK(outcome.find("8 frames") != std::string::npos);
  CHECK(outcome.find("ffmpeg is not installed") != std::string::npos);
  std::vector<int> levels;
  for (const fs::path& file : workplace.all(".png")) levels.push_back(render::read_png(file).pixels[0]);
  CHECK(levels == std::vector{10, 20, 20, 20, 30, 40, 50, 60});
}

TEST_CASE("the frames are encoded with the next codec if the first fails") {
  const Workplace workplace;
  workplace.install_ffmpeg();
  VideoRecorder recorder("body", {8, 6});
  for (int k = 0; k < 5; ++k) record(recorder, k / VideoRecorder::rate + 1e-4, 10 * k);
  const std::string outcome = outcome_of(recorder);
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

TEST_CASE("a film whose folder is gone says which file could not be written") {
  const Workplace workplace;
  VideoRecorder recorder("body", {8, 6});
  CHECK(recorder.folder().parent_path() == workplace.path);
  fs::remove(recorder.folder());
  recorder.add_frame(grey(1), 0);
  const std::string outcome = outcome_of(recorder);
  CHECK(outcome.find("The film ended early") != std::string::npos);
  CHECK(outcome.find("frame_00000.png") != std::string::npos);
  CHECK(outcome.find("filesystem error") == std::string::npos);
}

TEST_CASE("a recording without frames leaves no file and an abandoned one has all frames") {
  const Workplace workplace;
  {
    VideoRecorder recorder("body", {8, 6});
    CHECK(outcome_of(recorder).find("Nothing") != std::string::npos);
  }
  CHECK(fs::is_empty(workplace.path));
  {
    VideoRecorder recorder("body", {8, 6});
    for (int k = 0; k < 6; ++k) record(recorder, k / VideoRecorder::rate + 1e-4, k);
  }
  CHECK(workplace.all(".png").size() == 6);
}

}  // namespace heml::video_recorder_test
