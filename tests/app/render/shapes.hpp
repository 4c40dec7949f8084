#pragma once
// Surfaces with known geometry.
#include <app/render/bounds.hpp>
#include <cmath>
#include <heml/session/frame.hpp>
#include <map>
#include <utility>

namespace heml::render {

/// The surface of a ball: an icosahedron subdivided `rounds` times, 20·4^rounds triangles, all nodes on the sphere.
inline SurfaceMesh ball_surface(int rounds, float radius, const Vec3f& centre = Vec3f::Zero()) {
  const float g = (1 + std::sqrt(5.0f)) / 2;
  std::vector<Vec3f> nodes = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                              {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  std::vector<Triangle> triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                     {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                     {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                     {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (Vec3f& node : nodes) node.normalize();
  for (int round = 0; round < rounds; ++round) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [place, added] = middles.try_emplace(std::minmax(a, b), static_cast<int>(nodes.size()));
      if (added) nodes.push_back((nodes[a] + nodes[b]).normalized());
      return place->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : triangles) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    triangles = finer;
  }
  SurfaceMesh surface_mesh;
  surface_mesh.triangles = triangles;
  surface_mesh.regions.assign(triangles.size(), 1);
  for (const Vec3f& node : nodes) {
    surface_mesh.nodes.push_back(static_cast<int>(surface_mesh.nodes.size()));
    surface_mesh.rest.push_back(centre + radius * node);
  }
  return surface_mesh;
}

/// A cube of edge 1 about the origin: 8 nodes, 12 triangles.
inline SurfaceMesh cube_surface() {
  SurfaceMesh surface_mesh;
  for (int i = 0; i < 8; ++i) {
    surface_mesh.nodes.push_back(i);
    surface_mesh.rest.emplace_back((i & 1) - 0.5f, ((i >> 1) & 1) - 0.5f, ((i >> 2) & 1) - 0.5f);
  }
  surface_mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                            {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  surface_mesh.regions.assign(12, 0);
  return surface_mesh;
}

inline Frame frame_at_rest(const SurfaceMesh& surface_mesh) {
  Frame frame;
  frame.surface_mesh = std::make_shared<const SurfaceMesh>(surface_mesh);
  frame.positions = surface_mesh.rest;
  return frame;
}

}  // namespace heml::render
