#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <heml/base/error.hpp>
#include <heml/mesh/shells.hpp>
#include <heml/mesh/solid_angle.hpp>
#include <limits>
#include <numbers>
#include <span>

namespace heml {
namespace {

struct Corner {
  int low, high;  ///< nodes of the edge
  int triangle;
  bool ascending;  ///< whether the triangle traverses the edge from low to high
};

// The edges of all triangles, sorted so that equal edges are adjacent.
std::vector<Corner> sorted_edges(const TriangleMesh& surface) {
  std::vector<Corner> edges;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (int i = 0; i < 3; ++i) {
      const int a = surface.triangles[t][i], b = surface.triangles[t][(i + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), static_cast<int>(t), a < b});
    }
  std::sort(edges.begin(), edges.end(), [](const Corner& a, const Corner& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  return edges;
}

struct Neighbour {
  int triangle;
  bool alike;  ///< consistently oriented: the triangles traverse their edge in opposite directions
};

void turn(Triangle& triangle) { std::swap(triangle[1], triangle[2]); }

// Six times the signed volume of the tetrahedron of a triangle and `origin`.
double volume_under(const TriangleMesh& surface, const Triangle& t, const Vec3& origin) {
  return (surface.nodes[t[0]] - origin).cross(surface.nodes[t[1]] - origin).dot(surface.nodes[t[2]] - origin);
}

std::vector<double> shell_volumes(const TriangleMesh& surface, const Shells& shells) {
  std::vector<double> volumes(shells.count, 0);
  std::vector<int> first(shells.count, -1);  // origin near the shell: less cancellation
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const int shell = shells.of_triangle[t];
    if (first[shell] < 0) first[shell] = surface.triangles[t][0];
    volumes[shell] += volume_under(surface, surface.triangles[t], surface.nodes[first[shell]]);
  }
  return volumes;
}

// The number of shells that contain each shell. Shells do not cross, so one point of it decides.
std::vector<int> depths(const TriangleMesh& surface, const Shells& shells) {
  std::vector<Eigen::AlignedBox3d> boxes(shells.count);
  std::vector<std::vector<int>> members(shells.count);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    members[shells.of_triangle[t]].push_back(static_cast<int>(t));
    for (int node : surface.triangles[t]) boxes[shells.of_triangle[t]].extend(surface.nodes[node]);
  }
  std::vector<int> depth(shells.count, 0);
  for (int inner = 0; inner < shells.count; ++inner) {
    const Triangle& t = surface.triangles[members[inner].front()];
    const Vec3 point = (surface.nodes[t[0]] + surface.nodes[t[1]] + surface.nodes[t[2]]) / 3;
    for (int outer = 0; outer < shells.count; ++outer) {
      if (outer == inner || !boxes[outer].contains(boxes[inner])) continue;
      double angle = 0;
      for (int member : members[outer]) {
        const Triangle& s = surface.triangles[member];
        angle += solid_angle(surface.nodes[s[0]] - point, surface.nodes[s[1]] - point, surface.nodes[s[2]] - point);
      }
      depth[inner] += std::abs(angle) > 2 * std::numbers::pi;
    }
  }
  return depth;
}

// Parameter of a ray's first hit, in multiples of `along` (Möller & Trumbore 1997); edges count as hit.
double first_hit(const TriangleMesh& surface, int from_triangle, const Vec3& start, const Vec3& along) {
  constexpr double slack = 1e-9;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (static_cast<int>(t) == from_triangle) continue;
    const auto& [a, b, c] = surface.triangles[t];
    const Vec3 ab = surface.nodes[b] - surface.nodes[a], ac = surface.nodes[c] - surface.nodes[a];
    const Vec3 cross = along.cross(ac), offset = start - surface.nodes[a], other = offset.cross(ab);
    const double scale = 1 / ab.dot(cross);
    const double u = offset.dot(cross) * scale, v = along.dot(other) * scale, distance = ac.dot(other) * scale;
    if (u >= -slack && v >= -slack && u + v <= 1 + slack && distance > 0) nearest = std::min(nearest, distance);
  }
  return nearest;
}

}  // namespace

