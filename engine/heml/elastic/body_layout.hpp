#pragma once
// What no step changes of a body: its elements, and where their corners and springs meet at the nodes. Edits make
// another one; bodies of other worlds, snapshots and the undo history share it (base/shared.hpp). The elements of each
// material (element_group.hpp) and the fans (fan_layout.hpp) are shared in the same way.
#include <heml/elastic/element_group.hpp>
#include <heml/elastic/point_layout.hpp>
#include <heml/elastic/springs.hpp>
#include <heml/elastic/virtual_corners.hpp>
#include <heml/math/bytes.hpp>
#include <optional>
#include <vector>

namespace heml {

template <class Real>
struct BodyLayout {
  TetMesh mesh;                  ///< inner order; of quadratic elements the integration points (mesh/quadratic.hpp)
  std::vector<int> material_of;  ///< of the elements of mesh
  std::optional<VirtualCorners<Real>> virtual_corners;  ///< none: linear elements
  struct Joints {
    CornerMap corners;             ///< of all elements
    CornerMap force_corners;       ///< of those whose forces are evaluated by loops
    std::size_t corner_count = 0;  ///< padding included
    Springs<Real> springs;
    PointLayout points;  ///< of quadratic elements whose forces point kernels evaluate
    bool operator==(const Joints&) const = default;
  } joints;  ///< of the present materials; a change of materials alone often leaves them as they are

  std::size_t nodes() const { return virtual_corners ? virtual_corners->nodes() : mesh.nodes.size(); }
  std::size_t bytes() const {
    std::size_t sum = bytes_of(mesh.nodes, mesh.tets, mesh.regions, mesh.burns, material_of) + joints.springs.bytes() +
                      joints.points.bytes();
    for (const ElementField& field : mesh.fields) sum += bytes_of(field.values);
    for (const CornerMap* map : {&joints.corners, &joints.force_corners}) sum += bytes_of(map->start, map->corners);
    return sum + (virtual_corners ? virtual_corners->bytes() : 0);
  }
};

}  // namespace heml
