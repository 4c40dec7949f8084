#pragma once
// A body's surface laid over the unit sphere, so that patterns made for the sphere lie on it evenly.
#include <heml/session/frame.hpp>
#include <optional>
#include <span>
#include <vector>

namespace heml::render {

/// #S×3, unit: starts from each node's direction from the body's centre, then lets neighbours pull (Laplacian smoothing
/// on the sphere), which spreads what a hollow would squeeze together. known: #S, places that are kept where there is
/// one, or empty. The same for the same skin.
std::vector<Vec3f> sphere_map(const SurfaceMesh& surface_mesh, std::span<const std::optional<Vec3f>> known = {});

}  // namespace heml::render
