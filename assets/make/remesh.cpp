#include "remesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace heml::make {
namespace {

/// An edge of a closed surface, its two triangles and the node opposite in each. left has a→b, right has b→a.
struct Edge {
  int a, b, left, right, c, d;
  double length;
};

/// What one pass over the mesh looks at. An edit touches its triangles, and no triangle is edited twice a pass: so what
/// was computed here stays true for the edges that are still untouched.
struct Topology {
  std::vector<Edge> edges;
  std::vector<std::vector<int>> ring;  ///< triangles round each node
  std::vector<char> touched;           ///< triangles edited in this pass

  bool neighbours(const TriangleMesh& mesh, int a, int b) const {
    return std::ranges::any_of(ring[a], [&](int t) { return std::ranges::count(mesh.triangles[t], b) > 0; });
  }
};

Vec3 area_vector(const TriangleMesh& mesh, const Triangle& t) {
  return 0.5 * (mesh.nodes[t[1]] - mesh.nodes[t[0]]).cross(mesh.nodes[t[2]] - mesh.nodes[t[0]]);
}

Topology topology_of(const TriangleMesh& mesh) {
  Topology topology;
  topology.ring.resize(mesh.nodes.size());
  topology.touched.assign(mesh.triangles.size(), 0);
  std::vector<std::array<int, 4>> sides;  // {low node, high node, 0 when low→high else 1, triangle}
  for (int t = 0; t < int(mesh.triangles.size()); ++t)
    for (int i = 0; i < 3; ++i) {
      const int a = mesh.triangles[t][i], b = mesh.triangles[t][(i + 1) % 3];
      topology.ring[a].push_back(t);
      sides.push_back({std::min(a, b), std::max(a, b), a > b, t});
    }
  std::ranges::sort(sides);
  const auto opposite = [&](int t, int a, int b) {
    return *std::ranges::find_if(mesh.triangles[t], [&](int n) { return n != a && n != b; });
  };
  for (std::size_t i = 0; i + 1 < sides.size(); i += 2) {
    const auto [a, b, first, left] = sides[i];
    const int right = sides[i + 1][3];
    topology.edges.push_back(
        {a, b, left, right, opposite(left, a, b), opposite(right, a, b), (mesh.nodes[a] - mesh.nodes[b]).norm()});
  }
  return topology;
}

/// Edges in the order of how much they ask for the edit.
std::vector<Edge> by_length(std::vector<Edge> edges, bool longest_first) {
  std::ranges::stable_sort(
      edges, [&](const Edge& p, const Edge& q) { return longest_first ? p.length > q.length : p.length < q.length; });
  return edges;
}

int split_long(TriangleMesh& mesh, const Shape& shape, const std::function<double(const Vec3&)>& target) {
  Topology topology = topology_of(mesh);
  int edits = 0;
  for (const Edge& e : by_length(topology.edges, true)) {
    const Vec3 middle = 0.5 * (mesh.nodes[e.a] + mesh.nodes[e.b]);
    if (topology.touched[e.left] || topology.touched[e.right] || e.length < 4.0 / 3 * target(middle)) continue;
    const int m = int(mesh.nodes.size());
    mesh.nodes.push_back(project(shape, middle));
    mesh.triangles[e.left] = {e.a, m, e.c};
    mesh.triangles[e.right] = {e.b, m, e.d};
    mesh.triangles.push_back({m, e.b, e.c});
    mesh.triangles.push_back({m, e.a, e.d});
    topology.touched[e.left] = topology.touched[e.right] = 1;
    ++edits;
  }
  return edits;
}

/// Whether moving nodes a and b of the edge to `place` keeps a manifold, turns no triangle and makes no long edge.
bool may_collapse(const TriangleMesh& mesh, const Topology& topology, const Edge& e, const Vec3& place,
                  double longest) {
  std::vector<int> around_a, around_b, common;
  const auto check = [&](int node, int other, std::vector<int>& around) {
    for (const int t : topology.ring[node]) {
      if (topology.touched[t]) return false;
      for (const int n : mesh.triangles[t])
        if (n != node) around.push_back(n);
      if (std::ranges::count(mesh.triangles[t], other)) continue;
      Vec3 corner[3];
      for (int i = 0; i < 3; ++i) {
        corner[i] = mesh.triangles[t][i] == node ? place : mesh.nodes[mesh.triangles[t][i]];
        if ((corner[i] - place).norm() > longest) return false;
      }
      const Vec3 after = 0.5 * (corner[1] - corner[0]).cross(corner[2] - corner[0]);
      const Vec3 before = area_vector(mesh, mesh.triangles[t]);
      if (after.dot(before) < 0.5 * after.norm() * before.norm()) return false;
    }
    std::ranges::sort(around);
    around.erase(std::unique(around.begin(), around.end()), around.end());
    return true;
  };
  if (!check(e.a, e.b, around_a) || !check(e.b, e.a, around_b)) return false;
  std::ranges::set_intersection(around_a, around_b, std::back_inserter(common));
  return common.size() == 2 && topology.ring[e.c].size() > 3 && topology.ring[e.d].size() > 3;
}

int collapse_short(TriangleMesh& mesh, const Shape& shape, const std::function<double(const Vec3&)>& target) {
  Topology topology = topology_of(mesh);
  std::vector<char> dropped(mesh.nodes.size(), 0);
  int edits = 0;
  for (const Edge& e : by_length(topology.edges, false)) {
    const Vec3 middle = 0.5 * (mesh.nodes[e.a] + mesh.nodes[e.b]);
    const double length = target(middle);
    if (e.length > 4.0 / 5 * length) continue;
    const Vec3 place = project(shape, middle);
    if (!may_collapse(mesh, topology, e, place, 4.0 / 3 * length)) continue;
    for (const int node : {e.a, e.b})
      for (const int t : topology.ring[node]) {
        topology.touched[t] = 1;
        std::ranges::replace(mesh.triangles[t], e.b, e.a);
      }
    mesh.nodes[e.a] = place;
    dropped[e.b] = 1;
    ++edits;
  }
  std::erase_if(mesh.triangles, [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  std::vector<int> renumbered(mesh.nodes.size());
  int kept = 0;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    renumbered[n] = kept;
    if (!dropped[n]) mesh.nodes[kept++] = mesh.nodes[n];
  }
  mesh.nodes.resize(kept);
  for (Triangle& t : mesh.triangles)
    for (int& n : t) n = renumbered[n];
  return edits;
}

double angle_at(const Vec3& p, const Vec3& q, const Vec3& r) {
  return std::atan2((q - p).cross(r - p).norm(), (q - p).dot(r - p));
}

/// Whether the other diagonal is better: valences nearer to six, or (delaunay) opposite angles that sum to less than π.
bool wants_flip(const TriangleMesh& mesh, const Topology& topology, const Edge& e, bool delaunay) {
  const auto& x = mesh.nodes;
  if (delaunay) return angle_at(x[e.c], x[e.a], x[e.b]) + angle_at(x[e.d], x[e.a], x[e.b]) > std::numbers::pi + 1e-3;
  const auto excess = [&](int n, int change) { return std::abs(int(topology.ring[n].size()) + change - 6); };
  return excess(e.a, -1) + excess(e.b, -1) + excess(e.c, 1) + excess(e.d, 1) <
         excess(e.a, 0) + excess(e.b, 0) + excess(e.c, 0) + excess(e.d, 0);
}

int flip(TriangleMesh& mesh, bool delaunay) {
  Topology topology = topology_of(mesh);
  int edits = 0;
  for (const Edge& e : topology.edges) {
    // Valences change beyond the two triangles, so the rings of all four nodes count as touched.
    const auto busy = [&](int n) {
      return std::ranges::any_of(topology.ring[n], [&](int t) { return topology.touched[t]; });
    };
    if (busy(e.a) || busy(e.b) || busy(e.c) || busy(e.d)) continue;
    if (topology.ring[e.a].size() <= 4 || topology.ring[e.b].size() <= 4) continue;
    if (!wants_flip(mesh, topology, e, delaunay) || topology.neighbours(mesh, e.c, e.d)) continue;
    const Triangle first = {e.a, e.d, e.c}, second = {e.d, e.b, e.c};
    const Vec3 normal =
        (area_vector(mesh, mesh.triangles[e.left]) + area_vector(mesh, mesh.triangles[e.right])).normalized();
    const Vec3 n1 = area_vector(mesh, first).normalized(), n2 = area_vector(mesh, second).normalized();
    if (n1.dot(normal) < 0.8 || n2.dot(normal) < 0.8) continue;
    mesh.triangles[e.left] = first;
    mesh.triangles[e.right] = second;
    topology.touched[e.left] = topology.touched[e.right] = 1;
    ++edits;
  }
  return edits;
}

/// Every node towards the area-weighted centroid of its ring, along the surface.
void relax(TriangleMesh& mesh, const Shape& shape, const std::function<double(const Vec3&)>& target) {
  std::vector<Vec3> sum(mesh.nodes.size(), Vec3::Zero()), normal(mesh.nodes.size(), Vec3::Zero());
  std::vector<double> weight(mesh.nodes.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    const Vec3 centroid = (mesh.nodes[t[0]] + mesh.nodes[t[1]] + mesh.nodes[t[2]]) / 3, area = area_vector(mesh, t);
    const double length = target(centroid), w = area.norm() / (length * length);
    for (const int n : t) {
      sum[n] += w * centroid;
      normal[n] += area;
      weight[n] += w;
    }
  }
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    const Vec3 direction = normal[n].normalized(), move = sum[n] / weight[n] - mesh.nodes[n];
    mesh.nodes[n] = project(shape, mesh.nodes[n] + 0.7 * (move - move.dot(direction) * direction));
  }
}

}  // namespace

void remesh(TriangleMesh& mesh, const Shape& shape, const std::function<double(const Vec3& p)>& edge, int iterations) {
  for (int iteration = 0; iteration < iterations; ++iteration) {
    // Edits stop before the end, so that the last rounds only settle what is there.
    const bool settle = iteration >= iterations * 2 / 3;
    for (int pass = 0; !settle && pass < 6 && split_long(mesh, shape, edge); ++pass) {
    }
    for (int pass = 0; !settle && pass < 6 && collapse_short(mesh, shape, edge); ++pass) {
    }
    for (int pass = 0; pass < 6 && flip(mesh, settle); ++pass) {
    }
    for (int pass = 0; pass < 3; ++pass) relax(mesh, shape, edge);
  }
}

}  // namespace heml::make
