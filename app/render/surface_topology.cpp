#include "app/render/surface_topology.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace heml::render {
namespace {

// One side of a triangle: vertex `local` to the next one. Slots number the 3·#F triangle vertices.
struct HalfEdge {
  int from, to;  // nodes, from < to
  int triangle, local;
  int from_slot, to_slot;
};

std::vector<HalfEdge> sorted_half_edges(const SurfaceMesh& surface_mesh) {
  std::vector<HalfEdge> result;
  result.reserve(3 * surface_mesh.triangles.size());
  for (int t = 0; t < static_cast<int>(surface_mesh.triangles.size()); ++t)
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      HalfEdge edge{surface_mesh.triangles[t][k], surface_mesh.triangles[t][next], t, k, 3 * t + k, 3 * t + next};
      if (edge.from > edge.to) {
        std::swap(edge.from, edge.to);
        std::swap(edge.from_slot, edge.to_slot);
      }
      result.push_back(edge);
    }
  std::stable_sort(result.begin(), result.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return std::pair(a.from, a.to) < std::pair(b.from, b.to);
  });
  return result;
}

// Disjoint sets of slots that share a normal (union-find).
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  int root(int slot) {
    while (parent_[slot] != slot) slot = parent_[slot] = parent_[parent_[slot]];
    return slot;
  }
  void join(int a, int b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<int> parent_;
};

Vec3f rest_normal(const SurfaceMesh& surface_mesh, int triangle) {
  const auto& [a, b, c] = surface_mesh.triangles[triangle];
  return (surface_mesh.rest[b] - surface_mesh.rest[a]).cross(surface_mesh.rest[c] - surface_mesh.rest[a]);
}

bool is_smooth(const SurfaceMesh& surface_mesh, const HalfEdge& a, const HalfEdge& b, float crease) {
  const Vec3f m = rest_normal(surface_mesh, a.triangle), n = rest_normal(surface_mesh, b.triangle);
  return m.dot(n) >= std::cos(crease) * m.norm() * n.norm();
}

void add_edge(SurfaceTopology& topology, const HalfEdge* first, const HalfEdge* last) {
  SurfaceEdge edge{first->from, first->to, {}};
  for (const HalfEdge* half = first; half != last; ++half) {
    topology.triangle_edges[half->triangle][half->local] = static_cast<int>(topology.edges.size());
    const SurfaceEdge::Side side{topology.triangles[half->from_slot / 3][half->from_slot % 3],
                                 topology.triangles[half->to_slot / 3][half->to_slot % 3]};
    if (std::find(edge.sides.begin(), edge.sides.end(), side) == edge.sides.end()) edge.sides.push_back(side);
  }
  topology.edges.push_back(std::move(edge));
}

// Calls action(first, last) for each run of half edges between the same nodes.
template <class Action>
void for_each_edge(const std::vector<HalfEdge>& half_edges, Action action) {
  const HalfEdge* const end = half_edges.data() + half_edges.size();
  for (const HalfEdge* first = half_edges.data(); first != end;) {
    const HalfEdge* last = first;
    while (last != end && last->from == first->from && last->to == first->to) ++last;
    action(first, last);
    first = last;
  }
}

}  // namespace

SurfaceTopology surface_topology(const SurfaceMesh& surface_mesh, float crease, std::span<const char> exposed) {
  const std::vector<HalfEdge> half_edges = sorted_half_edges(surface_mesh);
  Sets sheets(half_edges.size());
  for_each_edge(half_edges, [&](const HalfEdge* first, const HalfEdge* last) {
    if (last - first != 2 || !is_smooth(surface_mesh, first[0], first[1], crease)) return;
    if (!exposed.empty() && exposed[first[0].triangle] != exposed[first[1].triangle]) return;
    sheets.join(first[0].from_slot, first[1].from_slot);
    sheets.join(first[0].to_slot, first[1].to_slot);
  });

  SurfaceTopology topology;
  std::vector<int> corner_of_root(half_edges.size(), -1);
  for (std::size_t t = 0; t < surface_mesh.triangles.size(); ++t) {
    Triangle corners;
    for (int k = 0; k < 3; ++k) {
      int& corner = corner_of_root[sheets.root(static_cast<int>(3 * t) + k)];
      if (corner < 0) {
        corner = static_cast<int>(topology.corner_nodes.size());
        topology.corner_nodes.push_back(surface_mesh.triangles[t][k]);
      }
      corners[k] = corner;
    }
    topology.triangles.push_back(corners);
  }
  topology.triangle_edges.resize(surface_mesh.triangles.size());
  for_each_edge(half_edges, [&](const HalfEdge* first, const HalfEdge* last) { add_edge(topology, first, last); });
  return topology;
}

}  // namespace heml::render
