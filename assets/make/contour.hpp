#pragma once
// A first triangle mesh of a shape: marching tetrahedra (Doi & Koide 1991), which always gives a closed manifold.
#include <heml/mesh/tet_mesh.hpp>

#include "shape.hpp"

namespace heml::make {

/// The closed surface of what lies strictly inside [low, high], outward. cell: m, side of the cubes that are cut into
/// six tetrahedra each.
TriangleMesh contour(const Shape& shape, const Vec3& low, const Vec3& high, double cell);

}  // namespace heml::make
