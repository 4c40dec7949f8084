#pragma once
// The shape of a body, for choosing how it stands: unit, axis that points up, the part of its surface that holds it.
#include <heml/mesh/surface.hpp>
#include <heml/mesh/tet_mesh.hpp>
#include <heml/scenario/bare_mesh_options.hpp>
#include <vector>

namespace heml {

struct BodyShape {
  Vec3 low, high;          ///< bounding box of the boundary
  Vec3 centre;             ///< of the volume
  double area = 0;         ///< of the boundary
  BoundaryFaces faces;     ///< the boundary
  std::vector<int> nodes;  ///< of the boundary, ascending
  Vec3 size() const { return high - low; }
};

/// Throws InputError where elements overlap so that there is no boundary.
BodyShape shape_of(const TetMesh& mesh);

/// The unit in which a body of this length has the size of an organ: metres from 1 mm to 2 m; else the first of
/// centimetres and millimetres that makes it 0.05 to 0.5 m long; else none, and a factor that makes it 0.2 m long.
LengthUnit guess_unit(double length);

/// The units in which a body of this length is 1 mm to 2 m long, and last the factor that makes it 0.2 m long.
std::vector<LengthUnit> plausible_units(double length);

/// Area of the flat faces at the low end of an axis (0: x, 1: y, 2: z) over the box's area there.
double flat_base(const TetMesh& mesh, const BodyShape& shape, int axis);

/// z where the body has a flat base below z and none below y, else y, the axis that points up in scenes.
UpAxis guess_up(const TetMesh& mesh, const BodyShape& shape);

/// The part of the surface that holds a body whose y points up.
struct Support {
  bool top = false;   ///< at the high end of y; else at the low end
  double height = 0;  ///< m, y of its other end
  double area = 0;    ///< share of the surface
};

/// The lowest or highest part of the surface with a share of its area.
Support support_at(bool top, const TetMesh& mesh, const BodyShape& shape, double share);

/// The lowest part of the surface with `share` of its area where the centre of volume is above it, so that the body
/// rests on its underside; else the highest part where the centre is below that, so that it hangs; else the lowest.
Support choose_support(const TetMesh& mesh, const BodyShape& shape, double share);

}  // namespace heml
