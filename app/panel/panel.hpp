#pragma once
// The panel: shows the values of a Frame and returns what the user asked for. It depends on neither session nor window,
// so that the window, headless capture and tests draw the same panel. Wide images have two columns, others one:
//
//    ┌──────────┐┌─┐                    ┌──────────┐        ┌──────────┐┌─┐
//    │ title    ││p│      banner        │ force    │        │ title    ││p│ banner
//    │ ▶ ▸| ↺   ││a│                    │ energies │        │ ▶ ▸| ↺   ││a│
//    │ material ││l│       body         │ volume   │        │ material ││l│  body
//    │ motion   ││.│      legend        │ engine   │        │ ...      ││.│ legend
//    │ tool …   │└─┘ hints, timeline    │          │        │ force …  │└─┘ hints, timeline
//    └──────────┘                       └──────────┘        └──────────┘
//
// Per frame: update(frame), draw the body with drawing(), then draw(frame) between Interface::begin() and end().
#include <app/panel/actions.hpp>
#include <app/panel/area.hpp>
#include <app/panel/compare_section.hpp>
#include <app/panel/help.hpp>
#include <app/panel/hints.hpp>
#include <app/panel/history.hpp>
#include <app/panel/material_section.hpp>
#include <app/panel/measure.hpp>
#include <app/panel/mesh_section.hpp>
#include <app/panel/motion_section.hpp>
#include <app/panel/notices.hpp>
#include <app/panel/open_dialog.hpp>
#include <app/panel/palette.hpp>
#include <app/panel/preferences.hpp>
#include <app/panel/question.hpp>
#include <app/panel/region_section.hpp>
#include <app/panel/selection_section.hpp>
#include <app/panel/state_banner.hpp>
#include <app/panel/stretch_monitor.hpp>
#include <app/panel/timeline.hpp>
#include <app/panel/tool_section.hpp>
#include <app/panel/view_section.hpp>
#include <heml/scenario/scene.hpp>

namespace heml::panel {

class Panel {
 public:
  /// Starts with the settings of the scene. regions: of the mesh, ascending; empty: they are not told apart.
  /// region_names: of the mesh.
  Panel(const Scene& scene, const SurfaceMesh& surface_mesh, std::map<int, std::string> region_names = {},
        std::vector<int> regions = {});

  /// Updates plots, colour range and stretch monitor; call before the body is drawn. seconds: wall time since the last
  /// call.
  void update(const Frame& frame, float seconds);

  /// Draws the panel into the current ImGui frame and returns what the user asked for since the last call, by mouse and
  /// keys.
  PanelActions draw(const Frame& frame);

  void perform(Action action);                   ///< queued for the next draw() or perform_now()
  PanelActions perform_now(const Frame& frame);  ///< performs what is queued, and returns what draw() would
  void sync(const Command& command);             ///< updates the shown settings after a command from elsewhere
  /// For some seconds. folder: that a button offers to open; empty: none.
  void notify(std::string text, std::filesystem::path folder = {}) {
    notices_.notify(std::move(text), std::move(folder));
  }
  /// A failure, shown until closed.
  void show_error(std::string title, std::string text) { notices_.show_error(std::move(title), std::move(text)); }

  /// What was found and chosen when the scene was opened; a section tells it until it is dismissed.
  void set_findings(std::vector<std::string> findings);
  MeshSection& mesh() { return mesh_; }
  const MeshSection& mesh() const { return mesh_; }
  void set_choices(OpenChoices choices) { dialog_.set_choices(std::move(choices)); }  ///< entries of the open dialog
  void set_timeline(const Timeline& timeline) { timeline_ = timeline; }               ///< shows its bar from now on
  /// Shows its axes in the corner of the image from now on.
  void set_camera(const render::Camera& camera);
  const std::vector<int>& hidden_regions() const { return regions_.hidden(); }  ///< ascending
  Measure& measure() { return measure_; }
  const Measure& measure() const { return measure_; }
  SelectionSection& selecting() { return selecting_; }
  const SelectionSection& selecting() const { return selecting_; }
  const MotionSection& motion() const { return motion_; }
  ViewSection& view() { return view_; }
  const ViewSection& view() const { return view_; }
  /// What the mouse does, and whether the first end of a suture is set: for the hints.
  void set_interaction(Interaction interaction, bool suture_begun);
  void set_devices(std::vector<DeviceInfo> devices) { tool_.set_devices(std::move(devices)); }
  bool device_moves_view() const { return tool_.device_moves_view(); }
  void set_filmed_frames(std::optional<long> count) { filmed_frames_ = count; }  ///< none: no film is made
  void set_preferences(const Preferences& preferences);
  Preferences preferences() const;
  /// Asks in the middle of the image; PanelActions::answer has the answer. The last one is that of Esc.
  void ask(std::string title, std::string text, std::vector<std::string> answers) {
    question_.ask(std::move(title), std::move(text), std::move(answers));
  }
  bool asks() const { return question_.is_open(); }
  /// Whether something in the middle of the image takes keys and mouse.
  bool is_modal() const { return dialog_.is_open() || question_.is_open() || help_.is_open(); }

