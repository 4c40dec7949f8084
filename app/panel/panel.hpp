#pragma once
// The panel beside the body: shows a Frame's numbers and hands out what the user wants of the world. It knows no
// session and no window, so that the window, headless capture and tests draw the same one. Wide pictures have two
// columns, others one:
//
//    ┌──────────┐                       ┌──────────┐        ┌──────────┐
//    │ title    │        banner         │ force    │        │ title    │   banner
//    │ ▶ ▸| ↺   │                       │ energies │        │ ▶ ▸| ↺   │
//    │ material │         body          │ volume   │        │ material │    body
//    │ motion   │                       │ engine   │        │ ...      │
//    │ tool …   │        legend         │          │        │ force …  │   legend
//    └──────────┘                       └──────────┘        └──────────┘
//
// A frame: take(frame), draw the body with drawing(), then between Interface::begin() and end(): draw(frame).
#include <app/panel/actions.hpp>
#include <app/panel/area.hpp>
#include <app/panel/compare_section.hpp>
#include <app/panel/history.hpp>
#include <app/panel/material_section.hpp>
#include <app/panel/motion_section.hpp>
#include <app/panel/notices.hpp>
#include <app/panel/open_dialog.hpp>
#include <app/panel/stretch_monitor.hpp>
#include <app/panel/timeline.hpp>
#include <app/panel/tool_section.hpp>
#include <app/panel/view_section.hpp>
#include <heml/scenario/scene.hpp>

namespace heml::panel {

class Panel {
 public:
  /// What it shows at first is what the scene says.
  Panel(const Scene& scene, const SurfaceMesh& surface_mesh);

  /// Takes a frame's numbers, before the body is drawn. seconds: wall time since the last call.
  void update(const Frame& frame, float seconds);

  /// Draws the panel into the current ImGui frame and returns what the user did with it and with the keys since.
  PanelActions draw(const Frame& frame);

  void perform(Action action);                                     ///< a key; takes effect in the next draw()
  void sync(const Command& command);                               ///< shows what was changed elsewhere
  void say(std::string text) { notices_.say(std::move(text)); }    ///< in passing
  void fail(std::string text) { notices_.fail(std::move(text)); }  ///< a file that could not be opened

  void set_choices(OpenChoices choices) { dialog_.set_choices(std::move(choices)); }  ///< what can be opened
  void set_timeline(const Timeline& timeline) { timeline_ = timeline; }  ///< shown from now on; none: there is no bar
  ViewSection& view() { return view_; }
  bool asks() const { return dialog_.is_open(); }  ///< a dialog has keys and mouse to itself

  const render::DrawOptions& drawing() const { return view_.drawing(); }
  bool wants_stretches() const { return watch_.active(); }  ///< whether frames should carry Frame::stretches
  bool wants_errors() const { return errors_open_; }        ///< whether frames should carry errors
  const ToolSettings& tool() const { return tool_.tool(); }
  Insets insets(ImVec2 picture) const;  ///< that draw() takes in a picture of a size, pixels
  bool covers(float x,
              float y) const;   ///< whether a point is on the panel, as last drawn: the mouse is then not on the body
  bool shows_recovery() const;  ///< one goes on, or has ended a moment ago
  bool animating() const { return notices_.animating(); }  ///< whether it changes by itself
  /// Tissue, motion and colours as they are shown: a scene that starts with them.
  void write_into(Scene& scene) const;
  const std::string& hovered() const { return rows_.hovered(); }  ///< label of the row under the mouse; empty: none

 private:
  void carry_out(Action action, const Frame& frame, PanelActions& out);
  void draw_controls(const Frame& frame, bool with_readings, PanelActions& out);
  void draw_header(const Frame& frame);
  void draw_pace(const Frame& frame);
  void draw_readings(const Frame& frame);
  void draw_accuracy(const Frame& frame);
  void tell_refusal(const Frame& frame);
  void update_surface(const Frame& frame);
  void watch_stretches();
  std::optional<Banner> banner_for(const Frame& frame) const;
  void remember_place();

  std::string title_, description_;  ///< of the scene
  ToolSection tool_;
  long refusals_ = 0;  ///< of the session, that were told
  MaterialSection material_;
  StretchMonitor watch_;
  long surface_version_;      ///< that the watch is of
  int watched_changes_ = -1;  ///< MaterialSection::changes() that the watch knows of
  MotionSection motion_;
  ViewSection view_;
  CompareSection comparisons_;
  Notices notices_;
  OpenDialog dialog_;
  std::optional<Timeline> timeline_;
  Rows rows_;
  History history_;
  render::ColourRange colour_range_;
  render::Range range_;
  std::vector<Action> pressed_;   ///< since the last draw()
  std::vector<Area> places_;      ///< of windows in the last draw()
  float controls_height_ = 1e9f;  ///< pixels that all open sections take, as last drawn
  float late_for_ = 0;            ///< s of wall time that the engine has not kept up
  long recovery_seen_ = -1;       ///< Recovery::tick of the last one
  float since_recovery_ = 1e9f;   ///< s of wall time since it went on
  bool hidden_ = false, helping_ = false;
  bool errors_open_ = false;  ///< somebody reads them
};

}  // namespace heml::panel
