#pragma once
// Commands as events of scenes and recordings: the one table. Events are read and written by it, places in space become
// nodes by it, `heml explain` takes its words from it, and the reference page is printed from it. A command without a
// row does not compile.
#include <heml/scenario/key_table.hpp>
#include <heml/world/command.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace heml {

/// A number in a command that stands for a node or an element, in mesh-file order.
struct MeshReference {
  enum class Kind { node, element };
  Kind kind;
  int* number;
  std::string key;  ///< where it stands in the event: "grasp.node"
};

/// What commands of a tool are for, in the order in which `heml explain` lists them.
enum class CommandTool { grasp, probe, pin, suture, tables, cut, cautery, removal, undo };

/// What `heml explain` says of a tool.
struct ToolInfo {
  CommandTool tool;
  std::string_view name;
  std::string_view does;  ///< to the engine
};
std::span<const ToolInfo> tool_table();

/// A row of the table. Functions are given commands of its own type alone.
struct CommandInfo {
  std::string_view key;           ///< of the event; commands may share one
  std::string_view meaning;       ///< a sentence without its subject and full stop
  std::string_view example;       ///< of the value, JSON
  ValueForm form;                 ///< of the value
  std::string_view unit;          ///< of the value, SI; empty: none
  std::span<const KeyInfo> keys;  ///< of a value that is an object
  bool is_edit;                   ///< changes which elements there are, or takes such a change back: what `undo` counts
  std::optional<CommandTool> tool;
  bool (*takes_up)(const Command& command);  ///< whether it is a use of its tool, and not the rest of one
  /// The command that a value of the key stands for. Of nodes that are given by places, these go into `points`. Throws
  /// InputError naming the key.
  Command (*read)(const JsonCursor& value, std::vector<Vec3>& points);
  Json (*write)(const Command& command);  ///< the value
  std::vector<MeshReference> (*references)(Command& command);
};

/// In the order of Command. Rows that share a key stand for all their commands with the `read` of the first.
std::span<const CommandInfo> command_table();

const CommandInfo& info_of(const Command& command);

/// The first row with a key, which must be one of event_keys().
const CommandInfo& command_with(std::string_view key);

/// Every key of the table once, in the order in which messages list them.
std::span<const std::string_view> event_keys();

}  // namespace heml
