#pragma once
// The camera of a scene's view.
#include <app/render/camera.hpp>
#include <heml/scenario/scene.hpp>
#include <heml/session/frame.hpp>

namespace heml::render {

/// A camera fitted to the body at rest, with the azimuth, elevation and zoom of the scene's view.
Camera camera_for(const View& view, const SurfaceMesh& surface_mesh, Size size);

}  // namespace heml::render
