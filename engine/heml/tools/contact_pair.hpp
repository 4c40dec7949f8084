#pragma once
// A self-contact pair, a node and a face or two edges, and where its two sides cross.
#include <cmath>
#include <heml/tools/contact_surface.hpp>
#include <limits>
#include <tuple>

namespace heml {

/// Node and face, or edge and edge, internal numbers: {node, face's corners} or {ends of one edge, ends of the other}.
struct ContactPair {
  std::array<int, 4> nodes;
  int side = 0;  ///< 0: node and face; 1 or −1: edges, side (b − a)×(d − c) points out of the second edge's body
};

inline bool operator<(const ContactPair& a, const ContactPair& b) {
  return std::tie(a.nodes, a.side) < std::tie(b.nodes, b.side);
}
inline bool operator==(const ContactPair& a, const ContactPair& b) { return a.nodes == b.nodes && a.side == b.side; }

/// The crossing of a node with its face's plane, or of the lines of two edges, before any division: most pairs that
/// are tested end at a sign or at the weights, and need no unit normal.
struct PairCrossing {
  Vec3 normal;    ///< m², from the second to the first
  double square;  ///< of the normal
  double p, q;    ///< times square: weights of the face's second and third corner, or the parameters of both edges
  double height;  ///< m³, the gap times the normal's length

  /// Whether the crossing lies within the face or both edges, up to a margin (of weights).
  bool is_within(int side, double margin) const {
    const double low = -margin * square, high = (1 + margin) * square;
    return p >= low && q >= low && (side == 0 ? p + q <= high : p <= high && q <= high);
  }
  double gap() const { return height / std::sqrt(square); }  ///< m
};

/// Crossing of a pair with its nodes at x (m); none where the face is degenerate or the edges are parallel.
inline std::optional<PairCrossing> crossing_of(int side, const std::array<Vec3, 4>& x) {
  constexpr double out_of_range = std::numeric_limits<double>::max();
  constexpr double same_line = 1e-3;  // sine: below, the common perpendicular of two edges is undefined
  if (side == 0) {
    const Vec3 ab = x[2] - x[1], ac = x[3] - x[1], r = x[0] - x[1], N = ab.cross(ac);
    const double square = N.squaredNorm();
    if (!(square > 1e-24 * ab.squaredNorm() * ac.squaredNorm() && square < out_of_range)) return std::nullopt;
    return PairCrossing{N, square, r.cross(ac).dot(N), ab.cross(r).dot(N), r.dot(N)};
  }
  const Vec3 u = x[1] - x[0], v = x[3] - x[2], r = x[0] - x[2], N = side * u.cross(v);
  const double square = N.squaredNorm(), uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v);
  if (!(square > same_line * same_line * uu * vv && square < out_of_range)) return std::nullopt;
  return PairCrossing{N, square, uv * v.dot(r) - vv * u.dot(r), uu * v.dot(r) - uv * u.dot(r), r.dot(N)};
}

/// Contact point of a pair where it crosses: gap from the second to the first.
inline ContactPoint point_of(const ContactPair& pair, const PairCrossing& crossing) {
  const double p = crossing.p / crossing.square, q = crossing.q / crossing.square, length = std::sqrt(crossing.square);
  ContactPoint point{pair.nodes, {1, p + q - 1, -p, -q}, 4, 0, crossing.normal / length};
  if (pair.side != 0) point.weights = {1 - p, p, q - 1, -q};
  point.gap = crossing.height / length;
  return point;
}

/// Contact point of a pair with its nodes at x (m), of the face's whole plane or the edges' infinite lines.
inline std::optional<ContactPoint> point_of(const ContactPair& pair, const std::array<Vec3, 4>& x) {
  const auto crossing = crossing_of(pair.side, x);
  if (!crossing) return std::nullopt;
  return point_of(pair, *crossing);
}

template <class At>
std::optional<ContactPoint> point_of(const ContactPair& pair, const At& at) {
  const auto [a, b, c, d] = pair.nodes;
  return point_of(pair, std::array<Vec3, 4>{at(a), at(b), at(c), at(d)});
}

}  // namespace heml
