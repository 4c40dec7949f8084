#include <algorithm>
#include <heml/mesh/cut_split.hpp>
#include <heml/mesh/faces.hpp>
#include <heml/mesh/quality.hpp>
#include <map>

namespace heml {
namespace {

constexpr double thin = 10;  // degrees; pieces with a smaller dihedral angle are avoided

using Edge = std::pair<int, int>;  // lower number first

Edge edge_of(const Tet& tet, const std::array<std::size_t, 2>& local) {
  const int a = tet[local[0]], b = tet[local[1]];
  return {std::min(a, b), std::max(a, b)};
}

/// The intersection of the sweep with an edge.
struct Crossing {
  double where;   ///< 0 at the edge's first node, 1 at its second
  int node = -1;  ///< new node there; −1: snapped to an end

  int end(const Edge& edge) const { return where < 0.5 ? edge.first : edge.second; }  ///< nearer end
  /// Distance to the nearer end at rest, m.
  double to_end(const TetMesh& mesh, const Edge& edge) const {
    const Vec3& a = mesh.nodes[static_cast<std::size_t>(edge.first)];
    return std::min(where, 1 - where) * (mesh.nodes[static_cast<std::size_t>(edge.second)] - a).norm();
  }
};

class Splitter {
 public:
  Splitter(const SweptSurface& surface, const TetMesh& mesh, const std::vector<Vec3>& x, const Topology& topology,
           SplitElements& out)
      : surface_(surface), mesh_(mesh), topology_(topology), out_(out) {
    out_.x = x;
    out_.in_cut.assign(mesh.nodes.size(), false);
    out_.side.assign(mesh.nodes.size(), 0);
  }

  /// Returns false if the sweep crosses no edge.
  bool find_crossings(double snap, const Stroke& stroke) {
    std::vector<int> side_before(mesh_.nodes.size(), 0);
    std::vector<bool> in_cut_before(mesh_.nodes.size(), false);
    for (const auto& [n, is_upper] : stroke.sides) side_before[static_cast<std::size_t>(n)] = is_upper ? 1 : -1;
    for (const int n : stroke.nodes) in_cut_before[static_cast<std::size_t>(n)] = true;
    // An edge that ends in the cut of the sweeps before was crossed then, near that end. Crossed back, where the tissue
    // has moved and the surface folds, it has both its ends on one side.
    const auto is_crossed_back = [&](const Edge& edge, bool from_top) {
      const auto a = static_cast<std::size_t>(edge.first), b = static_cast<std::size_t>(edge.second);
      const int now = from_top ? 1 : -1;
      return (in_cut_before[a] || in_cut_before[b]) && side_before[a] == -now && side_before[b] == now;
    };
    for (const int t : topology_.elements) {
      const Tet& tet = mesh_.tets[static_cast<std::size_t>(t)];
      Eigen::AlignedBox3d box;
      for (const int n : tet) box.extend(at(n));
      if (!box.intersects(surface_.box())) continue;
      for (const auto& local : tet_edges) {
        const Edge edge = edge_of(tet, local);
        if (crossings_.contains(edge)) continue;
        const auto crossing = surface_.crossing(at(edge.first), at(edge.second));
        if (!crossing || is_crossed_back(edge, crossing->from_top)) continue;
        crossings_[edge] = {crossing->where, -1};
        set_side(edge.first, crossing->from_top);
        set_side(edge.second, !crossing->from_top);
      }
    }
    for (const auto& [edge, crossing] : crossings_)
      if (crossing.to_end(mesh_, edge) < 0.4 * snap) add_to_cut(crossing.end(edge));
    for (const auto& [n, is_upper] : stroke.sides) set_side(n, is_upper);
    out_.in_cut_by_sweep = out_.in_cut;
    for (const int n : stroke.nodes) add_to_cut(n);
    return !crossings_.empty();
  }

  /// Repeats the split with more crossings snapped while there are pieces thinner than `thin` and their parent.
  void split(double snap) {
    do {
      halve_edges();
      split_elements();
    } while (snap_thin_pieces(snap));
  }

 private:
  const Vec3& at(int n) const { return out_.at(n); }
  const Vec3& rest(int n) const { return mesh_.nodes[static_cast<std::size_t>(n)]; }
  bool is_in_cut(int n) const { return out_.is_in_cut(n); }
  void add_to_cut(int n) { out_.in_cut[static_cast<std::size_t>(n)] = true; }
  /// Of several sides the first counts, so the sides of this sweep come before those of the sweeps before.
  void set_side(int n, bool is_upper) {
    int& side = out_.side[static_cast<std::size_t>(n)];
    if (side == 0) side = is_upper ? 1 : -1;
  }

  /// Recreates the new nodes: one on each crossed edge with both ends outside the cut.
  void halve_edges() {
    out_.x.resize(mesh_.nodes.size());
    out_.in_cut.resize(out_.x.size());
    out_.in_cut_by_sweep.resize(out_.x.size());
    out_.nodes.clear();
    for (auto& [edge, crossing] : crossings_) {
      crossing.node = -1;
      if (is_in_cut(edge.first) || is_in_cut(edge.second)) continue;
      crossing.node = static_cast<int>(out_.x.size());
      out_.nodes.push_back({edge.first, edge.second, crossing.where});
      out_.x.push_back(at(edge.first) + crossing.where * (at(edge.second) - at(edge.first)));
      out_.in_cut.push_back(true);
      out_.in_cut_by_sweep.push_back(true);
    }
  }

