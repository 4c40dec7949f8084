#pragma once
// Which moment of a session is looked at: now, or one that was seen before. The engine rests meanwhile.
#include <app/panel/timeline.hpp>
#include <app/window/frame_history.hpp>
#include <heml/session/session.hpp>
#include <optional>

namespace heml::window {

class TimelinePlayback {
 public:
  /// The frame to draw, seconds (of wall time) after the last. live: the newest of the session.
  const Frame& select_frame(const Frame& live, float seconds, Session& session);

  bool active() const { return at_.has_value(); }
  bool playing() const { return active() && playing_; }

  /// Looks at a tick that was seen; of one that lies ahead of the session it is sent there.
  void look(long tick, Session& session);
  void step(int frames, Session& session);  ///< to another frame: later, or earlier where it is negative
  void play(bool playing) { playing_ = playing; }
  /// Back to the present, which goes on if it did before.
  void end(Session& session);
  /// What was seen up to a tick stays of a session that another one goes on from, of which this is a frame.
  void resumed_at(long tick, const Frame& frame);

  /// Whether the session ran when one began to look back.
  bool ran() const { return ran_; }
  panel::Timeline timeline(const Scene& scene, const Frame& live) const;

 private:
  FrameHistory seen_;
  std::optional<double> at_;  ///< the tick that is looked at
  bool playing_ = false;      ///< what was seen goes by again
  bool ran_ = false;
  Frame shown_;  ///< of those, as it is looked at
};

}  // namespace heml::window
