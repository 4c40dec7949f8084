#include <algorithm>
#include <app/window/timeline_playback.hpp>

namespace heml::window {

const Frame& TimelinePlayback::select_frame(const Frame& live, float seconds, Session& session) {
  seen_.add(live);
  if (!at_) return live;
  if (playing_) *at_ += static_cast<double>(seconds) * live.pace.rate;
  if (*at_ >= static_cast<double>(live.tick)) {
    end(session);
    return live;
  }
  const Frame& frame = seen_.frames()[seen_.place_of(static_cast<long>(*at_))];
  if (frame.tick != shown_.tick || frame.surface_mesh != shown_.surface_mesh) shown_ = frame;
  shown_.paused = !playing_;
  shown_.pace.keeping_up = true;
  return shown_;
}

void TimelinePlayback::look(long tick, Session& session) {
  if (seen_.frames().empty()) return;
  const Frame& last = seen_.frames().back();
  if (tick > last.tick) {
    end(session);
    return session.fast_forward_to(tick);
  }
  if (!at_) {
    ran_ = !last.paused;
    session.pause();
  }
  playing_ = false;
  at_ = static_cast<double>(std::max(tick, seen_.frames().front().tick));
}

void TimelinePlayback::step(int frames, Session& session) {
  if (seen_.frames().empty() || (!at_ && frames > 0)) return;
  const long here = at_ ? static_cast<long>(*at_) : seen_.frames().back().tick;
  const long last = std::ssize(seen_.frames()) - 1;
  const long place = std::clamp(static_cast<long>(seen_.place_of(here)) + frames, 0l, last);
  look(seen_.frames()[static_cast<std::size_t>(place)].tick, session);
}

void TimelinePlayback::end(Session& session) {
  if (!at_) return;
  at_.reset();
  playing_ = false;
  if (ran_) session.play();
}

void TimelinePlayback::resumed_at(long tick, const Frame& frame) {
  seen_.cut_after(tick);
  seen_.share(frame);
  at_.reset();
  playing_ = false;
}

panel::Timeline TimelinePlayback::timeline(const Scene& scene, const Frame& live) const {
  panel::Timeline timeline;
  timeline.rate = live.pace.rate;
  timeline.live = live.tick;
  timeline.first = seen_.frames().empty() ? live.tick : seen_.frames().front().tick;
  timeline.end = std::max({live.tick, live.fast_forward_target, scene.recorded_ticks.value_or(0)});
  if (at_) timeline.shown = shown_.tick;
  timeline.frames = seen_.frames().size();
  timeline.bytes = seen_.bytes();
  timeline.room = seen_.room();
  timeline.fast_forward_target = live.fast_forward_target;
  return timeline;
}

}  // namespace heml::window
