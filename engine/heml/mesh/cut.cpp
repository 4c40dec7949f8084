#include <algorithm>
#include <heml/mesh/cut.hpp>
#include <heml/mesh/cut_split.hpp>
#include <heml/mesh/faces.hpp>

namespace heml {
namespace {

/// Separates the pieces on either side of a cut: copies the nodes between them.
class Separator {
 public:
  Separator(const SweptSurface& surface, const TetMesh& mesh, SplitElements split)
      : surface_(surface), mesh_(mesh), split_(std::move(split)) {}

  /// closed: Stroke::closed of the sweeps before.
  void separate(const std::vector<std::array<int, 3>>& closed) {
    match_faces();
    for (CutPiece& piece : split_.pieces)
      for (std::size_t f = 0; f < 4; ++f) {
        const int other = piece.neighbour[f];
        if (other < 0 || &piece > &split_.pieces[static_cast<std::size_t>(other)]) continue;
        if (!is_separated(piece, f) && !std::binary_search(closed.begin(), closed.end(), sorted(face(piece, f))))
          continue;
        set_separated(piece, f, true);
      }
    join_crumbs();
    copy_nodes();
  }

  void write(Cut& cut) {
    for (std::size_t p = 0; p < split_.pieces.size(); ++p) {
      const CutPiece& piece = split_.pieces[p];
      if (!piece.is_new && final_[p] == piece.tet) continue;
      if (cut.edit.removed.empty() || cut.edit.removed.back() != piece.parent) cut.edit.removed.push_back(piece.parent);
      cut.edit.added.push_back(final_[p]);
      cut.edit.parents.push_back(piece.parent);
    }
    cut.edit.nodes = std::move(split_.nodes);
    for (std::size_t n = 0; n < split_.in_cut.size(); ++n)
      if (split_.in_cut[n]) cut.stroke.nodes.push_back(static_cast<int>(n));
    write_faces(cut);
    std::vector<bool> was_copied(split_.side.size(), false);
    for (const InsertedNode& node : cut.edit.nodes)
      if (node.from == node.to) was_copied[static_cast<std::size_t>(node.from)] = true;
    for (std::size_t n = 0; n < split_.side.size(); ++n)
      if (split_.side[n] != 0 && !was_copied[n]) cut.stroke.sides.emplace_back(static_cast<int>(n), split_.side[n] > 0);
  }

 private:
  const Vec3& at(int n) const { return split_.at(n); }
  bool is_in_cut(int n) const { return split_.is_in_cut(n); }

  static std::array<int, 3> face(const CutPiece& piece, std::size_t f) {
    std::array<int, 3> nodes;
    for (std::size_t k = 0; k < 3; ++k) nodes[k] = piece.tet[static_cast<std::size_t>(tet_faces[f][k])];
    return nodes;
  }

  static std::array<int, 3> sorted(std::array<int, 3> nodes) {
    std::sort(nodes.begin(), nodes.end());
    return nodes;
  }

  void set_separated(CutPiece& piece, std::size_t f, bool value) {
    CutPiece& neighbour = split_.pieces[static_cast<std::size_t>(piece.neighbour[f])];
    piece.separated[f] = neighbour.separated[facing(neighbour, &piece)] = value;
  }

