#include <algorithm>
#include <heml/session/remaining_skin.hpp>
#include <map>
#include <set>

namespace heml {
namespace {

constexpr std::size_t most_seen = 200;  // tiles about one, to find whether another is on the same side of a cut

Triangle ascending(const SurfaceMesh& surface, Triangle t) {
  for (int& n : t) n = surface.nodes[static_cast<std::size_t>(n)];
  std::sort(t.begin(), t.end());
  return t;
}

}  // namespace

RemainingSkin::RemainingSkin(const SurfaceMesh& surface, const OriginalSkin& original)
    : surface_(surface), tree_(list(original)), tolerance_(original.tolerance()) {}

TriangleMesh RemainingSkin::list(const OriginalSkin& original) {
  TriangleMesh mesh;
  for (const Vec3f& x : surface_.rest) mesh.nodes.push_back(x.cast<double>());
  tiles_.assign(surface_.triangles.size(), -1);
  at_.resize(surface_.nodes.size());
  for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
    if (original.exposed()[t]) continue;
    tiles_[t] = static_cast<int>(faces_.size());
    for (const int n : surface_.triangles[t]) at_[static_cast<std::size_t>(n)].push_back(tiles_[t]);
    faces_.push_back(static_cast<int>(t));
    mesh.triangles.push_back(surface_.triangles[t]);
  }
  return mesh;
}

bool RemainingSkin::are_connected(int from, int to) const {
  std::vector<int> seen{from};
  std::set<int> known{from};
  for (std::size_t i = 0; i < seen.size() && seen.size() < most_seen; ++i) {
    if (seen[i] == to) return true;
    for (const int n : surface_.triangles[face(seen[i])])
      for (const int tile : at_[static_cast<std::size_t>(n)])
        if (known.insert(tile).second) seen.push_back(tile);
  }
  return known.contains(to);
}

std::vector<int> RemainingSkin::kept_of(const SurfaceMesh& whole) const {
  std::map<Triangle, int> known;
  for (std::size_t i = 0; i < faces_.size(); ++i)
    known[ascending(surface_, surface_.triangles[static_cast<std::size_t>(faces_[i])])] = static_cast<int>(i);
  std::vector<int> kept;
  for (const Triangle& t : whole.triangles) {
    const auto found = known.find(ascending(whole, t));
    kept.push_back(found == known.end() ? -1 : found->second);
  }
  return kept;
}

}  // namespace heml
