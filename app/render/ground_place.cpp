#include "app/render/ground_place.hpp"

#include <algorithm>
#include <app/render/tool_drawing.hpp>
#include <numeric>

namespace heml::render {
namespace {
constexpr float gap = 0.05f, gap_below_hanging = 0.02f;  // body radii
}

GroundPlace::GroundPlace(const SurfaceMesh& surface_mesh) {
  if (surface_mesh.constrained.empty()) return;
  std::vector<std::size_t> part(surface_mesh.nodes.size());
  std::iota(part.begin(), part.end(), std::size_t{0});
  const auto part_of = [&](int node) {
    auto k = static_cast<std::size_t>(node);
    while (part[k] != k) k = part[k] = part[part[k]];
    return k;
  };
  for (const Triangle& triangle : surface_mesh.triangles) {
    part[part_of(triangle[1])] = part_of(triangle[0]);
    part[part_of(triangle[2])] = part_of(triangle[0]);
  }
  std::vector<char> hangs(part.size(), 0);
  for (const int node : surface_mesh.constrained) hangs[part_of(node)] = 1;
  for (std::size_t k = 0; k < part.size(); ++k)
    if (hangs[part_of(static_cast<int>(k))]) hanging_.push_back(k);
}

Vec3f GroundPlace::centre(const Frame& frame, const BoundingSphere& rest) const {
  float y = rest.lowest - gap * rest.radius;
  for (const TableState& table : tools_of<TableState>(frame.tools))
    y = std::min(y, ToolDrawing::lowest(table.table, rest) - gap * rest.radius);
  for (const std::size_t node : hanging_)
    if (frame.positions[node].allFinite()) y = std::min(y, frame.positions[node].y() - gap_below_hanging * rest.radius);
  return {rest.centre.x(), y, rest.centre.z()};
}

}  // namespace heml::render
