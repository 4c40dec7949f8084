#include <algorithm>
#include <heml/mesh/cut.hpp>
#include <heml/mesh/faces.hpp>
#include <heml/mesh/quality.hpp>
#include <map>
#include <numeric>

namespace heml {
namespace {

constexpr double thin = 10;  // degrees; pieces with a smaller dihedral angle are avoided

using Edge = std::pair<int, int>;  // lower number first

Edge edge_of(const Tet& tet, const std::array<std::size_t, 2>& local) {
  const int a = tet[local[0]], b = tet[local[1]];
  return {std::min(a, b), std::max(a, b)};
}

/// An element, or a part of a split one, that has a node in the cut.
struct Piece {
  Tet tet;                                       ///< nodes before copies are made
  int parent;                                    ///< element
  std::array<int, 4> neighbour{-1, -1, -1, -1};  ///< piece across each face; −1: none
  std::array<bool, 4> separated{};               ///< separated from that neighbour
  bool is_new = false;                           ///< its parent was split
};

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

class Cutter {
 public:
  Cutter(const SweptSurface& surface, const TetMesh& mesh, const std::vector<Vec3>& x, const Topology& topology)
      : surface_(surface),
        mesh_(mesh),
        x_(x),
        topology_(topology),
        in_cut_(mesh.nodes.size(), false),
        side_(mesh.nodes.size(), 0) {}

  /// Step 1. Returns false if the sweep crosses no edge.
  bool find_crossings(double snap, const Stroke& stroke) {
    for (const int t : topology_.elements) {
      const Tet& tet = mesh_.tets[static_cast<std::size_t>(t)];
      Eigen::AlignedBox3d box;
      for (const int n : tet) box.extend(at(n));
      if (!box.intersects(surface_.box())) continue;
      for (const auto& local : tet_edges) {
        const Edge edge = edge_of(tet, local);
        if (crossings_.contains(edge)) continue;
        const auto crossing = surface_.crossing(at(edge.first), at(edge.second));
        if (!crossing) continue;
        crossings_[edge] = {crossing->where, -1};
        set_side(edge.first, crossing->from_top);
        set_side(edge.second, !crossing->from_top);
      }
    }
    for (const auto& [edge, crossing] : crossings_)
      if (crossing.to_end(mesh_, edge) < 0.4 * snap) add_to_cut(crossing.end(edge));
    for (const auto& [n, is_upper] : stroke.sides) set_side(n, is_upper);
    newly_in_cut_ = in_cut_;
    for (const int n : stroke.nodes) add_to_cut(n);
    return !crossings_.empty();
  }

  /// Step 2. Repeats the split with more crossings snapped while there are pieces thinner than `thin` and their parent.
  void split(double snap) {
    do {
      halve_edges();
      split_elements();
    } while (snap_thin_pieces(snap));
  }

  /// Step 3. closed: Stroke::closed of the sweeps before.
  void separate(const std::vector<std::array<int, 3>>& closed) {
    match_faces();
    for (Piece& piece : pieces_)
      for (std::size_t f = 0; f < 4; ++f) {
        const int other = piece.neighbour[f];
        if (other < 0 || &piece > &pieces_[static_cast<std::size_t>(other)]) continue;
        if (!is_separated(piece, f) && !std::binary_search(closed.begin(), closed.end(), sorted(face(piece, f))))
          continue;
        set_separated(piece, f, true);
      }
    join_crumbs();
    copy_nodes();
  }

  void write(Cut& cut) {
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
      const Piece& piece = pieces_[p];
      if (!piece.is_new && final_[p] == piece.tet) continue;
      if (cut.edit.removed.empty() || cut.edit.removed.back() != piece.parent) cut.edit.removed.push_back(piece.parent);
      cut.edit.added.push_back(final_[p]);
      cut.edit.parents.push_back(piece.parent);
    }
    cut.edit.nodes = std::move(new_nodes_);
    for (std::size_t n = 0; n < in_cut_.size(); ++n)
      if (in_cut_[n]) cut.stroke.nodes.push_back(static_cast<int>(n));
    write_faces(cut);
    std::vector<bool> was_copied(side_.size(), false);
    for (const InsertedNode& node : cut.edit.nodes)
      if (node.from == node.to) was_copied[static_cast<std::size_t>(node.from)] = true;
    for (std::size_t n = 0; n < side_.size(); ++n)
      if (side_[n] != 0 && !was_copied[n]) cut.stroke.sides.emplace_back(static_cast<int>(n), side_[n] > 0);
    cut.stroke.normal = surface_.last_normal();
  }

