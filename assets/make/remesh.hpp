#pragma once
// Near-equilateral triangles on a shape: split, collapse, flip, relax (Botsch & Kobbelt 2004), nodes kept on the
// surface.
#include <heml/mesh/tet_mesh.hpp>

#include "shape.hpp"

namespace heml::make {

/// Improves a closed manifold mesh of `shape` until its edges are about edge(p) m long. Topology is kept.
void remesh(TriangleMesh& mesh, const Shape& shape, const std::function<double(const Vec3& p)>& edge, int iterations);

}  // namespace heml::make
