#pragma once
// A point of the surface that moves with the tissue: weights of the corners of a triangle.
#include <app/render/pick.hpp>
#include <array>
#include <heml/session/frame.hpp>
#include <optional>

namespace heml::render {

struct SurfacePoint {
  std::array<int, 3> nodes{};      ///< of the triangle, mesh-file numbers
  std::array<float, 3> weights{};  ///< sum: 1

  /// The point among the positions (m) of its corners.
  Vec3f among(const std::array<Vec3f, 3>& corners) const;
};

/// The point of the surface at a hit.
SurfacePoint surface_point(const Hit& hit, const Frame& frame, const SurfaceMesh& surface_mesh);

/// Index into SurfaceMesh::nodes of a node by its mesh-file number; none: it is not on the surface.
std::optional<std::size_t> surface_index(int node, const SurfaceMesh& surface_mesh);

/// Whether the triangle of a point is still one of the surface: a cut may have parted its corners.
bool is_on(const SurfacePoint& point, const SurfaceMesh& surface_mesh);

/// Positions (m) of the corners in a frame; none: a corner is no longer on the surface.
std::optional<std::array<Vec3f, 3>> corners_of(const SurfacePoint& point, const Frame& frame,
                                               const SurfaceMesh& surface_mesh);

}  // namespace heml::render