 private:
  const Vec3& at(int n) const { return x_[static_cast<std::size_t>(n)]; }
  const Vec3& rest(int n) const { return mesh_.nodes[static_cast<std::size_t>(n)]; }
  bool is_in_cut(int n) const { return in_cut_[static_cast<std::size_t>(n)]; }
  void add_to_cut(int n) { in_cut_[static_cast<std::size_t>(n)] = true; }
  /// Of several sides the first counts, so the sides of this sweep come before those of the sweeps before.
  void set_side(int n, bool is_upper) {
    int& side = side_[static_cast<std::size_t>(n)];
    if (side == 0) side = is_upper ? 1 : -1;
  }

  static std::array<int, 3> face(const Piece& piece, std::size_t f) {
    std::array<int, 3> nodes;
    for (std::size_t k = 0; k < 3; ++k) nodes[k] = piece.tet[static_cast<std::size_t>(tet_faces[f][k])];
    return nodes;
  }

  static std::array<int, 3> sorted(std::array<int, 3> nodes) {
    std::sort(nodes.begin(), nodes.end());
    return nodes;
  }

  void set_separated(Piece& piece, std::size_t f, bool value) {
    Piece& neighbour = pieces_[static_cast<std::size_t>(piece.neighbour[f])];
    piece.separated[f] = neighbour.separated[facing(neighbour, &piece)] = value;
  }

  /// Joins each group of connected pieces that has no node outside the cut, so belongs to neither side of it, to the
  /// neighbour across its largest face.
  void join_crumbs() {
    std::vector<int> group;
    for (std::size_t p = 0; p < pieces_.size(); ++p)
      for (bool joined = true; joined && is_all_in_cut(p);) {
        joined = false;
        if (!is_crumb(static_cast<int>(p), group)) break;
        Piece* largest = nullptr;
        std::size_t largest_face = 0;
        double area = 0;
        for (const int member : group)
          for (std::size_t f = 0; f < 4; ++f) {
            Piece& piece = pieces_[static_cast<std::size_t>(member)];
            if (!piece.separated[f] || std::find(group.begin(), group.end(), piece.neighbour[f]) != group.end())
              continue;
            if (face_area(piece, f) <= area) continue;
            area = face_area(piece, f);
            largest = &piece;
            largest_face = f;
          }
        if (!largest) break;
        set_separated(*largest, largest_face, false);
        joined = true;
      }
  }

  bool is_all_in_cut(std::size_t p) const {
    const Tet& tet = pieces_[p].tet;
    return std::all_of(tet.begin(), tet.end(), [this](int n) { return is_in_cut(n); });
  }

  /// Collects the pieces connected to one. Returns false at the first that has a node outside the cut.
  bool is_crumb(int piece, std::vector<int>& group) const {
    group = {piece};
    for (std::size_t k = 0; k < group.size(); ++k) {
      const auto member = static_cast<std::size_t>(group[k]);
      if (!is_all_in_cut(member)) return false;
      for (std::size_t f = 0; f < 4; ++f) {
        const int other = pieces_[member].neighbour[f];
        if (other >= 0 && !pieces_[member].separated[f] && std::find(group.begin(), group.end(), other) == group.end())
          group.push_back(other);
      }
    }
    return true;
  }

  double face_area(const Piece& piece, std::size_t f) const {
    const auto [a, b, c] = face(piece, f);
    return (at(b) - at(a)).cross(at(c) - at(a)).norm() / 2;
  }

  /// Adds up the area of the faces that came apart, and lists those that are still closed.
  void write_faces(Cut& cut) const {
    for (std::size_t p = 0; p < pieces_.size(); ++p)
      for (std::size_t f = 0; f < 4; ++f) {
        const Piece& piece = pieces_[p];
        if (!piece.separated[f] || piece.neighbour[f] < static_cast<int>(p)) continue;
        const auto other = static_cast<std::size_t>(piece.neighbour[f]);
        const auto nodes = sorted(face({final_[p], 0}, f)),
                   others = sorted(face({final_[other], 0}, facing(pieces_[other], &piece)));
        if (nodes == others)
          cut.stroke.closed.push_back(nodes);
        else
          cut.area += face_area(piece, f);
      }
    std::sort(cut.stroke.closed.begin(), cut.stroke.closed.end());
  }

  std::size_t facing(const Piece& piece, const Piece* to) const {
    const auto number = static_cast<int>(to - pieces_.data());
    return static_cast<std::size_t>(std::find(piece.neighbour.begin(), piece.neighbour.end(), number) -
                                    piece.neighbour.begin());
  }

  /// Recreates the new nodes: one on each crossed edge with both ends outside the cut.
  void halve_edges() {
    x_.resize(mesh_.nodes.size());
    in_cut_.resize(x_.size());
    newly_in_cut_.resize(x_.size());
    new_nodes_.clear();
    for (auto& [edge, crossing] : crossings_) {
      crossing.node = -1;
      if (is_in_cut(edge.first) || is_in_cut(edge.second)) continue;
      crossing.node = static_cast<int>(x_.size());
      new_nodes_.push_back({edge.first, edge.second, crossing.where});
      x_.push_back(at(edge.first) + crossing.where * (at(edge.second) - at(edge.first)));
      in_cut_.push_back(true);
      newly_in_cut_.push_back(true);
    }
  }

