#pragma once
// The axes in a corner of the image, as the camera sees them. A click on an end turns the camera to it.
#include <app/panel/actions.hpp>
#include <app/panel/area.hpp>
#include <app/panel/rows.hpp>
#include <app/render/camera.hpp>

namespace heml::panel {

/// The action that turns the camera to a standard view.
Action look_at(StandardView view);

/// What a click on the end of an axis shows: the side that it names, or the opposite one where the camera sees that
/// side already.
StandardView view_after_click(StandardView end, const render::Camera& camera);

/// Draws the axes in the upper right corner of an area, or below `top` (pixels) there. place: of the axes, on return.
void draw_axes(Rows& rows, const render::Camera& camera, const Area& free, float top, std::vector<Action>& pressed,
               Area& place);

}  // namespace heml::panel
