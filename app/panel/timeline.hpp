#pragma once
// The timeline bar below the body: frames seen so far, a recording ahead, and the shown time.
//
//    ┌────────────────────────────────────────────────────┐
//    │ 2.40 s  ████████████▌███████░░░░░░░  Resume   Live │
//    └───────────────┬─────┬──────┬──────┬────────────────┘
//                  seen  shown  engine  end of the recording
//
// Where that leaves the track too short, it has a row of its own above time and buttons.
#include <app/panel/actions.hpp>
#include <app/panel/area.hpp>
#include <app/panel/rows.hpp>
#include <cstddef>
#include <functional>
#include <optional>

namespace heml::panel {

/// A frame that can be shown.
struct TimelineMoment {
  long tick = 0;
  double elapsed = 0;  ///< s, simulated, since the start
};

/// In ticks since the start; resets do not set them back.
struct Timeline {
  double rate = 1000;             ///< ticks per simulated second, now
  std::optional<double> elapsed;  ///< s, simulated, at the shown tick; none: by the rate
  long first = 0, live = 0;       ///< first frame kept; the engine's tick
  long end = 0;                   ///< of the recording, or the engine's tick if that is later
  std::optional<long> shown;      ///< the past tick shown; none: live
  /// The frame that is shown for a past tick; empty function: any tick has one.
  std::function<TimelineMoment(long tick)> moment_at = {};
  std::size_t frames = 0;              ///< number of frames kept
  std::size_t bytes = 0, room = 0;     ///< memory of the frames kept; its limit
  long fast_forward_target = 0;        ///< a tick that the engine fast-forwards to; 0: none
  std::optional<int> resume_progress;  ///< %, of the replay that leads to a resumed time
  bool is_opening = false;             ///< another file is being opened

  /// Whether there is something that Esc ends: a past tick shown, a replay, fast-forwarding.
  bool leads_to_live() const { return shown || resume_progress || fast_forward_target > 0; }
};

/// Simulated seconds since the start at a tick; exact for the shown one where the rate has changed.
double seconds_at(const Timeline& timeline, long tick);

/// Draws the bar at the bottom of the free area. Adds the actions of its buttons to `pressed`. `place`: set to its
/// rectangle.
void draw_timeline(Rows& rows, const Timeline& timeline, const Area& free, std::vector<Action>& pressed,
                   PanelActions& out, Area& place);

}  // namespace heml::panel
