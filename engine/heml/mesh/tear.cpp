#include <algorithm>
#include <cassert>
#include <heml/mesh/faces.hpp>
#include <heml/mesh/tear.hpp>
#include <map>
#include <numeric>

namespace heml {
namespace {

bool is_above(const TearOpening& opening, const TetMesh& mesh, int element) {
  Vec3 middle = Vec3::Zero();
  for (const int n : mesh.tets[static_cast<std::size_t>(element)])
    middle += mesh.nodes[static_cast<std::size_t>(n)] / 4;
  return opening.plane_normal.dot(middle - mesh.nodes[static_cast<std::size_t>(opening.node)]) > 0;
}

/// A face between two elements round a node.
struct Between {
  int one, other;  ///< indices in the list of elements round the node
  Triangle nodes;
};

std::vector<Between> faces_round(int node, std::span<const int> elements, const TetMesh& mesh) {
  std::map<Triangle, int> first;
  std::vector<Between> faces;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const Tet& tet = mesh.tets[static_cast<std::size_t>(elements[e])];
    for (std::size_t f = 0; f < 4; ++f) {
      if (tet[f] == node) continue;  // the face opposite to the node
      Triangle face;
      for (std::size_t k = 0; k < 3; ++k) face[k] = tet[static_cast<std::size_t>(tet_faces[f][k])];
      std::sort(face.begin(), face.end());
      const auto [found, is_first] = first.emplace(face, static_cast<int>(e));
      if (!is_first) faces.push_back({found->second, static_cast<int>(e), face});
    }
  }
  return faces;
}

/// The group of each element round a node: elements connected by faces on one side of the plane. The first element is
/// in group 0.
std::vector<int> groups_of(std::span<const int> elements, const std::vector<bool>& above,
                           const std::vector<Between>& faces) {
  std::vector<int> group(elements.size());
  std::iota(group.begin(), group.end(), 0);
  for (bool changes = true; changes;) {
    changes = false;
    for (const Between& face : faces) {
      int &a = group[static_cast<std::size_t>(face.one)], &b = group[static_cast<std::size_t>(face.other)];
      if (above[static_cast<std::size_t>(face.one)] != above[static_cast<std::size_t>(face.other)] || a == b) continue;
      a = b = std::min(a, b);
      changes = true;
    }
  }
  std::vector<int> distinct = group;
  std::sort(distinct.begin(), distinct.end());
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  for (int& g : group) g = static_cast<int>(std::lower_bound(distinct.begin(), distinct.end(), g) - distinct.begin());
  return group;
}

}  // namespace

NodeToElements::NodeToElements(const TetMesh& mesh, const Topology& topology) : start_(mesh.nodes.size() + 1, 0) {
  for (const int t : topology.elements)
    for (const int n : mesh.tets[static_cast<std::size_t>(t)]) ++start_[static_cast<std::size_t>(n) + 1];
  for (std::size_t n = 0; n + 1 < start_.size(); ++n) start_[n + 1] += start_[n];
  list_.resize(start_.back());
  std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
  for (const int t : topology.elements)
    for (const int n : mesh.tets[static_cast<std::size_t>(t)]) list_[next[static_cast<std::size_t>(n)]++] = t;
}

bool can_tear(const TearOpening& opening, const TetMesh& mesh, const NodeToElements& around) {
  const auto elements = around.of(opening.node);
  return std::any_of(elements.begin(), elements.end(),
                     [&](int t) { return is_above(opening, mesh, t) != is_above(opening, mesh, elements.front()); });
}

Tear make_tear(const std::vector<TearOpening>& openings, const TetMesh& mesh, const std::vector<Vec3>& x,
               const NodeToElements& around) {
  Tear tear;
  std::map<int, Tet> changed;  // by element
  const auto at = [&](int n) -> const Vec3& { return x[static_cast<std::size_t>(n)]; };
  for (const TearOpening& opening : openings) {
    const auto elements = around.of(opening.node);
    std::vector<bool> above;
    for (const int t : elements) above.push_back(is_above(opening, mesh, t));
    const std::vector<Between> faces = faces_round(opening.node, elements, mesh);
    const std::vector<int> group = groups_of(elements, above, faces);
    const auto first = static_cast<int>(mesh.nodes.size() + tear.edit.nodes.size()) - 1;  // group 0 keeps the node
    const int groups = *std::max_element(group.begin(), group.end()) + 1;
    tear.edit.nodes.insert(tear.edit.nodes.end(), static_cast<std::size_t>(groups - 1),
                           InsertedNode{opening.node, opening.node, 0});
    for (std::size_t e = 0; e < elements.size(); ++e) {
      if (group[e] == 0) continue;
      Tet tet = mesh.tets[static_cast<std::size_t>(elements[e])];
      *std::find(tet.begin(), tet.end(), opening.node) = first + group[e];
      const bool is_new = changed.emplace(elements[e], tet).second;
      assert(is_new);
      (void)is_new;
    }
    for (const auto& [one, other, nodes] : faces) {
      if (group[static_cast<std::size_t>(one)] == group[static_cast<std::size_t>(other)]) continue;
      ++tear.faces;
      tear.area += (at(nodes[1]) - at(nodes[0])).cross(at(nodes[2]) - at(nodes[0])).norm() / 2;
    }
  }
  for (const auto& [element, tet] : changed) {
    tear.edit.removed.push_back(element);
    tear.edit.added.push_back(tet);
    tear.edit.parents.push_back(element);
  }
  return tear;
}

}  // namespace heml
