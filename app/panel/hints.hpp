#pragma once
// The hint line above the timeline: what mouse and keys do now.
//
//    drag the tissue to pull · right-drag to turn · C to cut · H for help
#include <app/panel/actions.hpp>
#include <app/panel/area.hpp>
#include <string>
#include <vector>

namespace heml::panel {

/// What the hints depend on.
struct Situation {
  Tool tool = Tool::grasper;
  Interaction interaction = Interaction::none;
  bool suture_begun = false;  ///< its first end is set
  bool paused = false, halted = false;
  bool past = false;       ///< a past frame is shown
  bool hides = false;      ///< regions are hidden
  std::vector<std::string> device = {};  ///< what the controls of one do that has not been used yet
};

/// The hints of a situation, most useful first: every hint there is.
std::vector<std::string> hints_for(const Situation& situation);

/// Height of the line with its margin, pixels.
float hint_height();

/// Draws as many hints as fit at the bottom of the free area.
void draw_hints(const Situation& situation, const Area& free);

}  // namespace heml::panel
