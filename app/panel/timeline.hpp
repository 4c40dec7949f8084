#pragma once
// The bar of a session's time, below the body: what was seen, what is recorded ahead, and which moment is looked at.
//
//    ┌────────────────────────────────────────────────────┐
//    │ 2.40 s  ████████████▌███████░░░░░░░  Resume   Now  │
//    └───────────────┬─────┴──────┴──────┬────────────────┘
//               seen before     the engine is here, the recording goes on to there
#include <app/panel/actions.hpp>
#include <app/panel/area.hpp>
#include <app/panel/rows.hpp>
#include <cstddef>
#include <optional>

namespace heml::panel {

/// In ticks since the start, which resets do not set back.
struct Timeline {
  double rate = 1000;         ///< ticks a second
  long first = 0, live = 0;   ///< what was seen; where the engine is
  long end = 0;               ///< of a recording, where that is later
  std::optional<long> shown;  ///< the moment that is looked at; none: live
  std::size_t frames = 0;     ///< that are kept
  std::size_t bytes = 0, room = 0;
  long fast_forward_target = 0;  ///< a tick ahead that the engine goes to; 0: none
  std::optional<int> returning;  ///< %, of the way back to a moment that is resumed
};

/// Height that it takes at the bottom of the picture, pixels.
float timeline_height();

/// At the bottom of the free part of the picture. Adds what its buttons do to `pressed`. `place`: where it was drawn.
void draw_timeline(Rows& rows, const Timeline& timeline, const Area& free, std::vector<Action>& pressed,
                   PanelActions& out, Area& place);

}  // namespace heml::panel
