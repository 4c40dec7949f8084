#pragma once
// What was seen of a session, to be looked at again: frames, oldest first, in so much memory at most. When that is full
// every second one goes, so the whole session stays, ever coarser:
//
//    0 1 2 3 4 5 6 7        full
//    0   2   4   6   8      from now on every second one is taken
#include <cstddef>
#include <heml/session/frame.hpp>
#include <vector>

namespace heml::window {

class FrameHistory {
 public:
  /// room: bytes; skins, which frames share, are not counted.
  explicit FrameHistory(std::size_t room = 256'000'000) : room_(room) {}

  /// Takes a frame that is later than the last by the spacing of the moment, or of the same tick, which it replaces.
  void add(const Frame& frame);
  /// Forgets what is later than a tick.
  void cut_after(long tick);
  /// Frames whose skins are of the version of this one's, or of what is beside it, have these from now on: who draws
  /// keeps what is made of a skin.
  void share(const Frame& frame);

  const std::vector<Frame>& frames() const { return frames_; }  ///< ascending in tick
  /// The frame of a tick: the last that is not later, else the first. There is one.
  std::size_t place_of(long tick) const;
  std::size_t bytes() const { return bytes_; }
  std::size_t room() const { return room_; }

 private:
  void thin();

  std::size_t room_, bytes_ = 0;
  long spacing_ = 1;  ///< ticks
  std::vector<Frame> frames_;
};

}  // namespace heml::window
