#pragma once
// The closed surfaces a surface consists of, and how they lie in each other. A body may have cavities and these may
// hold bodies again:
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
  std::vector<int> of_triangle;  ///< #F, in order of the first triangle
  int count = 0;
};

/// Edge-connected parts of a closed manifold surface, their triangles turned alike (as the first of each has it).
/// Throws InputError when that cannot be.
Shells orient_consistently(TriangleMesh& surface);

/// Turns whole shells until every triangle faces away from the body.
void orient_outward(TriangleMesh& surface, const Shells& shells);

/// A point in every cavity of a surface turned outward, m.
std::vector<Vec3> cavity_points(const TriangleMesh& surface, const Shells& shells);

}  // namespace heml
