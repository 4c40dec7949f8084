#pragma once
// What a viewer shows of undo and redo: the actions by name, and the settings that a step among them has restored.
#include <heml/world/world.hpp>
#include <memory>
#include <string>
#include <vector>

namespace heml {

/// Immutable and shared by frames until the list changes.
struct UndoList {
  std::vector<std::string> past;    ///< names of the actions that can be undone, oldest first
  std::vector<std::string> future;  ///< of those that can be redone, next first
  long steps = 0;                   ///< steps back and forth since the start
  std::vector<Command> settings;    ///< after the last of them: commands that set what holds since
};

/// The list after a command was carried out; `last` where it has not changed.
std::shared_ptr<const UndoList> updated(std::shared_ptr<const UndoList> last, const World& world,
                                        const Command& command);

}  // namespace heml