  /// Recreates the pieces: the elements with a node in the cut, split at their new nodes.
  void split_elements() {
    pieces_.clear();
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
      const std::size_t first = pieces_.size();
      pieces_.push_back({tet, t});
      pieces_.back().is_new = !halved.empty();
      for (const auto& [edge, middle] : halved) halve(first, edge, middle);
    }
  }

  /// Snaps the crossing nearest to an end in every thin piece. Returns false if no crossing could be snapped.
  bool snap_thin_pieces(double snap) {
    std::vector<int> snapped;
    for (const Piece& piece : pieces_) {
      if (!piece.is_new) continue;
      const double angle = min_angle(piece.tet);
      if (angle >= thin || angle >= min_angle(mesh_.tets[static_cast<std::size_t>(piece.parent)])) continue;
      int end = -1;
      double nearest = snap;
      for (const int n : piece.tet) {
        if (n < static_cast<int>(mesh_.nodes.size())) continue;
        const InsertedNode& node = new_nodes_[static_cast<std::size_t>(n) - mesh_.nodes.size()];
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
      newly_in_cut_[static_cast<std::size_t>(n)] = true;
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
        const InsertedNode& node = new_nodes_[n - mesh_.nodes.size()];
        X[a] = rest(node.from) + node.weight * (rest(node.to) - rest(node.from));
      }
    }
    return min_dihedral(X);
  }

  /// Splits the pieces from index `first` on that contain the edge.
  void halve(std::size_t first, const Edge& edge, int middle) {
    for (std::size_t p = first, end = pieces_.size(); p < end; ++p) {
      Tet& tet = pieces_[p].tet;
      const auto a = std::find(tet.begin(), tet.end(), edge.first), b = std::find(tet.begin(), tet.end(), edge.second);
      if (a == tet.end() || b == tet.end()) continue;
      Piece other = pieces_[p];
      *b = middle;
      other.tet[static_cast<std::size_t>(a - tet.begin())] = middle;
      pieces_.push_back(other);
    }
  }

  void match_faces() {
    struct Side {
      std::array<int, 3> nodes;
      int piece;
      std::size_t face;
    };
    std::vector<Side> sides;
    for (std::size_t p = 0; p < pieces_.size(); ++p)
      for (std::size_t f = 0; f < 4; ++f) {
        sides.push_back({face(pieces_[p], f), static_cast<int>(p), f});
        std::sort(sides.back().nodes.begin(), sides.back().nodes.end());
      }
    std::sort(sides.begin(), sides.end(),
              [](const Side& a, const Side& b) { return std::tie(a.nodes, a.piece) < std::tie(b.nodes, b.piece); });
    for (std::size_t k = 1; k < sides.size(); ++k) {
      const Side &one = sides[k - 1], &two = sides[k];
      if (one.nodes != two.nodes) continue;
      pieces_[static_cast<std::size_t>(one.piece)].neighbour[one.face] = two.piece;
      pieces_[static_cast<std::size_t>(two.piece)].neighbour[two.face] = one.piece;
    }
  }

  /// Whether a face lies in the cut, with its two pieces on different sides. Where their nodes do not say, the plane of
  /// the sweep decides, unless all nodes of the face are of earlier sweeps of the stroke, which have decided about it.
  bool is_separated(const Piece& piece, std::size_t f) const {
    const std::array<int, 3> nodes = face(piece, f);
    if (!std::all_of(nodes.begin(), nodes.end(), [this](int n) { return is_in_cut(n); })) return false;
    const Piece& other = pieces_[static_cast<std::size_t>(piece.neighbour[f])];
    if (const int one = side(piece), two = side(other); one != 0 && two != 0) return one != two;
    if (std::none_of(nodes.begin(), nodes.end(), [this](int n) { return newly_in_cut_[static_cast<std::size_t>(n)]; }))
      return false;
    const auto nearest = surface_.nearest((at(nodes[0]) + at(nodes[1]) + at(nodes[2])) / 3);
    return is_above(piece, f, nearest) != is_above(other, facing(other, &piece), nearest);
  }

  /// 1: the piece is on the upper side of the cut, −1: on the lower, 0: its nodes do not say. Nodes outside the cut
  /// decide; without one, those that were snapped to it.
  int side(const Piece& piece) const {
    int sum = 0;
    for (const int n : piece.tet) {
      if (n >= static_cast<int>(side_.size())) continue;
      const int side = side_[static_cast<std::size_t>(n)];
      if (side != 0 && !is_in_cut(n)) return side;
      sum += side;
    }
    return (sum > 0) - (sum < 0);
  }

