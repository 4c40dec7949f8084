#pragma once
// Output of the panel: commands for the world and requests to the panel's owner (window/viewer.hpp), which carries
// them out.
#include <filesystem>
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
  fit,
  wireframe,
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
  take_grasper,
  take_scalpel,
  take_pin,
  take_probe,
  take_suture,
  toggle_table,
  undo,
  open,
  choose_previous,
  choose_next,
  open_chosen,
  seek_earlier,
  seek_later,
  seek_start,
  seek_now,
  resume,
  film,
  view_1,
  view_2,
  view_3,
  view_4,
  keep_view_1,
  keep_view_2,
  keep_view_3,
  keep_view_4,
  quit
};

/// What the left mouse button does to the body.
enum class Tool { grasper, scalpel, pin, probe, suture };

/// The selected tool and the settings of all tools.
struct ToolSettings {
  Tool tool = Tool::grasper;
  double radius = 0;                             ///< m, of a grasp or a pin
  double depth = 0;                              ///< m, of the blade below the surface
  double probe_radius = 0, dent = 0, shaft = 0;  ///< m, of the probe: tip, indentation, shaft length
  double friction = 0.3;                         ///< Coulomb coefficient of the probe and of tables
};

/// What the panel asks its owner for; earlier, later, first, now and resume are about the timeline.
enum class Request {
  play,
  pause,
  step,
  fit,
  screenshot,
  save,
  release,
  remove,
  list,
  earlier,
  later,
  first,
  now,
  resume,
  film,
  quit
};

struct PanelActions {
  std::vector<Command> commands;  ///< for the world, in order
  std::vector<Request> requests;
  std::optional<Field> show;                            ///< the field that frames carry from now on
  std::optional<std::filesystem::path> open;            ///< a file to open
  std::optional<std::filesystem::path> list_folder;     ///< a folder to list; Request::list: the last one again
  std::optional<std::size_t> view, keep_view;           ///< saved camera view to restore, to overwrite (index)
  std::optional<std::vector<std::string>> comparisons;  ///< the comparison runs from now on (variant.hpp)
  std::optional<long> seek_to;                          ///< a tick to show: past, or ahead in a recording
};

}  // namespace heml::panel
