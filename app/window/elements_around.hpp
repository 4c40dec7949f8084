#pragma once
// The elements round a node of the surface.
#include <heml/session/frame.hpp>
#include <vector>

namespace heml::window {

/// Elements behind the surface triangles that have a node (mesh-file number) or whose centroid is within a radius (m)
/// of it at rest. Mesh-file numbers, ascending; empty for a node that is not on the surface.
std::vector<int> elements_around(int node, const SurfaceMesh& surface_mesh, double radius);

}  // namespace heml::window
