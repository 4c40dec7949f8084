#include <algorithm>
#include <heml/mesh/faces.hpp>
#include <heml/mesh/improve/remove_face.hpp>

namespace heml {
namespace {

constexpr int max_depth = 3;  // of faces past the first

/// Faces between the nodes above and below, found outward from the first one.
class FaceFan {
 public:
  FaceFan(const LocalMesh& mesh, int above, int below, int region)
      : mesh_(mesh), above_(above), below_(below), region_(region) {}

  struct Choice {
    double quality = 1;
    std::vector<int> removed;
    std::vector<RegionTet> added;

    void merge(const Choice& other) {
      quality = std::min(quality, other.quality);
      removed.insert(removed.end(), other.removed.begin(), other.removed.end());
      added.insert(added.end(), other.added.begin(), other.added.end());
    }
  };

  /// What becomes of edge xy of a removed face, whose elements are t above and s below it: an element (below, above, x,
  /// y), or the face past the edge is removed too. The face's third node lies left of xy, seen from above.
  Choice best(int x, int y, int t, int s, int depth) const {
    Choice here;
    const Tet tet{below_, above_, x, y};
    here.quality = mesh_.quality_of(tet);
    here.added = {{tet, region_}};
    if (depth == max_depth) return here;
    const int t2 = past(t, x, y, above_), s2 = past(s, x, y, below_);
    if (t2 < 0 || s2 < 0 || mesh_.region(t2) != region_ || mesh_.region(s2) != region_) return here;
    const int z = apex(t2, x, y, above_);
    if (z != apex(s2, x, y, below_)) return here;
    Choice further = best(x, z, t2, s2, depth + 1);
    further.removed.insert(further.removed.end(), {t2, s2});
    if (!(further.quality > here.quality)) return here;
    further.merge(best(z, y, t2, s2, depth + 1));
    return further.quality > here.quality ? further : here;
  }

 private:
  /// The element across the face of x, y and the apex u.
  int past(int t, int x, int y, int u) const {
    const Tet& tet = mesh_.tet(t);
    for (int f = 0; f < 4; ++f)
      if (tet[f] != x && tet[f] != y && tet[f] != u) return mesh_.across(t, f);
    return -1;
  }
  int apex(int t, int x, int y, int u) const {
    for (const int n : mesh_.tet(t))
      if (n != x && n != y && n != u) return n;
    return -1;
  }

  const LocalMesh& mesh_;
  int above_, below_, region_;
};

}  // namespace

bool remove_face(LocalMesh& mesh, int tet, int face) {
  const int other = mesh.across(tet, face);
  if (other < 0 || mesh.region(other) != mesh.region(tet)) return false;
  const Tet nodes = mesh.tet(tet);
  const auto& [i, j, k] = tet_faces[face];
  const Triangle corners{nodes[i], nodes[j], nodes[k]};  // outward: seen from the other side, counterclockwise
  int above = -1;
  for (const int n : mesh.tet(other))
    if (std::find(corners.begin(), corners.end(), n) == corners.end()) above = n;
  if (mesh.has_edge(nodes[face], above)) return false;
  const FaceFan fan(mesh, above, nodes[face], mesh.region(tet));
  FaceFan::Choice choice;
  choice.removed = {tet, other};
  for (std::size_t c = 0; c < 3; ++c) choice.merge(fan.best(corners[c], corners[(c + 1) % 3], other, tet, 0));
  std::vector<int> sorted = choice.removed;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) return false;
  if (!(choice.quality > mesh.worst(choice.removed) + smallest_gain)) return false;
  mesh.replace(choice.removed, choice.added);
  return true;
}

}  // namespace heml
