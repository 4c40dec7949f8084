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

  // Elements as bounds of the stable step count them: slots through all parts, or quadratic elements by number.
  std::size_t bounded_elements() const { return virtual_corners ? elements() : joints.corner_count / 4; }
  std::size_t bounded_element(const ElementGroup<Real>& group, std::size_t slot) const {
    return virtual_corners ? element_at(group, slot) : group.first_corner / 4 + slot;
  }
  /// Calls visit() for those at a node in ascending order.
  template <class Visit>
  void each_element_at(std::size_t node, const Visit& visit) const {
    if (virtual_corners) {
      for (const std::size_t place : virtual_corners->places_at(node)) visit(place / 10);
    } else {
      const CornerMap& map = joints.corners;
      for (std::size_t k = map.start[node]; k < map.start[node + 1]; ++k) visit(map.corners[k] / 4);
    }
  }

  std::size_t elements() const { return virtual_corners ? virtual_corners->elements() : mesh.tets.size(); }
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
