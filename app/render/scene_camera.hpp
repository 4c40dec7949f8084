#pragma once
// Where a scene wants to be seen from.
#include <app/render/camera.hpp>
#include <heml/scenario/scene.hpp>
#include <heml/session/frame.hpp>

namespace heml::render {

/// A camera that has the body at rest in the picture, turned and zoomed as the scene's view says.
Camera camera_for(const View& view, const SurfaceMesh& surface_mesh, Size size);

}  // namespace heml::render
