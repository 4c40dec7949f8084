#include <algorithm>
#include <heml/mesh/faces.hpp>
#include <heml/mesh/labels/merge_scraps.hpp>
#include <map>

namespace heml {
namespace {

constexpr std::size_t max_scrap = 10;  // elements
constexpr std::size_t min_parts = 50;  // of such size in a region, for one to be a scrap

/// The element across each face, at 4·tet + local face; −1 for none.
std::vector<int> tets_across(const TetMesh& mesh) {
  struct Face {
    Triangle nodes;
    int side;
  };
  std::vector<Face> faces;
  faces.reserve(4 * mesh.tets.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    for (std::size_t f = 0; f < 4; ++f) {
      Triangle nodes;
      for (std::size_t k = 0; k < 3; ++k) nodes[k] = mesh.tets[t][static_cast<std::size_t>(tet_faces[f][k])];
      std::sort(nodes.begin(), nodes.end());
      faces.push_back({nodes, static_cast<int>(4 * t + f)});
    }
  std::sort(faces.begin(), faces.end(),
            [](const Face& a, const Face& b) { return a.nodes != b.nodes ? a.nodes < b.nodes : a.side < b.side; });
  std::vector<int> neighbours(faces.size(), -1);
  for (std::size_t k = 0; k + 1 < faces.size(); ++k)
    if (faces[k].nodes == faces[k + 1].nodes) {
      neighbours[static_cast<std::size_t>(faces[k].side)] = faces[k + 1].side / 4;
      neighbours[static_cast<std::size_t>(faces[k + 1].side)] = faces[k].side / 4;
    }
  return neighbours;
}

}  // namespace

void merge_scraps(TetMesh& mesh) {
  const std::vector<int> neighbours = tets_across(mesh);
  std::map<int, std::size_t> counts;
  for (const int region : mesh.regions) ++counts[region];
  const std::vector<int> before = mesh.regions;
  std::vector<char> seen(mesh.tets.size(), 0);
  std::vector<std::size_t> component;
  for (std::size_t first = 0; first < mesh.tets.size(); ++first) {
    if (seen[first]) continue;
    component.assign(1, first);
    seen[first] = 1;
    std::map<int, int> shared;  // faces, by the region across; 0: outside
    for (std::size_t k = 0; k < component.size(); ++k)
      for (std::size_t f = 0; f < 4; ++f) {
        const int next = neighbours[4 * component[k] + f];
        const int region = next < 0 ? 0 : before[static_cast<std::size_t>(next)];
        if (region != before[first]) {
          ++shared[region];
        } else if (!seen[static_cast<std::size_t>(next)]) {
          seen[static_cast<std::size_t>(next)] = 1;
          component.push_back(static_cast<std::size_t>(next));
        }
      }
    if (component.size() >= max_scrap || component.size() * min_parts > counts[before[first]]) continue;
    const auto most = std::max_element(shared.begin(), shared.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    for (const std::size_t t : component) mesh.regions[t] = most->first;
  }
  std::size_t kept = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    if (mesh.regions[t] != 0) {
      mesh.tets[kept] = mesh.tets[t];
      mesh.regions[kept++] = mesh.regions[t];
    }
  mesh.tets.resize(kept);
  mesh.regions.resize(kept);
}

}  // namespace heml
