#pragma once
// Parametrisation of a body's surface over the unit sphere, for textures defined on the sphere.
#include <heml/session/frame.hpp>
#include <span>
#include <vector>

namespace heml::render {

/// #S×3, unit: Laplacian smoothing on the sphere, from each node's direction as seen from the body's centre. Smoothing
/// evens out the distortion at hollows. Deterministic.
std::vector<Vec3f> sphere_map(const SurfaceMesh& surface_mesh);

}  // namespace heml::render
