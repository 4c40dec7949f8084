#pragma once
// What of the body lies under a pixel.
#include <app/render/camera.hpp>
#include <heml/session/frame.hpp>
#include <optional>

namespace heml::render {

struct Hit {
  int triangle = 0;  ///< index into Skin::triangles
  int node = 0;      ///< the triangle's node nearest to the point: an index into Skin::nodes
  Vec3f point;       ///< m
};

/// The nearest triangle, of either side, that a ray meets; of equally near ones the first.
std::optional<Hit> pick(const Frame& frame, const SurfaceMesh& surface_mesh, const Ray& ray);

/// The field's value at a hit of such a frame, between its triangle's corners; none where the frame carries none.
std::optional<float> value_at(const Hit& hit, const Frame& frame, const SurfaceMesh& surface_mesh);

}  // namespace heml::render
