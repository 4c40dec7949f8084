#pragma once
// Pictures of the window as numbered PNG files, even in simulated time, and a video of them where ffmpeg is installed.
//
//    drawing thread: due()? take() ──► eight pictures at most ──► its own thread, which gives way: PNG … PNG, ffmpeg
//
// A picture that nobody has time for is left out: the file that is missing then is another name of the one before.
#include <app/render/image.hpp>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace heml::window {

class VideoRecorder {
 public:
  static constexpr double rate = 30;  ///< pictures a simulated second

  /// Makes heml-<name>-<local time> in the working directory. size: of all pictures. Throws InputError.
  VideoRecorder(const std::string& name, render::Size size);
  /// Writes what was taken. A video that is being made goes on without the program.
  ~VideoRecorder();

  /// Whether the picture of a time (s, simulated since the start) is wanted.
  bool due(double time) const;
  void add_frame(render::Image picture, double time);
  void finish();  ///< nothing is taken any more; the video is made

  bool is_finishing() const { return finishing_; }
  long pictures() const { return next_; }
  render::Size size() const { return size_; }
  bool is_done() const;  ///< there is an outcome to take
  /// Once, when all is done or nothing more can be: what came of it, for people.
  std::optional<std::string> take_outcome();

 private:
  struct Picture {
    long number;
    long repeats;  ///< of the picture before, that come first
    render::Image image;
  };

  void run();
  void write(const Picture& picture);
  std::filesystem::path file(long number) const;
  std::string make_video();

  std::filesystem::path folder_;
  render::Size size_;
  double began_ = 0, last_ = 0;  ///< s
  long next_ = 0;
  bool finishing_ = false;

  mutable std::mutex mutex_;  ///< of what follows
  std::condition_variable wake_;
  std::deque<Picture> queue_;
  bool ends_ = false;
  std::optional<std::string> outcome_;
  std::atomic<bool> leaving_{false};
  std::thread thread_;
};

}  // namespace heml::window
