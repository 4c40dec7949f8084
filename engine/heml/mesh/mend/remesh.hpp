#pragma once
// Meshes the space that a surface winds round, for surfaces that no local repair closes: the lattice of label maps
// (labels/lattice.hpp) cut where the winding number passes one half, then the shape improver.
#include <heml/mesh/tet_mesh.hpp>
#include <optional>

namespace heml {

/// Requires triangles that face outward. Elements are as long as the surface's edges on average, within what gives
/// thousands to 12,000 elements; max_volume (m³ per tetrahedron) makes them smaller. Throws InputError if no volume is
/// found; warns of the elements' size and how far the new surface lies from the old.
TetMesh remesh(const TriangleMesh& surface, std::optional<double> max_volume);

}  // namespace heml
