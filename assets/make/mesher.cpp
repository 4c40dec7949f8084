#include "mesher.hpp"

#include <algorithm>
#include <cmath>

#include "contour.hpp"
#include "fill.hpp"
#include "improve.hpp"
#include "reconnect.hpp"
#include "remesh.hpp"

namespace heml::make {
namespace {

/// Alternates between connections and places until both settle. The first nodes are those of the surface.
void improve(TetMesh& mesh, const Organ& organ, const std::vector<Vec3>& home) {
  const Quality quality{organ.edge};
  std::vector<Vec3> normal;
  for (const Vec3& x : home) normal.push_back(gradient(organ.shape, x).normalized());
  const Constraint inner = [&](int n, const Vec3& p) { return n < int(home.size()) ? mesh.nodes[n] : p; };
  // Nodes of the surface may slide along it a little, never across a gap to where it looks elsewhere.
  const Constraint all = [&](int n, const Vec3& p) -> Vec3 {
    if (n >= int(home.size())) return p;
    Vec3 place = p - (p - home[n]).dot(normal[n]) * normal[n];
    if ((place - home[n]).norm() > 0.3 * organ.edge) return mesh.nodes[n];
    for (int step = 0; step < 4; ++step) place -= organ.shape(place) * normal[n];
    const bool arrived = std::abs(organ.shape(place)) < 0.01 * organ.edge;
    return arrived && gradient(organ.shape, place).normalized().dot(normal[n]) > 0.8 ? place : mesh.nodes[n];
  };
  bool changed = true;
  for (int round = 0; round < 10 && changed; ++round) {
    changed = false;
    for (int sweep = 0; sweep < 10 && reconnect(mesh, {quality, 0.3, 0.94}); ++sweep) changed = true;
    if (smooth(mesh, quality, inner, 0.6, 3)) changed = true;
    if (smooth(mesh, quality, all, organ.enough, 3)) changed = true;
  }
}

/// Region of each element by its centroid; an element between two or more of another region joins them, so that the
/// border is not ragged.
void mark_regions(TetMesh& mesh, const Organ& organ) {
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto& [a, b, c, d] = mesh.tets[t];
    mesh.regions[t] = organ.region((mesh.nodes[a] + mesh.nodes[b] + mesh.nodes[c] + mesh.nodes[d]) / 4);
  }
  std::vector<std::pair<Triangle, int>> faces;
  for (int t = 0; t < int(mesh.tets.size()); ++t)
    for (int skipped = 0; skipped < 4; ++skipped) {
      Triangle face;
      for (int i = 0, j = 0; i < 4; ++i)
        if (i != skipped) face[j++] = mesh.tets[t][i];
      std::ranges::sort(face);
      faces.push_back({face, t});
    }
  std::ranges::sort(faces);
  std::vector<std::vector<int>> neighbours(mesh.tets.size());
  for (std::size_t i = 0; i + 1 < faces.size(); ++i)
    if (faces[i].first == faces[i + 1].first) {
      neighbours[faces[i].second].push_back(faces[i + 1].second);
      neighbours[faces[i + 1].second].push_back(faces[i].second);
    }
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    for (const int other : neighbours[t]) {
      const auto count = [&](int region) {
        return std::ranges::count_if(neighbours[t], [&](int n) { return mesh.regions[n] == region; });
      };
      if (count(mesh.regions[other]) > count(mesh.regions[t])) mesh.regions[t] = mesh.regions[other];
    }
}

}  // namespace

TetMesh mesh_of(const Organ& organ) {
  TriangleMesh surface = contour(organ.shape, organ.low, organ.high, 0.4 * organ.edge);
  remesh(
      surface, organ.shape, [&](const Vec3& p) { return organ.edge * organ.detail(p); }, 45);
  TetMesh mesh = fill(surface, interior_lattice(organ.shape, organ.low, organ.high, organ.depth, organ.spacing));
  improve(mesh, organ, surface.nodes);
  mark_regions(mesh, organ);
  mesh.source = organ.name;
  return mesh;
}

}  // namespace heml::make
