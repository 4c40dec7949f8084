#include <algorithm>
#include <cmath>
#include <heml/mesh/improve/surface_tree.hpp>
#include <heml/mesh/mend/half_edges.hpp>
#include <heml/mesh/mend/parts.hpp>
#include <heml/mesh/shells.hpp>
#include <numbers>
#include <numeric>

namespace heml {
namespace {

constexpr double crumb_share = 0.002;  // of the largest part's area
constexpr int max_rays_of_part = 96, min_rays_of_part = 4, max_rays = 200'000;
constexpr double ray_start = 1e-6;  // of the box's diagonal, from the triangle

Vec3 area_vector(const TriangleMesh& surface, const Triangle& t) {
  return 0.5 * (surface.nodes[t[1]] - surface.nodes[t[0]]).cross(surface.nodes[t[2]] - surface.nodes[t[0]]);
}

std::vector<double> areas_of(const TriangleMesh& surface, const Shells& parts) {
  std::vector<double> areas(parts.count, 0.0);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    areas[parts.of_triangle[t]] += area_vector(surface, surface.triangles[t]).norm();
  return areas;
}

/// Components of triangles that share an edge, whatever its other triangles.
Shells edge_components(const TriangleMesh& surface) {
  std::vector<std::pair<std::pair<int, int>, int>> edges;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i)
      edges.push_back({std::minmax({surface.triangles[t][i], surface.triangles[t][(i + 1) % 3]}), static_cast<int>(t)});
  std::sort(edges.begin(), edges.end());
  std::vector<int> root(surface.triangles.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int t) {
    while (root[t] != t) t = root[t] = root[root[t]];
    return t;
  };
  for (std::size_t e = 1; e < edges.size(); ++e)
    if (edges[e].first == edges[e - 1].first) {
      const int a = find(edges[e].second), b = find(edges[e - 1].second);
      root[std::max(a, b)] = std::min(a, b);
    }
  Shells parts{std::vector<int>(surface.triangles.size(), -1), 0};
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const int first = find(static_cast<int>(t));
    parts.of_triangle[t] = first == static_cast<int>(t) ? parts.count++ : parts.of_triangle[first];
  }
  return parts;
}

/// Removes the parts marked.
RemovedParts remove_marked(TriangleMesh& surface, const Shells& parts, const std::vector<char>& marked) {
  const std::vector<double> areas = areas_of(surface, parts);
  RemovedParts removed;
  double kept_area = 0, removed_area = 0;
  for (std::size_t k = 0; k < marked.size(); ++k) {
    double& area = marked[k] ? removed_area : kept_area;
    area = std::max(area, areas[k]);
    removed.parts += marked[k];
  }
  std::size_t kept = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    if (!marked[parts.of_triangle[t]]) surface.triangles[kept++] = surface.triangles[t];
  removed.triangles = static_cast<int>(surface.triangles.size() - kept);
  removed.largest_share = kept_area > 0 ? removed_area / kept_area : 1;
  surface.triangles.resize(kept);
  return removed;
}

struct Sky {
  int front = 0, back = 0;  ///< rays that reach infinity from either side
};

/// Casts rays from each part, from points and in directions that follow its triangles' order: by area, along a spiral
/// over the half sphere.
std::vector<Sky> cast_rays(const TriangleMesh& surface, const Shells& parts) {
  const SurfaceTree tree(surface);
  const std::vector<double> areas = areas_of(surface, parts);
  const double start = ray_start * (tree.branches().empty() ? 0 : tree.branches()[0].box.diagonal().norm());
  const int rays_of_part = std::clamp(max_rays / std::max(parts.count, 1), min_rays_of_part, max_rays_of_part);
  std::vector<Sky> sky(parts.count);
  std::vector<double> passed(parts.count, 0.0);
  std::vector<int> cast(parts.count, 0);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const int part = parts.of_triangle[t];
    const Vec3 area = area_vector(surface, surface.triangles[t]);
    passed[part] += area.norm();
    const auto& [a, b, c] = surface.triangles[t];
    const Vec3 from = (surface.nodes[a] + surface.nodes[b] + surface.nodes[c]) / 3;
    for (; cast[part] < rays_of_part && (cast[part] + 0.5) * areas[part] <= rays_of_part * passed[part]; ++cast[part]) {
      const double height = (cast[part] % 16 + 0.5) / 16, turn = cast[part] * std::numbers::phi * 2 * std::numbers::pi;
      const Vec3 normal = area.normalized(), side = normal.unitOrthogonal();
      const Vec3 flat = std::cos(turn) * side + std::sin(turn) * normal.cross(side);
      const Vec3 along = height * normal + std::sqrt(1 - height * height) * flat;
      sky[part].front += !tree.is_hit(from, along, start);
      sky[part].back += !tree.is_hit(from, -along, start);
    }
  }
  return sky;
}

std::vector<char> parts_with(const HalfEdges& edges, const Shells& parts, int kind) {
  std::vector<char> with(parts.count, 0);
  for (std::size_t half = 0; half < edges.across.size(); ++half)
    if (edges.across[half] == kind) with[parts.of_triangle[half / 3]] = 1;
  return with;
}

std::vector<double> volumes_of(const TriangleMesh& surface, const Shells& parts) {
  std::vector<double> volumes(parts.count, 0.0);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& [a, b, c] = surface.triangles[t];
    volumes[parts.of_triangle[t]] +=
        signed_volume(surface.nodes[surface.triangles[0][0]], surface.nodes[a], surface.nodes[b], surface.nodes[c]);
  }
  return volumes;
}

}  // namespace

RemovedParts remove_crumbs(TriangleMesh& surface) {
  const Shells parts = edge_components(surface);
  const std::vector<double> areas = areas_of(surface, parts);
  const double largest = areas.empty() ? 0 : *std::max_element(areas.begin(), areas.end());
  std::vector<char> marked;
  for (const double area : areas) marked.push_back(area < crumb_share * largest);
  return remove_marked(surface, parts, marked);
}

RemovedParts remove_walls(TriangleMesh& surface) {
  const HalfEdges edges = find_half_edges(surface);
  if (std::find(edges.across.begin(), edges.across.end(), HalfEdges::crowded) == edges.across.end()) return {};
  TriangleMesh oriented = surface;
  const Shells parts = orient_consistently(oriented);
  std::vector<char> is_open = parts_with(edges, parts, HalfEdges::open);
  std::vector<char> marked = parts_with(edges, parts, HalfEdges::crowded);
  const std::vector<Sky> sky = cast_rays(oriented, parts);
  for (std::size_t k = 0; k < marked.size(); ++k)
    marked[k] = marked[k] && (is_open[k] || sky[k].front + sky[k].back == 0);
  if (std::count(marked.begin(), marked.end(), 0) == 0) return {};
  return remove_marked(surface, parts, marked);
}

void orient_by_sky(TriangleMesh& surface) {
  const Shells parts = orient_consistently(surface);
  const std::vector<Sky> sky = cast_rays(surface, parts);
  const std::vector<double> volumes = volumes_of(surface, parts);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const int part = parts.of_triangle[t];
    const auto [front, back] = sky[part];
    if (front != back ? front < back : volumes[part] > 0) std::swap(surface.triangles[t][1], surface.triangles[t][2]);
  }
}

}  // namespace heml
