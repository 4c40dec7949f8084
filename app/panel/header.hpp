#pragma once
// The head of the panel: title, time, the buttons that run the simulation, and whether it keeps up with the clock.
#include <app/panel/keys.hpp>
#include <app/panel/mesh_openings.hpp>
#include <app/panel/rows.hpp>
#include <heml/session/frame.hpp>
#include <string>
#include <vector>

namespace heml::panel {

/// title, description: of the scene. openings: of its mesh, for undo. Appends the actions whose buttons were pressed.
void draw_header(Rows& rows, const std::string& title, const std::string& description, const Frame& frame,
                 const MeshOpenings& openings, std::vector<Action>& pressed);

}  // namespace heml::panel
