#pragma once
// The camera of a scene's view.
#include <app/render/bounds.hpp>
#include <app/render/camera.hpp>
#include <heml/scenario/scene.hpp>

namespace heml::render {

/// A camera fitted to a ball, with the azimuth, elevation and zoom of the scene's view.
Camera camera_for(const View& view, const BoundingSphere& ball, Size size);

}  // namespace heml::render
