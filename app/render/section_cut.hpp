#pragma once
// The cross-section of a body's elements with a plane. Linear tetrahedra: quadratic ones are cut between their corners.
#include <app/render/section.hpp>
#include <array>
#include <heml/session/frame.hpp>
#include <vector>

namespace heml::render {

/// A corner of the cross-section, on the edge between two nodes.
struct SectionCorner {
  std::array<int, 2> nodes;  ///< indices into Solid::rest
  float share;               ///< of the second node, 0 to 1
};

struct SectionTriangle {
  std::array<SectionCorner, 3> corners;  ///< counterclockwise seen from the side that is left out
  int element;                           ///< index into Solid::tets
};

/// A value at a corner, interpolated linearly between its nodes.
template <class Value>
Value at_corner(const SectionCorner& corner, const std::vector<Value>& values) {
  const Value& a = values[static_cast<std::size_t>(corner.nodes[0])];
  const Value& b = values[static_cast<std::size_t>(corner.nodes[1])];
  return a + corner.share * (b - a);
}

/// One or two triangles for each element that the plane crosses. positions: #N×3, m. Elements with a position that is
/// not finite have none.
std::vector<SectionTriangle> cut_section(const Solid& solid, const std::vector<Vec3f>& positions,
                                         const SectionPlane& plane);

}  // namespace heml::render
