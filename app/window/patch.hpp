#pragma once
// The piece of tissue that a mark on the surface means.
#include <heml/session/frame.hpp>
#include <vector>

namespace heml::window {

/// Elements behind the triangles round a node (mesh-file number) of the surface: those it has, and those whose middle
/// is within a radius (m) of it at rest. Mesh-file numbers, ascending; empty for a node that is not on the surface.
std::vector<int> elements_around(int node, const SurfaceMesh& surface_mesh, double radius);

}  // namespace heml::window
