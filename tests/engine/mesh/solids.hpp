#pragma once
// Closed surfaces for tests.
#include <heml/mesh/generate.hpp>
#include <heml/mesh/surface.hpp>
#include <vector>

namespace heml {

/// The boundary of a box, oriented outward, without interior nodes.
inline TriangleMesh box_surface(const Vec3& size, int cells, const Vec3& origin = Vec3::Zero()) {
  const TetMesh box = make_box(size, {cells, cells, cells}, origin);
  TriangleMesh surface;
  surface.source = "box";
  std::vector<int> number(box.nodes.size(), -1);
  for (Triangle triangle : extract_boundary(box).triangles) {
    for (int& node : triangle) {
      if (number[node] < 0) {
        number[node] = static_cast<int>(surface.nodes.size());
        surface.nodes.push_back(box.nodes[node]);
      }
      node = number[node];
    }
    surface.triangles.push_back(triangle);
  }
  return surface;
}

inline TriangleMesh cube(double size, const Vec3& centre) {
  return box_surface(Vec3::Constant(size), 2, centre - Vec3::Constant(size / 2));
}

/// A box with a dent in its top; the adjacent node is pushed through a wall of the dent.
inline TriangleMesh creased_box() {
  TriangleMesh surface = box_surface(Vec3(1, 1, 1), 12);
  for (Vec3& x : surface.nodes) {
    if ((x - Vec3(0.5, 0.5, 1)).norm() < 1e-9) x += Vec3(0.14, 0.01, -0.05);
    if ((x - Vec3(7.0 / 12, 0.5, 1)).norm() < 1e-9) x += Vec3(0, 0, -0.1);
  }
  return surface;
}

inline TriangleMesh together(TriangleMesh a, const TriangleMesh& b) {
  const int first = static_cast<int>(a.nodes.size());
  a.nodes.insert(a.nodes.end(), b.nodes.begin(), b.nodes.end());
  for (const auto& [i, j, k] : b.triangles) a.triangles.push_back({i + first, j + first, k + first});
  return a;
}

/// Signed volume enclosed by a surface, m³; positive if it is oriented outward.
inline double enclosed_volume(const TriangleMesh& surface) {
  double volume = 0;
  for (const auto& [a, b, c] : surface.triangles)
    volume += surface.nodes[a].dot(surface.nodes[b].cross(surface.nodes[c])) / 6;
  return volume;
}

}  // namespace heml
