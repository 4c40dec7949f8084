#pragma once
// Past frames of a session for the timeline, oldest first, within a memory limit. When it is exceeded every second
// frame is dropped, so that the whole session stays covered, at a coarser spacing:
//
//    0 1 2 3 4 5 6 7        full
//    0   2   4   6   8      from now on every second frame is added
#include <cstddef>
#include <heml/session/frame.hpp>
#include <vector>

namespace heml::window {

class FrameHistory {
 public:
  /// room: bytes, at most; of what frames share, cut skins are counted, once each, and surface meshes are not.
  explicit FrameHistory(std::size_t room = 256'000'000) : room_(room) {}

  /// Appends a frame that is later than the last by the spacing; replaces the last one if it has the same tick; ignores
  /// others.
  void add(const Frame& frame);
  /// Drops frames later than a tick.
  void cut_after(long tick);
  /// Replaces surface meshes by those of this frame where the version is the same (for comparison runs: and the
  /// variant), because renderers cache buffers per surface mesh.
  void share(const Frame& frame);

  const std::vector<Frame>& frames() const { return frames_; }  ///< ascending in tick
  /// Index of the last frame not later than a tick, else 0. Needs at least one frame.
  std::size_t index_at(long tick) const;
  std::size_t bytes() const { return bytes_; }
  std::size_t room() const { return room_; }

 private:
  void thin();
  /// Bytes that frame k adds to those before it.
  std::size_t bytes_at(std::size_t k) const;

  std::size_t room_, bytes_ = 0;
  long spacing_ = 1;  ///< ticks
  std::vector<Frame> frames_;
};

}  // namespace heml::window
