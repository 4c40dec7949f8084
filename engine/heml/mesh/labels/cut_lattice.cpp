#include <algorithm>
#include <cmath>
#include <heml/mesh/labels/cut_lattice.hpp>
#include <limits>
#include <span>
#include <utility>

namespace heml {
namespace {

// How near to a node an interface may cut an edge, of its length, before the node is moved there: for the lattice's
// long and short edges. Labelle & Shewchuk's values, with which two labels leave no bad angle.
constexpr double near_on_long = 0.24999, near_on_short = 0.41189;
constexpr double min_volume = 0.05;  // of an element of finest cells, that moving a node leaves
constexpr int root_steps = 14;

struct CutEdge {
  std::array<int, 2> ends;
  double length;
  double at;      ///< of the length, from the first end
  int node = -1;  ///< of the mesh, where the edge is bisected
};

class LatticeCutter {
 public:
  LatticeCutter(Lattice lattice, const RegionField& field) : lattice_(std::move(lattice)), field_(field) {}

  TetMesh cut() {
    find_cut_edges();
    is_moved_.assign(lattice_.nodes.size(), 0);
    snap_nodes();
    add_cut_nodes();
    for (const Tet& tet : lattice_.tets) split(tet);
    mesh_.nodes = std::move(lattice_.nodes);
    return std::move(mesh_);
  }

 private:
  bool joins_labels(int a, int b) const { return lattice_.labels[a] != lattice_.labels[b]; }

  void find_cut_edges() {
    std::vector<std::array<int, 2>> edges;
    for (const Tet& tet : lattice_.tets)
      for (const auto& [i, j] : tet_edges)
        if (joins_labels(tet[i], tet[j])) edges.push_back({std::min(tet[i], tet[j]), std::max(tet[i], tet[j])});
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    for (const auto& [a, b] : edges) {
      const Vec3 &from = lattice_.nodes[a], &to = lattice_.nodes[b];
      edges_.push_back({{a, b}, (to - from).norm(), root(lattice_.labels[a], lattice_.labels[b], from, to)});
    }
    edges_of_node_.resize(lattice_.nodes.size());
    for (std::size_t e = 0; e < edges_.size(); ++e)
      for (const int n : edges_[e].ends) edges_of_node_[n].push_back(static_cast<int>(e));
    tets_of_node_.resize(lattice_.nodes.size());
    for (std::size_t t = 0; t < lattice_.tets.size(); ++t)
      for (const int n : lattice_.tets[t])
        if (!edges_of_node_[n].empty()) tets_of_node_[n].push_back(static_cast<int>(t));
  }

  /// Where two labels weigh the same between a point of the first and one of the second. Illinois' method.
  double root(int a, int b, const Vec3& from, const Vec3& to) const {
    double low = 0, high = 1;
    double at_low = field_.difference(a, b, from), at_high = field_.difference(a, b, to);
    if (!(at_low > 0)) return 0;
    if (!(at_high < 0)) return 1;
    double at = 0.5;
    for (int step = 0; step < root_steps && high - low > 1e-4; ++step) {
      at = std::clamp(low + (high - low) * at_low / (at_low - at_high), low + 0.05 * (high - low),
                      high - 0.05 * (high - low));
      const double value = field_.difference(a, b, from + at * (to - from));
      if (value > 0) {
        low = at;
        at_low = value;
        at_high *= 0.5;
      } else {
        high = at;
        at_high = value;
        at_low *= 0.5;
      }
    }
    return 0.5 * (low + high);
  }

  Vec3 cut_point(const CutEdge& edge) const {
    const Vec3 &from = lattice_.nodes[edge.ends[0]], &to = lattice_.nodes[edge.ends[1]];
    return from + edge.at * (to - from);
  }
  bool is_open(const CutEdge& edge) const { return !is_moved_[edge.ends[0]] && !is_moved_[edge.ends[1]]; }

  /// Moves nodes to the nearest interface that cuts an edge too near to them, in the order of their numbers.
  void snap_nodes() {
    const double volume = min_volume * std::pow(lattice_.cell, 3) / 12;
    for (int n = 0; n < static_cast<int>(lattice_.nodes.size()); ++n) {
      double nearest = std::numeric_limits<double>::infinity();
      Vec3 target = Vec3::Zero();
      for (const int e : edges_of_node_[n]) {
        const CutEdge& edge = edges_[e];
        if (!is_open(edge)) continue;
        const double share = edge.ends[0] == n ? edge.at : 1 - edge.at;
        const bool is_long = edge.length > 0.95 * lattice_.cell;
        if (share > (is_long ? near_on_long : near_on_short) || share * edge.length >= nearest) continue;
        nearest = share * edge.length;
        target = cut_point(edge);
      }
      if (std::isinf(nearest)) continue;
      const Vec3 before = std::exchange(lattice_.nodes[n], target);
      if (is_worse_than(tets_of_node_[n], volume))
        lattice_.nodes[n] = before;
      else
        is_moved_[n] = 1;
    }
  }

