#pragma once
// Selects the frame of a session to show: live or past. The engine is paused while a past one is shown.
#include <app/panel/timeline.hpp>
#include <app/window/frame_history.hpp>
#include <heml/session/session.hpp>
#include <optional>

namespace heml::window {

class TimelinePlayback {
 public:
  /// The frame to draw. live: the newest of the session. seconds: of wall time since the last call.
  const Frame& select_frame(const Frame& live, float seconds, Session& session);

  bool active() const { return shown_tick_.has_value(); }
  bool playing() const { return active() && playing_; }

  /// Shows a past tick and pauses the session; for a tick ahead, fast-forwards the session.
  void seek(long tick, Session& session);
  void step(int frames, Session& session);  ///< by so many frames; negative: earlier
  void play(bool playing) { playing_ = playing; }
  /// Back to the live frame; the session runs on if it ran before.
  void end(Session& session);
  /// Another session resumes at a tick: drops later frames, shares surface meshes with `frame`, its first one.
  void resumed_at(long tick, const Frame& frame);

  /// Whether the session ran before a past frame was shown.
  bool was_running() const { return was_running_; }
  panel::Timeline timeline(const Scene& scene, const Frame& live) const;

 private:
  FrameHistory history_;
  std::optional<double> shown_tick_;  ///< the past tick shown; none: live
  bool playing_ = false;              ///< past frames are played
  bool was_running_ = false;
  Frame shown_;  ///< the past frame shown
};

}  // namespace heml::window
