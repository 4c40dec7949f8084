#pragma once
// Ray picking of the body's surface.
#include <app/render/camera.hpp>
#include <app/render/section.hpp>
#include <heml/session/frame.hpp>
#include <optional>
#include <span>

namespace heml::render {

struct Hit {
  int triangle = 0;  ///< index into SurfaceMesh::triangles
  int node = 0;      ///< the triangle's node nearest to the point; index into SurfaceMesh::nodes
  Vec3f point;       ///< m
};

/// The nearest triangle that a ray hits from either side; the first of equally near ones. None: the ray misses.
/// With a section plane the ray passes what lies beyond it, and ends where it would meet the surface from inside: the
/// section's cap hides it.
std::optional<Hit> pick(const Frame& frame, const SurfaceMesh& surface_mesh, const Ray& ray,
                        const std::optional<SectionPlane>& section = std::nullopt);

/// The same among some triangles: indices, ascending.
std::optional<Hit> pick(const Frame& frame, const SurfaceMesh& surface_mesh, std::span<const int> triangles,
                        const Ray& ray, const std::optional<SectionPlane>& section = std::nullopt);

/// The point of the surface nearest to a point (m), at most `reach` (m) away and not beyond the section plane; the first
/// of equally near ones. None: there is no surface so near.
std::optional<Hit> nearest_surface(const Frame& frame, const SurfaceMesh& surface_mesh, const Vec3f& point, float reach,
                                   const std::optional<SectionPlane>& section = std::nullopt);

/// The field's value at a hit in the frame, interpolated linearly; none if the frame carries no field.
std::optional<float> value_at(const Hit& hit, const Frame& frame, const SurfaceMesh& surface_mesh);

}  // namespace heml::render
