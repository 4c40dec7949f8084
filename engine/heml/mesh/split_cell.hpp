#pragma once
// Bricks, wedges and pyramids as tetrahedra that fit those of their neighbours: every quadrilateral is divided from its
// corner of the smallest number, and the cell is the cone from its corner of the smallest number over the faces that
// do not touch it (J. Dompierre, P. Labbé, M.-G. Vallet, R. Camarero, How to Subdivide Pyramids, Prisms, and Hexahedra
// into Tetrahedra, 8th International Meshing Roundtable, 1999, whose rule for faces this is).
//
//      7────6                5              4          corners in the order of VTK's hexahedron and pyramid, and of
//     /│   /│              / │ \           /|\         Gmsh's prism, whose triangles are turned in VTK's wedge
//    4────5 │             3──┼──4         / | \        brick: 6 tetrahedra, wedge: 3, pyramid: 2
//    │ 3──│─2             │  2  │        3──┼──2
//    │/   │/              │ / \ │       /   |  /
//    0────1               0─────1      0──────1
#include <heml/mesh/tet_mesh.hpp>
#include <span>
#include <vector>

namespace heml {

enum class CellShape { tetrahedron, pyramid, wedge, brick };

constexpr std::size_t corners_of(CellShape shape) {
  constexpr std::size_t corners[] = {4, 5, 6, 8};
  return corners[static_cast<std::size_t>(shape)];
}

/// Appends the tetrahedra of a cell. Its corners may be wound either way, and be the same in part (a brick that is
/// drawn as a wedge): what has no volume by its numbers is left out. Returns false if the cell is bent so much that
/// its tetrahedra overlap; they are appended all the same. corners: corners_of(shape) numbers of nodes.
bool split_cell(CellShape shape, std::span<const int> corners, const std::vector<Vec3>& nodes, std::vector<Tet>& tets);

}  // namespace heml
