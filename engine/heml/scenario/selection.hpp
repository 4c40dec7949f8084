#pragma once
// Resolves selections of a scene to node numbers.
#include <heml/mesh/tet_mesh.hpp>
#include <heml/scenario/scene.hpp>
#include <string>
#include <vector>

namespace heml {

/// Bounding box of all nodes, m.
std::pair<Vec3, Vec3> bounds_of(const std::vector<Vec3>& nodes);

/// The selected nodes in ascending order, each once. mesh: as placed. place: the entry's key path ("boundary[1]"), for
/// errors. Throws InputError when no node is selected or a number is out of range.
std::vector<int> select_nodes(const Selection& where, const TetMesh& mesh, const std::string& file,
                              const std::string& place);
/// The same on quadratic elements: a list of nodes takes the mid-edge nodes between two of them.
std::vector<int> select_nodes(const Selection& where, const WorldSetup& setup, const std::string& file,
                              const std::string& place);

/// The surface node nearest to a point (m) at rest; the lowest number of equals. Linear in the size of the mesh.
int nearest_surface_node(const TetMesh& mesh, const Vec3& point);

}  // namespace heml
