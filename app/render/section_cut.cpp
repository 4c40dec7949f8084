#include <algorithm>
#include <app/render/section_cut.hpp>
#include <cmath>

namespace heml::render {

std::vector<SectionTriangle> cut_section(const Solid& solid, const std::vector<Vec3f>& positions,
                                         const SectionPlane& plane) {
  std::vector<float> beyond(positions.size());
  for (std::size_t n = 0; n < positions.size(); ++n) beyond[n] = plane.beyond(positions[n]);
  const auto distance = [&](int node) { return beyond[static_cast<std::size_t>(node)]; };
  std::vector<SectionTriangle> triangles;
  const auto add = [&](std::array<SectionCorner, 3> corners, int element) {
    const Vec3f a = at_corner(corners[0], positions), b = at_corner(corners[1], positions),
                c = at_corner(corners[2], positions);
    if ((b - a).cross(c - a).dot(plane.normal) < 0) std::swap(corners[1], corners[2]);
    triangles.push_back({corners, element});
  };
  for (std::size_t t = 0; t < solid.tets.size(); ++t) {
    std::array<int, 4> kept{}, left_out{};
    std::size_t keeps = 0, leaves = 0;
    for (const int node : solid.tets[t]) {
      if (!std::isfinite(distance(node))) break;
      if (distance(node) > 0)
        left_out[leaves++] = node;
      else
        kept[keeps++] = node;
    }
    if (keeps == 0 || leaves == 0 || keeps + leaves < 4) continue;
    const auto corner = [&](int inside, int outside) {
      return SectionCorner{{inside, outside}, distance(inside) / (distance(inside) - distance(outside))};
    };
    const int element = static_cast<int>(t);
    if (keeps == 1) {
      add({corner(kept[0], left_out[0]), corner(kept[0], left_out[1]), corner(kept[0], left_out[2])}, element);
    } else if (leaves == 1) {
      add({corner(kept[0], left_out[0]), corner(kept[1], left_out[0]), corner(kept[2], left_out[0])}, element);
    } else {
      const SectionCorner a = corner(kept[0], left_out[0]), b = corner(kept[0], left_out[1]),
                          c = corner(kept[1], left_out[1]), d = corner(kept[1], left_out[0]);
      add({a, b, c}, element);
      add({a, c, d}, element);
    }
  }
  return triangles;
}

}  // namespace heml::render