  /// Joins each group of connected pieces that has no node outside the cut, so belongs to neither side of it, to the
  /// neighbour across its largest face.
  void join_crumbs() {
    std::vector<int> group;
    for (std::size_t p = 0; p < split_.pieces.size(); ++p)
      for (bool joined = true; joined && is_all_in_cut(p);) {
        joined = false;
        if (!is_crumb(static_cast<int>(p), group)) break;
        CutPiece* largest = nullptr;
        std::size_t largest_face = 0;
        double area = 0;
        for (const int member : group)
          for (std::size_t f = 0; f < 4; ++f) {
            CutPiece& piece = split_.pieces[static_cast<std::size_t>(member)];
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
    const Tet& tet = split_.pieces[p].tet;
    return std::all_of(tet.begin(), tet.end(), [this](int n) { return is_in_cut(n); });
  }

  /// Collects the pieces connected to one. Returns false at the first that has a node outside the cut.
  bool is_crumb(int piece, std::vector<int>& group) const {
    group = {piece};
    for (std::size_t k = 0; k < group.size(); ++k) {
      const auto member = static_cast<std::size_t>(group[k]);
      if (!is_all_in_cut(member)) return false;
      for (std::size_t f = 0; f < 4; ++f) {
        const int other = split_.pieces[member].neighbour[f];
        if (other >= 0 && !split_.pieces[member].separated[f] &&
            std::find(group.begin(), group.end(), other) == group.end())
          group.push_back(other);
      }
    }
    return true;
  }

  double face_area(const CutPiece& piece, std::size_t f) const {
    const auto [a, b, c] = face(piece, f);
    return (at(b) - at(a)).cross(at(c) - at(a)).norm() / 2;
  }

  /// Adds up the area of the faces that came apart, and lists those that are still closed.
  void write_faces(Cut& cut) const {
    for (std::size_t p = 0; p < split_.pieces.size(); ++p)
      for (std::size_t f = 0; f < 4; ++f) {
        const CutPiece& piece = split_.pieces[p];
        if (!piece.separated[f] || piece.neighbour[f] < static_cast<int>(p)) continue;
        const auto other = static_cast<std::size_t>(piece.neighbour[f]);
        const auto nodes = sorted(face({final_[p], 0}, f)),
                   others = sorted(face({final_[other], 0}, facing(split_.pieces[other], &piece)));
        if (nodes == others)
          cut.stroke.closed.push_back(nodes);
        else
          cut.area += face_area(piece, f);
      }
    std::sort(cut.stroke.closed.begin(), cut.stroke.closed.end());
  }

  std::size_t facing(const CutPiece& piece, const CutPiece* to) const {
    const auto number = static_cast<int>(to - split_.pieces.data());
    return static_cast<std::size_t>(std::find(piece.neighbour.begin(), piece.neighbour.end(), number) -
                                    piece.neighbour.begin());
  }

  void match_faces() {
    struct Side {
      std::array<int, 3> nodes;
      int piece;
      std::size_t face;
    };
    std::vector<Side> sides;
    for (std::size_t p = 0; p < split_.pieces.size(); ++p)
      for (std::size_t f = 0; f < 4; ++f) {
        sides.push_back({face(split_.pieces[p], f), static_cast<int>(p), f});
        std::sort(sides.back().nodes.begin(), sides.back().nodes.end());
      }
    std::sort(sides.begin(), sides.end(),
              [](const Side& a, const Side& b) { return std::tie(a.nodes, a.piece) < std::tie(b.nodes, b.piece); });
    for (std::size_t k = 1; k < sides.size(); ++k) {
      const Side &one = sides[k - 1], &two = sides[k];
      if (one.nodes != two.nodes) continue;
      split_.pieces[static_cast<std::size_t>(one.piece)].neighbour[one.face] = two.piece;
      split_.pieces[static_cast<std::size_t>(two.piece)].neighbour[two.face] = one.piece;
    }
  }

  /// Whether a face lies in the cut, with its two pieces on different sides. Where a piece's nodes do not say, the
  /// plane of the sweep decides, unless all nodes of the face are of earlier sweeps of the stroke, which have decided
  /// about it.
  bool is_separated(const CutPiece& piece, std::size_t f) const {
    const std::array<int, 3> nodes = face(piece, f);
    if (!std::all_of(nodes.begin(), nodes.end(), [this](int n) { return is_in_cut(n); })) return false;
    const CutPiece& other = split_.pieces[static_cast<std::size_t>(piece.neighbour[f])];
    int one = side(piece), two = side(other);
    if (one != 0 && two != 0) return one != two;
    if (std::none_of(nodes.begin(), nodes.end(),
                     [this](int n) { return split_.in_cut_by_sweep[static_cast<std::size_t>(n)]; }))
      return false;
    const auto nearest = surface_.nearest((at(nodes[0]) + at(nodes[1]) + at(nodes[2])) / 3);
    if (one == 0) one = side_of_plane(piece, f, nearest);
    if (two == 0) two = side_of_plane(other, facing(other, &piece), nearest);
    return one != two;
  }

  /// 1: the piece is on the upper side of the cut, −1: on the lower, 0: its nodes do not say. Nodes outside the cut
  /// decide; without one, those that were snapped to it.
  int side(const CutPiece& piece) const {
    int sum = 0;
    for (const int n : piece.tet) {
      if (n >= static_cast<int>(split_.side.size())) continue;
      const int side = split_.side[static_cast<std::size_t>(n)];
      if (side != 0 && !is_in_cut(n)) return side;
      sum += side;
    }
    return (sum > 0) - (sum < 0);
  }

  /// The side of a piece: that of its node opposite the face; of its centroid if that node is in the cut.
  int side_of_plane(const CutPiece& piece, std::size_t f, const SweptSurface::Nearest& plane) const {
    Vec3 point = at(piece.tet[f]);
    if (is_in_cut(piece.tet[f]))
      point = (at(piece.tet[0]) + at(piece.tet[1]) + at(piece.tet[2]) + at(piece.tet[3])) / 4;
    return (point - plane.point).dot(plane.normal) > 0 ? 1 : -1;
  }

  /// Copies each node in the cut for every group of connected pieces round it except the first.
  void copy_nodes() {
    final_.reserve(split_.pieces.size());
    for (const CutPiece& piece : split_.pieces) final_.push_back(piece.tet);
    std::vector<std::pair<int, int>> uses;  // node, piece
    for (std::size_t p = 0; p < split_.pieces.size(); ++p)
      for (const int n : split_.pieces[p].tet)
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
      number = static_cast<int>(split_.in_cut.size());
      const auto known = static_cast<std::size_t>(node);
      split_.nodes.push_back(known < mesh_.nodes.size() ? InsertedNode{node, node, 0}
                                                        : split_.nodes[known - mesh_.nodes.size()]);
      split_.in_cut.push_back(true);
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
      const CutPiece& at = split_.pieces[static_cast<std::size_t>(reached[k])];
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
  SplitElements split_;
  std::vector<Tet> final_;  ///< nodes of each piece, copies included
};

}  // namespace

Status make_cut(const Sweep& sweep, const TetMesh& mesh, const std::vector<Vec3>& x, const Topology& topology,
                double snap, const Stroke& stroke, Cut& cut) {
  const OrientedSweep joined = stroke.front.join(sweep, mesh, x, topology, snap, stroke.heading);
  const SweptSurface surface(joined);
  if (surface.empty()) return "the blade sweeps no area; give its two ends at two or more moments, in different places";
  auto split = split_elements(surface, mesh, x, topology, snap, stroke);
  if (!split) return "the blade meets no edge of an element";
  Separator separator(surface, mesh, *std::move(split));
  cut = {};
  separator.separate(stroke.closed);
  separator.write(cut);
  cut.stroke.heading = joined.heading;
  return {};
}

}  // namespace heml
