#pragma once
// Output of the panel: commands for the world and requests to the panel's owner (window/viewer.hpp), which carries
// them out.
#include <filesystem>
#include <heml/scenario/bare_mesh_options.hpp>
#include <heml/scenario/standard_view.hpp>
#include <heml/world/command.hpp>
#include <heml/world/world.hpp>
#include <optional>
#include <string>
#include <vector>

namespace heml::panel {

/// What a key or a button of the panel does.
enum class Action {
  toggle_play,
  step,
  reset,
  reset_all,
  fit,
  wireframe,
  section,
  show_tissue,
  show_displacement,
  show_stretch,
  show_von_mises,
  show_volume_ratio,
  show_error,
  screenshot,
  save,
  hide,
  help,
  release,
  remove,
  leave_clamp,
  select_grasper,
  select_scalpel,
  select_scissors,
  select_cautery,
  select_pin,
  select_probe,
  select_suture,
  select_remover,
  select_measure,
  select_nodes,
  pin_selected,
  unpin_selected,
  toggle_table,
  undo,
  redo,
  open,
  select_previous,
  select_next,
  open_selected,
  seek_previous,
  seek_next,
  seek_start,
  seek_live,
  resume,
  record_video,
  view_1,
  view_2,
  view_3,
  view_4,
  save_view_1,
  save_view_2,
  save_view_3,
  save_view_4,
  look_front,  // the order of StandardView
  look_back,
  look_left,
  look_right,
  look_top,
  look_bottom,
  orthographic,
  quit
};

/// What the left mouse button does to the body.
enum class Tool { grasper, scalpel, scissors, cautery, pin, probe, suture, remover, measure, select };

/// What the mouse is doing in the image while a button is down.
enum class Interaction { none, grasping, cutting, snipping, burning, probing, selecting, aiming, orbiting, panning };

/// The selected tool and the settings of all tools.
struct ToolSettings {
  Tool tool = Tool::grasper;
  double radius = 0;                                    ///< m, of a grasp, a pin or a removal
  double depth = 0;                                     ///< m, of the blade below the surface
  double jaw_length = 0, jaw_opening = 0;               ///< m, of scissors: length and depth of a snip
  double jaw_direction = 90;                            ///< degrees, of a click with them, from the picture's right
  double burn_radius = 0, burn_depth = 0;               ///< m, of the electrode: reach of its heat, below the surface
  double shrink = usual_shrink;                         ///< Heat::shrink
  double probe_radius = 0, indentation = 0, shaft = 0;  ///< m, of the probe: tip, indentation, shaft length
  double friction = 0.3;                                ///< Coulomb coefficient of the probe and of tables
};

/// A device beside the mouse that moves a hand (window/device_hand.hpp).
struct DeviceInfo {
  std::string kind, name;    ///< "Gamepad", and as its maker calls it
  std::vector<std::string> controls;  ///< hints of what they do, most useful first
  bool may_move_view = false;  ///< in place of the hand, where the person says so
  bool is_new = false;         ///< it has not grasped anything yet
};

/// What the panel asks its owner for; previous_frame, next_frame, first_frame, live and resume are about the timeline.
enum class Request {
  play,
  pause,
  step,
  fit,
  screenshot,
  save,
  release,
  remove,
  leave_clamp,
  list,
  previous_frame,
  next_frame,
  first_frame,
  live,
  resume,
  record_video,
  save_measured,
  quit
};

struct PanelActions {
  std::vector<Command> commands;  ///< for the world, in order
  std::vector<Request> requests;
  std::optional<Field> show;                            ///< the field that frames carry from now on
  std::optional<std::filesystem::path> open;            ///< a file to open
  std::optional<BareMeshOptions> mesh_options;          ///< with which to open the bare mesh again
  std::optional<std::filesystem::path> open_folder;     ///< to show in the system's file manager
  std::optional<std::filesystem::path> list_folder;     ///< a folder to list; Request::list: the last one again
  std::optional<std::size_t> view, save_view;           ///< saved camera view to restore, to overwrite (index)
  std::optional<StandardView> look;                     ///< a standard view to turn to
  std::optional<bool> orthographic;                     ///< whether the camera is, from now on
  std::optional<std::vector<std::string>> comparisons;  ///< the comparison runs from now on (variant.hpp)
  std::optional<std::size_t> answer;                    ///< to the question of Panel::ask(): index of a button
  std::optional<long> seek_to;                          ///< a tick to show: past, or ahead in a recording
};

}  // namespace heml::panel
