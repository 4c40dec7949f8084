#pragma once
// Connected components (shells) of a surface, and their nesting. A body may have cavities, which may contain
// further bodies:
//
//      ┌───────────────┐  depth 0: outside of a body
//      │ body ┌──────┐ │  depth 1: wall of a cavity
//      │      │ ┌──┐ │ │  depth 2: outside of a body in the cavity
//      │      │ └──┘ │ │
//      │      └──────┘ │
//      └───────────────┘
#include <heml/mesh/tet_mesh.hpp>
#include <vector>

namespace heml {

struct Shells {
  std::vector<int> of_triangle;  ///< #F, shell of each triangle; shells are numbered by their first triangle
  int count = 0;
};

/// Finds the components that edges of two triangles connect, and orients the triangles of each like its first. (Open
/// edges and those of more triangles bound components, which a closed manifold surface does not have.)
/// Throws InputError if a component is not orientable.
Shells orient_consistently(TriangleMesh& surface);

/// Flips whole shells so that every triangle faces out of the body. Requires consistent orientation within shells.
void orient_outward(TriangleMesh& surface, const Shells& shells);

/// A point in every cavity of a surface oriented outward, m.
std::vector<Vec3> cavity_points(const TriangleMesh& surface, const Shells& shells);

}  // namespace heml
