#include <app/panel/volume.hpp>

namespace heml::panel {

double enclosed_volume(const SurfaceMesh& surface_mesh, std::span<const Vec3f> positions) {
  if (surface_mesh.triangles.empty() || positions.size() != surface_mesh.nodes.size()) return 0;
  const Vec3 origin = positions.front().cast<double>();  // on the body, to avoid cancellation
  const auto at = [&](int node) { return Vec3(positions[static_cast<std::size_t>(node)].cast<double>() - origin); };
  double six_times = 0;
  for (const Triangle& t : surface_mesh.triangles) six_times += at(t[0]).dot(at(t[1]).cross(at(t[2])));
  return six_times / 6;
}

}  // namespace heml::panel
