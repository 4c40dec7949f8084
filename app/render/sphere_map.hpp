#pragma once
// Parametrisation of a body's surface over the unit sphere, for textures defined on the sphere.
#include <heml/session/frame.hpp>
#include <optional>
#include <span>
#include <vector>

namespace heml::render {

/// #S×3, unit: Laplacian smoothing on the sphere, from each node's direction as seen from the body's centre. Smoothing
/// evens out the distortion at hollows. known: #S positions to keep where set, or empty. Deterministic.
std::vector<Vec3f> sphere_map(const SurfaceMesh& surface_mesh, std::span<const std::optional<Vec3f>> known = {});

}  // namespace heml::render
