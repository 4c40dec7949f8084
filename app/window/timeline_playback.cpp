#include <algorithm>
#include <app/window/timeline_playback.hpp>

namespace heml::window {

const Frame& TimelinePlayback::select_frame(const Frame& live, float seconds, Session& session) {
  history_.add(live);
  if (!shown_tick_) return live;
  if (playing_) *shown_tick_ += static_cast<double>(seconds) * live.pace.rate;
  if (*shown_tick_ >= static_cast<double>(live.tick)) {
    end(session);
    return live;
  }
  const Frame& frame = history_.frames()[history_.index_at(static_cast<long>(*shown_tick_))];
  if (frame.tick != shown_.tick || frame.surface_mesh != shown_.surface_mesh) shown_ = frame;
  shown_.paused = !playing_;
  shown_.pace.keeping_up = true;
  return shown_;
}

void TimelinePlayback::seek(long tick, Session& session) {
  if (history_.frames().empty()) return;
  const Frame& last = history_.frames().back();
  if (tick > last.tick) {
    end(session);
    return session.fast_forward_to(tick);
  }
  if (!shown_tick_) {
    was_running_ = !last.paused;
    session.pause();
  }
  playing_ = false;
  shown_tick_ = static_cast<double>(std::max(tick, history_.frames().front().tick));
}

void TimelinePlayback::step(int frames, Session& session) {
  if (history_.frames().empty() || (!shown_tick_ && frames > 0)) return;
  const long here = shown_tick_ ? static_cast<long>(*shown_tick_) : history_.frames().back().tick;
  const long last = std::ssize(history_.frames()) - 1;
  const long place = std::clamp(static_cast<long>(history_.index_at(here)) + frames, 0l, last);
  seek(history_.frames()[static_cast<std::size_t>(place)].tick, session);
}

void TimelinePlayback::end(Session& session) {
  if (!shown_tick_) return;
  shown_tick_.reset();
  playing_ = false;
  if (was_running_) session.play();
}

void TimelinePlayback::resumed_at(long tick, const Frame& frame) {
  history_.cut_after(tick);
  history_.share(frame);
  shown_tick_.reset();
  playing_ = false;
}

panel::Timeline TimelinePlayback::timeline(const Scene& scene, const Frame& live) const {
  panel::Timeline timeline;
  timeline.rate = live.pace.rate;
  timeline.live = live.tick;
  timeline.first = history_.frames().empty() ? live.tick : history_.frames().front().tick;
  timeline.end = std::max({live.tick, live.fast_forward_target, scene.recorded_ticks.value_or(0)});
  if (shown_tick_) timeline.shown = shown_.tick;
  timeline.elapsed = shown_tick_ ? shown_.elapsed : live.elapsed;
  timeline.moment_at = [this](long tick) -> panel::TimelineMoment {
    if (history_.frames().empty()) return {};
    const Frame& frame = history_.frames()[history_.index_at(tick)];
    return {frame.tick, frame.elapsed};
  };
  timeline.frames = history_.frames().size();
  timeline.bytes = history_.bytes();
  timeline.room = history_.room();
  timeline.fast_forward_target = live.fast_forward_target;
  return timeline;
}

}  // namespace heml::window