Shells orient_consistently(TriangleMesh& surface) {
  const std::vector<Corner> edges = sorted_edges(surface);
  std::vector<std::array<Neighbour, 3>> neighbours(surface.triangles.size());
  std::vector<int> known(surface.triangles.size(), 0);
  for (std::size_t e = 0, end = 0; e < edges.size(); e = end) {
    while (end < edges.size() && edges[end].low == edges[e].low && edges[end].high == edges[e].high) ++end;
    if (end - e != 2) continue;
    const Corner &a = edges[e], &b = edges[e + 1];
    neighbours[a.triangle][known[a.triangle]++] = {b.triangle, a.ascending != b.ascending};
    neighbours[b.triangle][known[b.triangle]++] = {a.triangle, a.ascending != b.ascending};
  }
  Shells shells{std::vector<int>(surface.triangles.size(), -1), 0};
  std::vector<char> turned(surface.triangles.size(), 0);
  std::vector<int> front;
  for (std::size_t seed = 0; seed < surface.triangles.size(); ++seed) {
    if (shells.of_triangle[seed] >= 0) continue;
    shells.of_triangle[seed] = shells.count;
    front.push_back(static_cast<int>(seed));
    while (!front.empty()) {
      const int t = front.back();
      front.pop_back();
      for (const Neighbour& next : std::span(neighbours[t].data(), static_cast<std::size_t>(known[t]))) {
        const char wanted = turned[t] ^ !next.alike;
        if (shells.of_triangle[next.triangle] < 0) {
          shells.of_triangle[next.triangle] = shells.count;
          turned[next.triangle] = wanted;
          front.push_back(next.triangle);
        } else if (turned[next.triangle] != wanted) {
          throw InputError(surface.source, fmt::format("triangle {}", next.triangle),
                           "the surface has one side only: its triangles cannot be turned alike",
                           "a surface with an inside and an outside");
        }
      }
    }
    ++shells.count;
  }
  for (std::size_t t = 0; t < turned.size(); ++t)
    if (turned[t]) turn(surface.triangles[t]);
  return shells;
}

void orient_outward(TriangleMesh& surface, const Shells& shells) {
  const std::vector<double> volumes = shell_volumes(surface, shells);
  const std::vector<int> depth = depths(surface, shells);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const int shell = shells.of_triangle[t];
    if ((volumes[shell] < 0) != (depth[shell] % 2 == 1)) turn(surface.triangles[t]);
  }
}

std::vector<Vec3> cavity_points(const TriangleMesh& surface, const Shells& shells) {
  const std::vector<double> volumes = shell_volumes(surface, shells);
  std::vector<int> largest(shells.count, -1);
  std::vector<double> size(shells.count, 0);
  const auto normal = [&](const Triangle& t) -> Vec3 {
    return (surface.nodes[t[1]] - surface.nodes[t[0]]).cross(surface.nodes[t[2]] - surface.nodes[t[0]]);
  };
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const int shell = shells.of_triangle[t];
    const double area = normal(surface.triangles[t]).norm();
    if (area > size[shell]) {
      size[shell] = area;
      largest[shell] = static_cast<int>(t);
    }
  }
  std::vector<Vec3> points;
  for (int shell = 0; shell < shells.count; ++shell) {
    if (volumes[shell] >= 0) continue;
    const Triangle& t = surface.triangles[largest[shell]];
    const Vec3 start = (surface.nodes[t[0]] + surface.nodes[t[1]] + surface.nodes[t[2]]) / 3;
    const Vec3 into = normal(t).normalized();
    points.push_back(start + 0.5 * first_hit(surface, largest[shell], start, into) * into);
  }
  return points;
}

}  // namespace heml