  /// The side of a piece: that of its node opposite the face; of its centroid if that node is in the cut.
  bool is_above(const Piece& piece, std::size_t f, const SweptSurface::Nearest& plane) const {
    Vec3 point = at(piece.tet[f]);
    if (is_in_cut(piece.tet[f]))
      point = (at(piece.tet[0]) + at(piece.tet[1]) + at(piece.tet[2]) + at(piece.tet[3])) / 4;
    return (point - plane.point).dot(plane.normal) > 0;
  }

  /// Copies each node in the cut for every group of connected pieces round it except the first.
  void copy_nodes() {
    final_.reserve(pieces_.size());
    for (const Piece& piece : pieces_) final_.push_back(piece.tet);
    std::vector<std::pair<int, int>> uses;  // node, piece
    for (std::size_t p = 0; p < pieces_.size(); ++p)
      for (const int n : pieces_[p].tet)
        if (is_in_cut(n)) uses.emplace_back(n, static_cast<int>(p));
    std::sort(uses.begin(), uses.end());
    for (auto begin = uses.begin(); begin != uses.end();) {
      const auto end = std::find_if(begin, uses.end(), [&](const auto& use) { return use.first != begin->first; });
      bool is_first = true;
      for (auto use = begin; use != end; ++use) {
        if (use->second < 0) continue;
        copy_for_group(use->first, std::span(begin, end), use->second, std::exchange(is_first, false));
      }
      begin = end;
    }
  }

  /// Gives the group of pieces connected to `piece` round a node a copy of the node, or the node itself (keeps_node).
  /// Marks them in `uses` by the piece −1.
  void copy_for_group(int node, std::span<std::pair<int, int>> uses, int piece, bool keeps_node) {
    int number = node;
    if (!keeps_node) {
      number = static_cast<int>(in_cut_.size());
      const auto known = static_cast<std::size_t>(node);
      new_nodes_.push_back(known < mesh_.nodes.size() ? InsertedNode{node, node, 0}
                                                      : new_nodes_[known - mesh_.nodes.size()]);
      in_cut_.push_back(true);
    }
    std::vector<int> reached{piece};
    const auto claim = [&](int p) {
      const auto use = std::find(uses.begin(), uses.end(), std::pair(node, p));
      if (use == uses.end()) return false;
      use->second = -1;
      return true;
    };
    claim(piece);
    for (std::size_t k = 0; k < reached.size(); ++k) {
      const Piece& at = pieces_[static_cast<std::size_t>(reached[k])];
      for (std::size_t f = 0; f < 4; ++f) {
        if (at.tet[f] == node)
          final_[static_cast<std::size_t>(reached[k])][f] = number;
        else if (at.neighbour[f] >= 0 && !at.separated[f] && claim(at.neighbour[f]))
          reached.push_back(at.neighbour[f]);
      }
    }
  }

  const SweptSurface& surface_;
  const TetMesh& mesh_;
  std::vector<Vec3> x_;  ///< deformed positions of old nodes and of new ones on crossed edges, m
  const Topology& topology_;
  std::vector<bool> in_cut_, newly_in_cut_;
  std::vector<int> side_;  ///< per old node: 1 on the upper side of the cut, −1 on the lower, 0 not beside it
  std::map<Edge, Crossing> crossings_;
  std::vector<InsertedNode> new_nodes_;
  std::vector<Piece> pieces_;
  std::vector<Tet> final_;  ///< nodes of each piece, copies included
};

}  // namespace

double snapping_distance(const TetMesh& mesh) {
  double sum = 0;
  for (const Tet& tet : mesh.tets)
    for (const auto& local : tet_edges) {
      const auto [a, b] = edge_of(tet, local);
      sum += (mesh.nodes[static_cast<std::size_t>(b)] - mesh.nodes[static_cast<std::size_t>(a)]).norm();
    }
  return 0.5 * sum / static_cast<double>(6 * mesh.tets.size());
}

Status make_cut(const Sweep& sweep, const TetMesh& mesh, const std::vector<Vec3>& x, const Topology& topology,
                double snap, const Stroke& stroke, Cut& cut) {
  const SweptSurface surface(stroke.front.join(sweep, x, snap), stroke.normal);
  if (surface.empty()) return "the blade sweeps no area; give its two ends at two or more moments, in different places";
  Cutter cutter(surface, mesh, x, topology);
  if (!cutter.find_crossings(snap, stroke)) return "the blade meets no edge of an element";
  cutter.split(snap);
  cut = {};
  cutter.separate(stroke.closed);
  cutter.write(cut);
  return {};
}

}  // namespace heml
