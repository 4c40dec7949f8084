#include "app/render/lip_shape.hpp"

#include <cmath>
#include <heml/mesh/weld.hpp>
#include <numeric>

namespace heml::render {
namespace {

constexpr int smoothing_rounds = 12;
constexpr float forwards = 0.5f, backwards = -0.53f;    // Taubin 1995: smooths without shrinking
constexpr float max_shift = 0.4f, max_opening = 0.22f;  // in mean edges round a site
constexpr float groove_depth = 6;                       // in openings
constexpr int skin_rings = 2, extension_rounds = 12;    // of the skin that follows the rim

using NodeEdge = std::array<int, 2>;  // lower index first

std::vector<NodeEdge> edges_of(const SurfaceMesh& surface_mesh, const std::vector<char>& exposed, bool of_exposed) {
  std::vector<NodeEdge> edges;
  for (std::size_t t = 0; t < surface_mesh.triangles.size(); ++t) {
    if ((exposed[t] != 0) != of_exposed) continue;
    const Triangle& triangle = surface_mesh.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(triangle[k], triangle[(k + 1) % 3]);
      edges.push_back({low, high});
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

Vec3f face_normal(const std::vector<Vec3f>& x, const Triangle& triangle) {
  return (x[triangle[1]] - x[triangle[0]]).cross(x[triangle[2]] - x[triangle[0]]);
}

void add_once(std::vector<int>& list, int value) {
  if (std::find(list.begin(), list.end(), value) == list.end()) list.push_back(value);
}

class LipShape {
 public:
  LipShape(const SurfaceMesh& surface_mesh, const OriginalSkin& skin, const std::vector<WoundSite>& sites)
      : mesh_(surface_mesh), skin_(skin), sites_(sites), moved_(surface_mesh.rest.size(), Vec3f::Zero()) {}

  std::vector<Vec3f> displacements(float opening) {
    smooth();
    part(opening);
    extend_over_skin();
    keep_faces_upright();
    return std::move(moved_);
  }

 private:
  const Vec3f& rest(const WoundSite& site) const { return mesh_.rest[site.nodes[0]]; }

  float mean_edge(const WoundSite& site) const {
    float sum = 0;
    for (const int other : site.around) sum += (rest(sites_[other]) - rest(site)).norm();
    return site.around.empty() ? 0 : sum / static_cast<float>(site.around.size());
  }

  /// The ends of a rim and places where rims meet stay.
  void smooth() {
    std::vector<Vec3f> now(sites_.size()), next;
    for (std::size_t s = 0; s < sites_.size(); ++s) now[s] = rest(sites_[s]);
    for (int round = 0; round < 2 * smoothing_rounds; ++round) {
      next = now;
      for (std::size_t s = 0; s < sites_.size(); ++s) {
        const WoundSite& site = sites_[s];
        const std::vector<int>& neighbours = site.rim.empty() ? site.around : site.rim;
        if (neighbours.empty() || (!site.rim.empty() && site.rim.size() != 2)) continue;
        Vec3f mean = Vec3f::Zero();
        for (const int other : neighbours) mean += now[other] / static_cast<float>(neighbours.size());
        next[s] += (round % 2 == 0 ? forwards : backwards) * (mean - now[s]).dot(site.across) * site.across;
      }
      std::swap(now, next);
    }
    for (std::size_t s = 0; s < sites_.size(); ++s) {
      Vec3f shift = now[s] - rest(sites_[s]);
      const float most = max_shift * mean_edge(sites_[s]);
      if (shift.norm() > most) shift *= most / shift.norm();
      if (!sites_[s].rim.empty()) shift = on_skin(rest(sites_[s]) + shift) - rest(sites_[s]);
      for (const int node : sites_[s].nodes) moved_[node] = shift;
    }
  }

  Vec3f on_skin(const Vec3f& point) const {
    const OriginalSkin::Place place = skin_.nearest(point);
    Vec3f sum = Vec3f::Zero();
    for (std::size_t k = 0; k < 3; ++k) sum += place.weights[k] * mesh_.whole->rest[place.nodes[k]];
    return sum;
  }

  /// Draws each side back from the other, at the skin and less below it.
  void part(float opening) {
    std::vector<Vec3f> outwards(mesh_.rest.size(), Vec3f::Zero());
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      if (skin_.exposed()[t])
        for (const int node : mesh_.triangles[t]) outwards[node] += face_normal(mesh_.rest, mesh_.triangles[t]);
    for (const WoundSite& site : sites_) {
      if (site.nodes.size() < 2) continue;
      const float depth = skin_.places()[site.nodes[0]].depth;
      const float gap = std::min(opening, max_opening * mean_edge(site)) * (1 - depth / (groove_depth * opening));
      for (const int node : site.nodes)
        if (gap > 0 && outwards[node].norm() > 0) moved_[node] -= gap * outwards[node].normalized();
    }
  }

  /// Laplace's equation over the nearest rings of skin, solved by Jacobi iteration.
  void extend_over_skin() {
    std::vector<int> ring(mesh_.rest.size(), -1);
    for (const WoundSite& site : sites_)
      for (const int node : site.nodes) ring[node] = 0;
    const std::vector<NodeEdge> all = edges_of(mesh_, skin_.exposed(), false);
    for (int k = 1; k <= skin_rings; ++k)
      for (const auto& [a, b] : all) {
        if (ring[a] == k - 1 && ring[b] < 0) ring[b] = k;
        if (ring[b] == k - 1 && ring[a] < 0) ring[a] = k;
      }
    std::vector<NodeEdge> edges;
    for (const NodeEdge& edge : all)
      if (ring[edge[0]] > 0 || ring[edge[1]] > 0) edges.push_back(edge);
    std::vector<Vec3f> sums(mesh_.rest.size());
    std::vector<float> counts(mesh_.rest.size());
    for (int round = 0; round < extension_rounds; ++round) {
      std::fill(sums.begin(), sums.end(), Vec3f::Zero());
      std::fill(counts.begin(), counts.end(), 0.0f);
      for (const auto& [a, b] : edges) {
        sums[a] += moved_[b];
        sums[b] += moved_[a];
        ++counts[a];
        ++counts[b];
      }
      for (std::size_t n = 0; n < moved_.size(); ++n)
        if (ring[n] > 0 && counts[n] > 0) moved_[n] = sums[n] / counts[n];
    }
  }

  /// Halves displacements, the same on all sides of a site, until no face of the skin is turned over.
  void keep_faces_upright() {
    std::vector<int> site_of(mesh_.rest.size(), -1);
    for (std::size_t s = 0; s < sites_.size(); ++s)
      for (const int node : sites_[s].nodes) site_of[node] = static_cast<int>(s);
    const auto halve = [&](int node) {
      if (site_of[node] < 0)
        moved_[node] /= 2;
      else
        for (const int twin : sites_[site_of[node]].nodes) moved_[twin] /= 2;
    };
    const auto is_upright = [&](const Triangle& t) {
      const Vec3f before = face_normal(mesh_.rest, t);
      const std::vector<Vec3f> corners{mesh_.rest[t[0]] + moved_[t[0]], mesh_.rest[t[1]] + moved_[t[1]],
                                       mesh_.rest[t[2]] + moved_[t[2]]};
      return before.dot(face_normal(corners, {0, 1, 2})) > 0.2f * before.squaredNorm();
    };
    constexpr int rounds = 6;
    for (int round = 0; round < rounds; ++round)
      for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
        const Triangle& corners = mesh_.triangles[t];
        const auto is_still = [&](int node) { return moved_[node].isZero(0); };
        if (skin_.exposed()[t] || std::all_of(corners.begin(), corners.end(), is_still) || is_upright(corners))
          continue;
        for (const int node : corners) halve(node);
      }
  }

  const SurfaceMesh& mesh_;
  const OriginalSkin& skin_;
  const std::vector<WoundSite>& sites_;
  std::vector<Vec3f> moved_;
};

}  // namespace

std::vector<WoundSite> wound_sites(const SurfaceMesh& surface_mesh, const std::vector<char>& exposed) {
  const std::vector<std::uint32_t> same = weld(surface_mesh.rest);
  const std::vector<NodeEdge> raw = edges_of(surface_mesh, exposed, true),
                              whole = edges_of(surface_mesh, exposed, false);
  std::vector<WoundSite> sites;
  std::vector<int> site_of(surface_mesh.rest.size(), -1);
  for (const auto& edge : raw)
    for (const int node : edge) site_of[same[node]] = 0;
  for (std::size_t n = 0; n < same.size(); ++n) {
    if (site_of[same[n]] < 0) continue;
    if (same[n] == n) {
      site_of[n] = static_cast<int>(sites.size());
      sites.emplace_back();
    }
    site_of[n] = site_of[same[n]];
    sites[site_of[n]].nodes.push_back(static_cast<int>(n));
  }
  for (const NodeEdge& edge : raw) {
    const int a = site_of[edge[0]], b = site_of[edge[1]];
    add_once(sites[a].around, b);
    add_once(sites[b].around, a);
    if (!std::binary_search(whole.begin(), whole.end(), edge)) continue;
    add_once(sites[a].rim, b);
    add_once(sites[b].rim, a);
  }
  for (std::size_t t = 0; t < exposed.size(); ++t) {
    if (!exposed[t]) continue;
    const Vec3f normal = face_normal(surface_mesh.rest, surface_mesh.triangles[t]);
    for (const int node : surface_mesh.triangles[t]) {
      Vec3f& across = sites[site_of[node]].across;
      across += across.dot(normal) < 0 ? Vec3f(-normal) : normal;
    }
  }
  for (WoundSite& site : sites) site.across.normalize();
  return sites;
}

std::vector<Vec3f> lip_displacements(const SurfaceMesh& surface_mesh, const OriginalSkin& skin,
                                     const std::vector<WoundSite>& sites, float opening) {
  return LipShape(surface_mesh, skin, sites).displacements(opening);
}

}  // namespace heml::render