  double volume_of(const Tet& tet) const {
    return signed_volume(lattice_.nodes[tet[0]], lattice_.nodes[tet[1]], lattice_.nodes[tet[2]],
                         lattice_.nodes[tet[3]]);
  }
  bool is_worse_than(const std::vector<int>& tets, double volume) const {
    return std::any_of(tets.begin(), tets.end(), [&](int t) { return volume_of(lattice_.tets[t]) < volume; });
  }

  /// Long edges first: their halves make the shorter diagonals.
  void add_cut_nodes() {
    std::erase_if(edges_, [&](const CutEdge& edge) { return !is_open(edge); });
    for (CutEdge& edge : edges_) {
      edge.node = static_cast<int>(lattice_.nodes.size());
      edge.at = std::clamp(edge.at, 0.02, 0.98);
      const Vec3 x = cut_point(edge);
      lattice_.nodes.push_back(x);
    }
    is_moved_.resize(lattice_.nodes.size(), 1);
    lattice_.labels.resize(lattice_.nodes.size(), 0);
  }

  const CutEdge* cut_between(int a, int b) const {
    const std::array<int, 2> ends{std::min(a, b), std::max(a, b)};
    const auto found = std::lower_bound(edges_.begin(), edges_.end(), ends,
                                        [](const CutEdge& edge, const auto& key) { return edge.ends < key; });
    return found != edges_.end() && found->ends == ends ? &*found : nullptr;
  }

  /// Bisects an element at its cut edges, in one order for all elements.
  void split(const Tet& whole) {
    std::vector<const CutEdge*> cuts;
    for (const auto& [i, j] : tet_edges)
      if (!is_moved_[whole[i]] && !is_moved_[whole[j]] && joins_labels(whole[i], whole[j]))
        if (const CutEdge* edge = cut_between(whole[i], whole[j])) cuts.push_back(edge);
    std::sort(cuts.begin(), cuts.end(), [&](const CutEdge* a, const CutEdge* b) {
      const bool long_a = a->length > 0.95 * lattice_.cell, long_b = b->length > 0.95 * lattice_.cell;
      return long_a != long_b ? long_a : a->ends < b->ends;
    });
    pieces_.assign(1, whole);
    for (const CutEdge* cut : cuts)
      for (std::size_t k = 0, count = pieces_.size(); k < count; ++k) {
        const auto first = std::find(pieces_[k].begin(), pieces_[k].end(), cut->ends[0]);
        const auto second = std::find(pieces_[k].begin(), pieces_[k].end(), cut->ends[1]);
        if (first == pieces_[k].end() || second == pieces_[k].end()) continue;
        Tet other = pieces_[k];
        other[static_cast<std::size_t>(first - pieces_[k].begin())] = cut->node;
        *second = cut->node;
        pieces_.push_back(other);
      }
    for (const Tet& piece : pieces_)
      if (const int label = label_of(piece); label > 0) {
        mesh_.tets.push_back(piece);
        mesh_.regions.push_back(label);
      }
  }

  /// That of its nodes off the interfaces, which have the same; else of its middle.
  int label_of(const Tet& piece) const {
    Vec3 middle = Vec3::Zero();
    for (const int n : piece) {
      if (!is_moved_[n]) return lattice_.labels[n];
      middle += lattice_.nodes[n] / 4;
    }
    return field_.label_at(middle);
  }

  Lattice lattice_;
  const RegionField& field_;
  std::vector<CutEdge> edges_;  ///< ascending by ends
  std::vector<std::vector<int>> edges_of_node_, tets_of_node_;
  std::vector<char> is_moved_;  ///< nodes on an interface
  std::vector<Tet> pieces_;
  TetMesh mesh_;
};

}  // namespace

TetMesh cut_lattice(Lattice lattice, const RegionField& field) {
  return LatticeCutter(std::move(lattice), field).cut();
}

}  // namespace heml