  /// Recreates the pieces: the elements with a node in the cut, split at their new nodes.
  void split_elements() {
    out_.pieces.clear();
    std::vector<char> is_end(mesh_.nodes.size(), 0);  // of a crossed edge: to skip most elements quickly
    for (const auto& [edge, crossing] : crossings_)
      for (const int n : {edge.first, edge.second}) is_end[static_cast<std::size_t>(n)] = 1;
    for (const int t : topology_.elements) {
      const Tet& tet = mesh_.tets[static_cast<std::size_t>(t)];
      if (std::none_of(tet.begin(), tet.end(),
                       [&](int n) { return is_end[static_cast<std::size_t>(n)] || is_in_cut(n); }))
        continue;
      std::vector<std::pair<Edge, int>> halved;
      for (const auto& local : tet_edges)
        if (const auto found = crossings_.find(edge_of(tet, local));
            found != crossings_.end() && found->second.node >= 0)
          halved.emplace_back(found->first, found->second.node);
      if (halved.empty() && std::none_of(tet.begin(), tet.end(), [this](int n) { return is_in_cut(n); })) continue;
      std::sort(halved.begin(), halved.end());
      const std::size_t first = out_.pieces.size();
      out_.pieces.push_back({tet, t});
      out_.pieces.back().is_new = !halved.empty();
      for (const auto& [edge, middle] : halved) halve(first, edge, middle);
    }
  }

  /// Snaps the crossing nearest to an end in every thin piece. Returns false if no crossing could be snapped.
  bool snap_thin_pieces(double snap) {
    std::vector<int> snapped;
    for (const CutPiece& piece : out_.pieces) {
      if (!piece.is_new) continue;
      const double angle = min_angle(piece.tet);
      if (angle >= thin || angle >= min_angle(mesh_.tets[static_cast<std::size_t>(piece.parent)])) continue;
      int end = -1;
      double nearest = snap;
      for (const int n : piece.tet) {
        if (n < static_cast<int>(mesh_.nodes.size())) continue;
        const InsertedNode& node = out_.nodes[static_cast<std::size_t>(n) - mesh_.nodes.size()];
        const Crossing& crossing = crossings_.at({node.from, node.to});
        const double distance = crossing.to_end(mesh_, {node.from, node.to});
        if (distance >= nearest) continue;
        nearest = distance;
        end = crossing.end({node.from, node.to});
      }
      if (end >= 0) snapped.push_back(end);
    }
    for (const int n : snapped) {
      add_to_cut(n);
      out_.in_cut_by_sweep[static_cast<std::size_t>(n)] = true;
    }
    return !snapped.empty();
  }

  /// Smallest dihedral angle of a piece at rest, degrees.
  double min_angle(const Tet& tet) const {
    std::array<Vec3, 4> X;
    for (std::size_t a = 0; a < 4; ++a) {
      const auto n = static_cast<std::size_t>(tet[a]);
      if (n < mesh_.nodes.size()) {
        X[a] = mesh_.nodes[n];
      } else {
        const InsertedNode& node = out_.nodes[n - mesh_.nodes.size()];
        X[a] = rest(node.from) + node.weight * (rest(node.to) - rest(node.from));
      }
    }
    return min_dihedral(X);
  }

  /// Splits the pieces from index `first` on that contain the edge.
  void halve(std::size_t first, const Edge& edge, int middle) {
    for (std::size_t p = first, end = out_.pieces.size(); p < end; ++p) {
      Tet& tet = out_.pieces[p].tet;
      const auto a = std::find(tet.begin(), tet.end(), edge.first), b = std::find(tet.begin(), tet.end(), edge.second);
      if (a == tet.end() || b == tet.end()) continue;
      CutPiece other = out_.pieces[p];
      *b = middle;
      other.tet[static_cast<std::size_t>(a - tet.begin())] = middle;
      out_.pieces.push_back(other);
    }
  }

  const SweptSurface& surface_;
  const TetMesh& mesh_;
  const Topology& topology_;
  std::map<Edge, Crossing> crossings_;
  SplitElements& out_;
};

}  // namespace

std::optional<SplitElements> split_elements(const SweptSurface& surface, const TetMesh& mesh,
                                            const std::vector<Vec3>& x, const Topology& topology, double snap,
                                            const Stroke& stroke) {
  SplitElements out;
  Splitter splitter(surface, mesh, x, topology, out);
  if (!splitter.find_crossings(snap, stroke)) return std::nullopt;
  splitter.split(snap);
  return out;
}

double snapping_distance(const TetMesh& mesh) {
  double sum = 0;
  for (const Tet& tet : mesh.tets)
    for (const auto& local : tet_edges) {
      const auto [a, b] = edge_of(tet, local);
      sum += (mesh.nodes[static_cast<std::size_t>(b)] - mesh.nodes[static_cast<std::size_t>(a)]).norm();
    }
  return 0.5 * sum / static_cast<double>(6 * mesh.tets.size());
}

}  // namespace heml
