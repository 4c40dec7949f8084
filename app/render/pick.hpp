#pragma once
// Ray picking of the body's surface.
#include <app/render/camera.hpp>
#include <heml/session/frame.hpp>
#include <optional>

namespace heml::render {

struct Hit {
  int triangle = 0;  ///< index into SurfaceMesh::triangles
  int node = 0;      ///< the triangle's node nearest to the point; index into SurfaceMesh::nodes
  Vec3f point;       ///< m
};

/// The nearest triangle that a ray hits from either side; the first of equally near ones. None: the ray misses.
std::optional<Hit> pick(const Frame& frame, const SurfaceMesh& surface_mesh, const Ray& ray);

/// The field's value at a hit in the frame, interpolated linearly; none if the frame carries no field.
std::optional<float> value_at(const Hit& hit, const Frame& frame, const SurfaceMesh& surface_mesh);

}  // namespace heml::render
