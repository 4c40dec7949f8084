#include <fmt/format.h>

#include <app/render/png.hpp>
#include <app/window/glfw_window.hpp>
#include <app/window/run_program.hpp>
#include <app/window/screenshot.hpp>
#include <app/window/video_recorder.hpp>
#include <cmath>
#include <heml/base/error.hpp>
#include <vector>

namespace heml::window {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t max_waiting = 8;
constexpr double max_gap = 2;  // s; longer ones are cut out

struct Codec {
  const char* ending;
  std::vector<std::string> arguments;
};

/// In the order of preference; ffmpeg fails for codecs that it was built without.
const Codec codecs[] = {{".mp4", {"-c:v", "libx264", "-crf", "18", "-movflags", "+faststart"}},
                        {".webm", {"-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0"}},
                        {".mp4", {"-c:v", "mpeg4", "-q:v", "3"}}};

}  // namespace

VideoRecorder::VideoRecorder(const std::string& name, render::Size size) : folder_(unused_path(name, "")), size_(size) {
  std::error_code failed;
  fs::create_directory(folder_, failed);
  if (failed)
    throw InputError(folder_.string(), "", "cannot be made: " + failed.message(), "start heml in a writable folder");
  thread_ = std::thread([this] { run(); });
}

VideoRecorder::~VideoRecorder() {
  leaving_ = true;
  if (!finishing_) finish();
  thread_.join();
}

bool VideoRecorder::due(double time) const {
  if (finishing_ || (next_ > 0 && time >= last_ && (time - began_) * rate < static_cast<double>(next_))) return false;
  std::lock_guard lock(mutex_);
  return queue_.size() < max_waiting && !outcome_;
}

void VideoRecorder::add_frame(render::Image image, double time) {
  // After a long gap, or a step back in time, the frame follows the last one directly.
  if (next_ == 0 || time < last_ || time - last_ > max_gap) began_ = time - static_cast<double>(next_) / rate;
  last_ = time;
  const long number = std::max(next_, std::lround(std::floor((time - began_) * rate)));
  {
    std::lock_guard lock(mutex_);
    queue_.push_back({number, next_ == 0 ? 0 : number - next_, std::move(image)});
  }
  next_ = number + 1;
  wake_.notify_one();
}

void VideoRecorder::finish() {
  finishing_ = true;
  {
    std::lock_guard lock(mutex_);
    ends_ = true;
  }
  wake_.notify_one();
}

bool VideoRecorder::is_done() const {
  std::lock_guard lock(mutex_);
  return outcome_.has_value();
}

std::optional<std::string> VideoRecorder::take_outcome() {
  std::lock_guard lock(mutex_);
  return std::exchange(outcome_, std::nullopt);
}

fs::path VideoRecorder::file(long number) const { return folder_ / fmt::format("frame_{:05}.png", number); }

void VideoRecorder::run() {
  lower_priority();
  std::string outcome;
  try {
    for (std::unique_lock lock(mutex_);;) {
      wake_.wait(lock, [this] { return !queue_.empty() || ends_; });
      if (queue_.empty()) break;
      lock.unlock();
      write(queue_.front());  // only this thread removes it
      lock.lock();
      queue_.pop_front();
    }
    outcome = make_video();
  } catch (const std::exception& error) {
    outcome = fmt::format("The film ended early: {}", error.what());
  }
  std::lock_guard lock(mutex_);
  outcome_ = outcome;
  GlfwWindow::wake();
}

void VideoRecorder::write(const QueuedFrame& frame) {
  for (long k = frame.number - frame.repeats; k < frame.number; ++k) {
    std::error_code failed;
    fs::create_hard_link(file(frame.number - frame.repeats - 1), file(k), failed);
    if (failed) fs::copy_file(file(frame.number - frame.repeats - 1), file(k), failed);
    if (failed)
      throw InputError(file(k).string(), "", "cannot be written: " + failed.message(),
                       "check the folder, its permissions and the space left");
  }
  render::write_png(file(frame.number), frame.image);
}

std::string VideoRecorder::make_video() {
  if (next_ == 0) {
    std::error_code failed;
    fs::remove(folder_, failed);
    return "Nothing was recorded: simulated time did not advance.";
  }
  const std::string frames = fmt::format("{} frames in {}", next_, folder_.string());
  const fs::path ffmpeg = find_program("ffmpeg");
  if (ffmpeg.empty()) return frames + ". No video: ffmpeg is not installed.";
  for (const Codec& codec : codecs) {
    const std::string video = folder_.string() + codec.ending;
    std::vector<std::string> words{ffmpeg.string(), "-nostdin", "-y", "-loglevel", "error", "-framerate",
                                   fmt::format("{:g}", rate), "-i", (folder_ / "frame_%05d.png").string(),
                                   // yuv420p halves the resolution of colours: width and height must be even.
                                   "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p"};
    words.insert(words.end(), codec.arguments.begin(), codec.arguments.end());
    words.push_back(video);
    const auto code = run_program(words, leaving_);
    if (!code) return frames;  // the program ends; ffmpeg keeps running
    if (*code == 0) return frames + ", and " + video;
    std::error_code failed;
    fs::remove(video, failed);
  }
  return frames + ". No video: ffmpeg failed.";
}

}  // namespace heml::window