  render::DrawOptions drawing() const { return view_.drawing(); }
  bool wants_stretches() const { return stretch_monitor_.active(); }  ///< whether frames should carry Frame::stretches
  bool wants_errors() const { return errors_open_; }                  ///< whether frames should carry errors
  const ToolSettings& tool() const { return tool_.tool(); }
  void set_tool(const ToolSettings& tool) { tool_.set_tool(tool); }
  Insets insets(ImVec2 picture) const;  ///< that draw() covers of an image of a size, pixels
  /// Whether a point (pixels) is on the panel as last drawn.
  bool covers(float x, float y) const;
  bool shows_recovery() const { return state_banner_.shows_recovery(); }  ///< StateBanner::shows_recovery()
  bool animating() const { return notices_.animating(); }                 ///< whether it changes without input
  /// Writes the shown materials, motion settings and view options into a scene.
  void write_into(Scene& scene) const;
  const std::string& hovered() const { return rows_.hovered(); }  ///< label of the row under the mouse; empty: none

 private:
  void carry_out(Action action, const Frame& frame, PanelActions& out);
  void perform_queued(const Frame& frame, PanelActions& out);
  float draw_edges(const Frame& frame, Area& free, PanelActions& out);
  Situation situation(const Frame& frame) const;
  void draw_controls(const Frame& frame, bool with_readings, PanelActions& out);
  void draw_readings_column(const Frame& frame);
  void report_refusal(const Frame& frame);
  void update_surface(const Frame& frame);
  void update_settings(const Frame& frame);
  void update_regions(const Frame& frame);
  void update_stretch_limits();
  std::optional<Area> beside_body(const Area& free, ImVec2 picture) const;
  void take_press(BannerPress press, const Frame& frame, PanelActions& out);
  void draw_findings(PanelActions& out);
  void record_window_rect();

  std::string title_, description_;  ///< of the scene
  Interaction interaction_ = Interaction::none;
  bool suture_begun_ = false;
  std::optional<long> filmed_frames_;
  long undo_steps_ = 0;     ///< UndoList::steps whose settings are shown
  long seen_regions_ = -1;  ///< Regions::version that is shown
  ToolSection tool_;
  long refusals_ = 0;  ///< Frame::refusals that were shown
  MeshSection mesh_;
  MaterialSection material_;
  StretchMonitor stretch_monitor_;
  long surface_version_;             ///< SurfaceMesh::version that stretch_monitor_ is of
  int limited_changes_ = -1;         ///< MaterialSection::changes() that stretch_monitor_ is of
  std::vector<int> surface_hidden_;  ///< SurfaceMesh::hidden that it is of
  RegionSection regions_;
  SelectionSection selecting_;
  MotionSection motion_;
  ViewSection view_;
  CompareSection comparisons_;
  Look look_;
  Notices notices_;
  OpenDialog dialog_;
  Question question_;
  std::optional<Timeline> timeline_;
  std::optional<render::Camera> camera_;
  Rows rows_;
  History history_;
  Measure measure_;
  render::ColourRange colour_range_;
  render::Range range_;
  std::vector<Action> pressed_;   ///< queued for the next draw()
  std::vector<Area> rects_;       ///< of ImGui windows in the last draw()
  float controls_height_ = 1e9f;  ///< pixels, of the header and all open sections, as last drawn
  std::vector<std::string> findings_;
  StateBanner state_banner_;
  Help help_;
  bool hidden_ = false;
  bool errors_open_ = false;  ///< the section "Accuracy" is open
};

}  // namespace heml::panel
