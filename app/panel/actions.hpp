#pragma once
// What goes out of the panel. The panel knows no session: whoever draws it carries these out.
#include <filesystem>
#include <heml/world/command.hpp>
#include <heml/world/world.hpp>
#include <optional>
#include <string>
#include <vector>

namespace heml::panel {

/// What a key or a button asks the panel for.
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

/// What the left button does to the body.
enum class Tool { grasper, scalpel, pin, probe, suture };

/// A tool as the user has set it.
struct ToolSettings {
  Tool tool = Tool::grasper;
  double radius = 0;                             ///< m, of a grasp or a pin
  double depth = 0;                              ///< m, that the scalpel reaches below the surface
  double probe_radius = 0, dent = 0, shaft = 0;  ///< m, of the probe, what it goes below the surface, its length
  double friction = 0.3;                         ///< Coulomb's coefficient, of the probe and of tables
};

/// What the panel asks its owner for.
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
  std::optional<Field> show;                            ///< the field that frames should carry from now on
  std::optional<std::filesystem::path> open;            ///< a file to open
  std::optional<std::filesystem::path> list_folder;     ///< a folder to list; Request::list: where one was last
  std::optional<std::size_t> view, keep_view;           ///< a number of Eye: to go to, to keep as it looks now
  std::optional<std::vector<std::string>> comparisons;  ///< what is to be beside the body from now on (variant.hpp)
  std::optional<long> seek_to;                          ///< a tick to show, of the past or of a recording ahead
};

}  // namespace heml::panel
