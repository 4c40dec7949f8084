#include <algorithm>
#include <heml/mesh/improve/collapse_edge.hpp>
#include <utility>

namespace heml {
namespace {

template <class Item>
void make_sorted_set(std::vector<Item>& items) {
  std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
}

template <class Item>
std::size_t common(const std::vector<Item>& a, const std::vector<Item>& b) {
  std::vector<Item> both;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  return both.size();
}

/// The nodes and edges of elements without the given node itself, sorted.
struct Link {
  std::vector<int> nodes;
  std::vector<std::pair<int, int>> edges;
};

Link link_of(const LocalMesh& mesh, int n) {
  Link link;
  for (const int t : mesh.star(n)) {
    const Tet& tet = mesh.tet(t);
    for (std::size_t i = 0; i < 4; ++i) {
      if (tet[i] == n) continue;
      link.nodes.push_back(tet[i]);
      for (std::size_t j = 0; j < i; ++j)
        if (tet[j] != n) link.edges.push_back(std::minmax(tet[i], tet[j]));
    }
  }
  make_sorted_set(link.nodes);
  make_sorted_set(link.edges);
  return link;
}

/// Whether merging a and b keeps the topology of the elements: their links meet in the link of the edge alone.
bool links_meet_in_ring(const LocalMesh& mesh, int a, int b, const std::vector<int>& ring) {
  const Link of_a = link_of(mesh, a), of_b = link_of(mesh, b);
  std::vector<int> nodes;
  std::vector<std::pair<int, int>> edges;
  for (const int t : ring) {
    std::vector<int> opposite;
    for (const int n : mesh.tet(t))
      if (n != a && n != b) opposite.push_back(n);
    edges.push_back(std::minmax(opposite[0], opposite[1]));
    nodes.insert(nodes.end(), opposite.begin(), opposite.end());
  }
  make_sorted_set(nodes);
  make_sorted_set(edges);
  return common(of_a.nodes, of_b.nodes) == nodes.size() && common(of_a.edges, of_b.edges) == edges.size();
}

/// The same for the surface: nodes joined to both a and b by edges of it belong to the faces at edge ab.
bool surface_links_meet(const LocalMesh& mesh, const std::vector<Triangle>& faces_of_a, int b) {
  std::vector<int> of_a, of_b, at_edge;
  for (const Triangle& face : faces_of_a) {
    of_a.insert(of_a.end(), {face[1], face[2]});
    if (face[1] == b) at_edge.push_back(face[2]);
    if (face[2] == b) at_edge.push_back(face[1]);
  }
  for (const Triangle& face : mesh.surface_faces(b)) of_b.insert(of_b.end(), {face[1], face[2]});
  make_sorted_set(of_a);
  make_sorted_set(of_b);
  make_sorted_set(at_edge);
  return common(of_a, of_b) == at_edge.size();
}

/// Whether a may go to b as part of the surface, and the surface stays within its tolerance.
bool surface_allows(const LocalMesh& mesh, const SurfaceGuard& guard, int a, int b) {
  const NodeFreedom freedom = freedom_of(mesh, a);
  if (freedom.kind == NodeFreedom::Kind::interior) return true;
  if (freedom.kind == NodeFreedom::Kind::corner) return false;
  if (freedom.kind == NodeFreedom::Kind::crease && freedom.along[0] != b && freedom.along[1] != b) return false;
  std::vector<Triangle> moved;
  for (Triangle face : freedom.faces)
    if (face[1] != b && face[2] != b) {
      face[0] = b;
      moved.push_back(face);
    }
  if (freedom.faces.size() - moved.size() < 2 || moved.empty()) return false;  // no edge of the surface
  return surface_links_meet(mesh, freedom.faces, b) &&
         guard.allows(patch_of(mesh, freedom.faces), patch_of(mesh, moved));
}

}  // namespace

bool collapse_edge(LocalMesh& mesh, const SurfaceGuard& guard, int a, int b, double quality) {
  const std::vector<int> star(mesh.star(a).begin(), mesh.star(a).end());
  std::vector<int> ring;
  std::vector<RegionTet> added;
  for (const int t : star) {
    RegionTet moved{mesh.tet(t), mesh.region(t)};
    if (std::find(moved.nodes.begin(), moved.nodes.end(), b) != moved.nodes.end()) {
      ring.push_back(t);
      continue;
    }
    std::replace(moved.nodes.begin(), moved.nodes.end(), a, b);
    if (!(mesh.quality_of(moved.nodes) > quality)) return false;
    added.push_back(moved);
  }
  if (ring.empty() || added.empty()) return false;
  if (!links_meet_in_ring(mesh, a, b, ring) || !surface_allows(mesh, guard, a, b)) return false;
  mesh.replace(star, added);
  return true;
}

bool collapse_if_better(LocalMesh& mesh, const SurfaceGuard& guard, int a, int b) {
  return collapse_edge(mesh, guard, a, b, mesh.worst(mesh.star(a)) + smallest_gain);
}

}  // namespace heml
