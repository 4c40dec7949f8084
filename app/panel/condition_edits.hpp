#pragma once
// Boundary conditions and loads with those of some nodes changed. Nodes are mesh-file numbers, ascending. Entries that
// lose all nodes go.
#include <heml/session/frame.hpp>
#include <optional>

namespace heml::panel {

/// These coordinates of the nodes are fixed as at rest, whatever held or moved them.
SetBoundary fixed(const Conditions& conditions, const std::vector<int>& nodes, const AxisSet& axes = {});
/// Nothing holds or moves the nodes; none: nothing does.
std::optional<SetBoundary> freed(const Conditions& conditions, const std::vector<int>& nodes);

/// One more force, N in all, shared equally by the nodes; it replaces forces on the same nodes.
SetLoads loaded(const Conditions& conditions, const std::vector<int>& nodes, const Vec3& force);
/// Nothing loads the nodes; the others of a force keep their shares. None: nothing loads them.
std::optional<SetLoads> unloaded(const Conditions& conditions, const std::vector<int>& nodes);

/// How many of the nodes some entry has.
template <class Entry>
std::size_t count_in(const std::vector<Entry>& entries, const std::vector<int>& nodes);

}  // namespace heml::panel
