#pragma once
// Records frames of the window as numbered PNG files, evenly spaced in simulated time, and encodes a video of them if
// ffmpeg is installed.
//
//    drawing thread: due()? add_frame() ──► queue of at most 8 ──► worker thread (nice 5): PNG … PNG, ffmpeg
//
// The file of a missed frame is a hard link to, or a copy of, the one before it.
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
  static constexpr double rate = 30;  ///< frames per simulated second

  /// Creates the folder heml-<name>-<local time> in the working directory. size: of all frames, pixels. Throws
  /// InputError.
  VideoRecorder(const std::string& name, render::Size size);
  /// Writes the queued frames. A running ffmpeg keeps running after the program ends.
  ~VideoRecorder();

  /// Whether a frame at a time (s, simulated since the start) is due and there is room for it.
  bool due(double time) const;
  void add_frame(render::Image image, double time);
  void finish();  ///< no more frames; encodes the video

  bool is_finishing() const { return finishing_; }
  long frame_count() const { return next_; }
  render::Size size() const { return size_; }
  const std::filesystem::path& folder() const { return folder_; }  ///< of the frames; the video is beside it
  bool is_done() const;  ///< take_outcome() has a message
  /// A message about the finished or failed recording, once.
  std::optional<std::string> take_outcome();

 private:
  struct QueuedFrame {
    long number;
    long repeats;  ///< of the frame before, to write first
    render::Image image;
  };

  void run();
  void write(const QueuedFrame& frame);
  std::filesystem::path file(long number) const;
  std::string make_video();

  std::filesystem::path folder_;
  render::Size size_;
  double began_ = 0, last_ = 0;  ///< s
  long next_ = 0;
  bool finishing_ = false;

  mutable std::mutex mutex_;  ///< of queue_, ends_ and outcome_
  std::condition_variable wake_;
  std::deque<QueuedFrame> queue_;
  bool ends_ = false;
  std::optional<std::string> outcome_;
  std::atomic<bool> leaving_{false};
  std::thread thread_;
};

}  // namespace heml::window
