#pragma once
// Makes the list of actions that frames carry (UndoList).
#include <heml/session/frame.hpp>
#include <heml/world/world.hpp>
#include <memory>

namespace heml {

/// The list after a command was carried out; `last` where it has not changed.
std::shared_ptr<const UndoList> updated(std::shared_ptr<const UndoList> last, const World& world,
                                        const Command& command);

}  // namespace heml
