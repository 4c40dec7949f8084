#include "reconnect.hpp"

#include <algorithm>
#include <limits>
#include <set>

namespace heml::make {
namespace {

using Pair = std::pair<int, int>;
Pair sorted(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

/// The tetrahedra round an edge ab, and the nodes across it: tetrahedron i has (a, b, polygon[i], polygon[i+1]),
/// positive.
struct Ring {
  int a, b;
  std::vector<int> tets, polygon;
  bool closed;  ///< false: ab lies on the surface, and so do the ends of the polygon
};

/// The sweep: an edit touches its tetrahedra, and none is edited twice a sweep, so that the lists made at its start
/// hold.
class Sweep {
 public:
  Sweep(TetMesh& mesh, const Reconnect& options) : mesh_(mesh), options_(options), touched_(mesh.tets.size(), 0) {
    for (int t = 0; t < int(mesh.tets.size()); ++t) {
      const Tet& k = mesh.tets[t];
      for (int i = 0; i < 4; ++i)
        for (int j = i + 1; j < 4; ++j) around_.push_back({sorted(k[i], k[j]), t});
      for (const Triangle& f :
           {Triangle{k[0], k[2], k[1]}, {k[0], k[1], k[3]}, {k[1], k[2], k[3]}, {k[2], k[0], k[3]}}) {
        Triangle key = f;
        std::ranges::sort(key);
        faces_.push_back({key, f, t});
      }
    }
    std::ranges::sort(around_);
    std::ranges::stable_sort(faces_, {}, &Face::key);
    for (std::size_t i = 0; i < faces_.size(); ++i)
      if (!inner(i) && (i == 0 || !inner(i - 1)))
        for (int j = 0; j < 3; ++j) surface_mesh_.insert(sorted(faces_[i].nodes[j], faces_[i].nodes[(j + 1) % 3]));
  }

  int run() {
    for (std::size_t i = 0; i < around_.size();) {
      std::size_t end = i;
      while (end < around_.size() && around_[end].first == around_[i].first) ++end;
      take_out_edge(i, end);
      i = end;
    }
    for (std::size_t i = 0; i < faces_.size(); ++i)
      if (inner(i)) swap_face(faces_[i], faces_[i + 1]);
    std::size_t kept = 0;
    for (std::size_t t = 0; t < touched_.size(); ++t)
      if (!touched_[t]) mesh_.tets[kept++] = mesh_.tets[t];
    mesh_.tets.resize(kept);
    mesh_.tets.insert(mesh_.tets.end(), fresh_.begin(), fresh_.end());
    mesh_.regions.assign(mesh_.tets.size(), 1);
    return edits_;
  }

 private:
  struct Face {
    Triangle key, nodes;
    int tet;
  };
  /// Whether faces i and i+1 of the sorted list are the two sides of one face.
  bool inner(std::size_t i) const { return i + 1 < faces_.size() && faces_[i].key == faces_[i + 1].key; }

  double quality(const Tet& k) const {
    return options_.quality(mesh_.nodes[k[0]], mesh_.nodes[k[1]], mesh_.nodes[k[2]], mesh_.nodes[k[3]]);
  }
  double worst(const std::vector<int>& tets) const {
    double least = std::numeric_limits<double>::infinity();
    for (const int t : tets) least = std::min(least, quality(mesh_.tets[t]));
    return least;
  }

  bool exists(int a, int b) const {
    const auto found = std::ranges::lower_bound(around_, std::pair{sorted(a, b), 0});
    return (found != around_.end() && found->first == sorted(a, b)) || made_.contains(sorted(a, b));
  }

  void replace(const std::vector<int>& old, const std::vector<Tet>& by) {
    for (const int t : old) touched_[t] = 1;
    fresh_.insert(fresh_.end(), by.begin(), by.end());
    for (const Tet& k : by)
      for (int i = 0; i < 4; ++i)
        for (int j = i + 1; j < 4; ++j) made_.insert(sorted(k[i], k[j]));
    ++edits_;
  }

  /// Chains the tetrahedra of around_[begin, end); empty tets when they are no single fan or already edited.
  Ring ring_of(std::size_t begin, std::size_t end) const {
    Ring ring{around_[begin].first.first, around_[begin].first.second, {}, {}, false};
    std::vector<std::array<int, 3>> links;  // from, to, tetrahedron
    for (std::size_t i = begin; i < end; ++i) {
      const int t = around_[i].second;
      if (touched_[t]) return ring;
      std::vector<int> across;
      for (const int n : mesh_.tets[t])
        if (n != ring.a && n != ring.b) across.push_back(n);
      const auto& x = mesh_.nodes;
      if (signed_volume(x[ring.a], x[ring.b], x[across[0]], x[across[1]]) < 0) std::swap(across[0], across[1]);
      links.push_back({across[0], across[1], t});
    }
    int start = links[0][0];
    for (const auto& link : links)
      if (std::ranges::none_of(links, [&](const auto& other) { return other[1] == link[0]; })) start = link[0];
    ring.polygon.push_back(start);
    while (ring.tets.size() < links.size()) {
      const auto next = std::ranges::find_if(links, [&](const auto& link) { return link[0] == ring.polygon.back(); });
      if (next == links.end()) return {ring.a, ring.b, {}, {}, false};
      ring.tets.push_back((*next)[2]);
      ring.polygon.push_back((*next)[1]);
    }
    ring.closed = ring.polygon.front() == ring.polygon.back();
    if (ring.closed) ring.polygon.pop_back();
    return ring;
  }

  /// The triangulation of the ring's polygon whose worst tetrahedron is best.
  double fill_polygon(const Ring& ring, std::vector<Tet>& tets) const {
    const auto& p = ring.polygon;
    const int n = int(p.size());
    std::vector<std::vector<double>> best(n, std::vector<double>(n, std::numeric_limits<double>::infinity()));
    std::vector<std::vector<int>> apex(n, std::vector<int>(n, -1));
    const auto pair_at = [&](int i, int k, int j) {
      return std::array<Tet, 2>{Tet{p[i], p[k], p[j], ring.b}, Tet{p[k], p[i], p[j], ring.a}};
    };
    for (int width = 2; width < n; ++width)
      for (int i = 0; i + width < n; ++i) {
        const int j = i + width;
        best[i][j] = -2;
        for (int k = i + 1; k < j; ++k) {
          const auto [up, down] = pair_at(i, k, j);
          const double value = std::min({quality(up), quality(down), best[i][k], best[k][j]});
          if (value > best[i][j]) best[i][j] = value, apex[i][j] = k;
        }
      }
    std::vector<Pair> open{{0, n - 1}};
    while (!open.empty()) {
      const auto [i, j] = open.back();
      open.pop_back();
      if (apex[i][j] < 0) continue;
      for (const Tet& tet : pair_at(i, apex[i][j], j)) tets.push_back(tet);
      open.push_back({i, apex[i][j]});
      open.push_back({apex[i][j], j});
    }
    return best[0][n - 1];
  }

  /// Whether the surface may pass over the ends of an open ring's polygon instead of over its edge.
  bool may_swap_surface(const Ring& ring) const {
    const int p = ring.polygon.front(), q = ring.polygon.back();
    if (surface_mesh_.contains(sorted(p, q)) || (ring.tets.size() > 1 && exists(p, q))) return false;
    const auto normal = [&](int i, int j, int k) {
      const auto& x = mesh_.nodes;
      return (x[j] - x[i]).cross(x[k] - x[i]).normalized().eval();
    };
    const Vec3 old1 = normal(ring.a, p, ring.b), old2 = normal(ring.b, q, ring.a);
    const Vec3 new1 = normal(ring.a, p, q), new2 = normal(ring.b, q, p);
    return std::min({old1.dot(old2), old1.dot(new1), old1.dot(new2), old2.dot(new1), old2.dot(new2)}) > options_.bend;
  }

  void take_out_edge(std::size_t begin, std::size_t end) {
    const Ring ring = ring_of(begin, end);
    if (ring.tets.empty() || ring.polygon.size() > 9) return;
    if (ring.closed ? surface_mesh_.contains(sorted(ring.a, ring.b)) : !may_swap_surface(ring)) return;
    const double before = worst(ring.tets);
    std::vector<Tet> tets;
    const double after = ring.polygon.size() > 2 ? fill_polygon(ring, tets) : 1;
    const bool fewer = tets.size() < ring.tets.size() && after > options_.enough;
    if (!fewer && !(after > before + 1e-6 && before < options_.enough)) return;
    if (std::ranges::any_of(tets, [&](const Tet& k) { return diagonal_exists(ring, k); })) return;
    if (!ring.closed) {
      surface_mesh_.erase(sorted(ring.a, ring.b));
      surface_mesh_.insert(sorted(ring.polygon.front(), ring.polygon.back()));
    }
    replace(ring.tets, tets);
  }

  /// Whether a new tetrahedron would bring a second copy of an edge that is elsewhere already.
  bool diagonal_exists(const Ring& ring, const Tet& k) const {
    const auto place = [&](int n) { return int(std::ranges::find(ring.polygon, n) - ring.polygon.begin()); };
    for (int i = 0; i < 3; ++i) {
      const int p = k[i], q = k[(i + 1) % 3], gap = std::abs(place(p) - place(q)), n = int(ring.polygon.size());
      if (gap != 1 && !(ring.closed && gap == n - 1) && exists(p, q)) return true;
    }
    return false;
  }

  /// Two tetrahedra on either side of a face become three round the line that joins their far nodes.
  void swap_face(const Face& one, const Face& two) {
    if (touched_[one.tet] || touched_[two.tet]) return;
    const auto far = [&](const Face& f) {
      return *std::ranges::find_if(mesh_.tets[f.tet], [&](int n) { return std::ranges::count(f.nodes, n) == 0; });
    };
    const double before = worst({one.tet, two.tet});
    if (before > options_.enough) return;
    const int a = far(one), b = far(two);  // one.nodes point out of `one`, towards b
    if (exists(a, b)) return;
    std::vector<Tet> tets;
    double after = 1;
    for (int i = 0; i < 3; ++i) {
      tets.push_back({a, b, one.nodes[i], one.nodes[(i + 1) % 3]});
      after = std::min(after, quality(tets.back()));
    }
    if (after > before + 1e-6) replace({one.tet, two.tet}, tets);
  }

  TetMesh& mesh_;
  const Reconnect options_;
  std::vector<char> touched_;
  std::vector<std::pair<Pair, int>> around_;  ///< (edge, tetrahedron), sorted
  std::vector<Face> faces_;                   ///< sorted by key: the two sides of a face are neighbours
  std::set<Pair> surface_mesh_;               ///< edges of the surface
  std::set<Pair> made_;                       ///< edges of the new tetrahedra
  std::vector<Tet> fresh_;
  int edits_ = 0;
};

}  // namespace

int reconnect(TetMesh& mesh, const Reconnect& options) { return Sweep(mesh, options).run(); }

}  // namespace heml::make
