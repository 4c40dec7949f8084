#include <algorithm>
#include <cmath>
#include <heml/mesh/intersections.hpp>
#include <unsupported/Eigen/BVH>

namespace heml {
namespace {

// Orientation predicates return a certain sign, or 0. Bounds of the rounding error: J. R. Shewchuk, Adaptive precision
// floating-point arithmetic and fast robust geometric predicates, Discrete Comput. Geom. 18 (1997), orient3d and
// orient2d, stage A.
constexpr double half_ulp = 0x1p-53;

int sign_beyond(double value, double bound) { return value > bound ? 1 : value < -bound ? -1 : 0; }

// The side of the plane abc on which d lies: −1, 0, 1.
int side(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = a - d, v = b - d, w = c - d;
  double value = 0, size = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    value += w[i] * (u[j] * v[k] - u[k] * v[j]);
    size += std::abs(w[i]) * (std::abs(u[j] * v[k]) + std::abs(u[k] * v[j]));
  }
  return sign_beyond(value, (7 + 56 * half_ulp) * half_ulp * size);
}

using Vec2 = Eigen::Vector2d;

// The side of the line ab on which c lies: −1, 0, 1.
int side(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double left = (a[0] - c[0]) * (b[1] - c[1]), right = (a[1] - c[1]) * (b[0] - c[0]);
  return sign_beyond(left - right, (3 + 16 * half_ulp) * half_ulp * (std::abs(left) + std::abs(right)));
}

// Whether the bounding boxes of two segments overlap; for collinear segments.
bool boxes_meet(const Vec2& p, const Vec2& q, const Vec2& a, const Vec2& b) {
  return (p.cwiseMin(q).array() <= a.cwiseMax(b).array()).all() &&
         (a.cwiseMin(b).array() <= p.cwiseMax(q).array()).all();
}

bool segments_meet(const Vec2& p, const Vec2& q, const Vec2& a, const Vec2& b) {
  const int a_side = side(p, q, a), b_side = side(p, q, b), p_side = side(a, b, p), q_side = side(a, b, q);
  if (a_side == 0 && b_side == 0 && p_side == 0 && q_side == 0) return boxes_meet(p, q, a, b);
  return a_side * b_side <= 0 && p_side * q_side <= 0;
}

// For a segment and a triangle in one plane: projects along the axis nearest to the normal.
bool meet_in_plane(const Vec3& p, const Vec3& q, const std::array<Vec3, 3>& t) {
  int axis;
  (t[1] - t[0]).cross(t[2] - t[0]).cwiseAbs().maxCoeff(&axis);
  const auto flat = [axis](const Vec3& x) { return Vec2(x[(axis + 1) % 3], x[(axis + 2) % 3]); };
  const Vec2 P = flat(p), Q = flat(q), a = flat(t[0]), b = flat(t[1]), c = flat(t[2]);
  if (segments_meet(P, Q, a, b) || segments_meet(P, Q, b, c) || segments_meet(P, Q, c, a)) return true;
  const int around = side(a, b, P) + side(b, c, P) + side(c, a, P);
  return around == 3 || around == -3;
}

bool segment_meets(const Vec3& p, const Vec3& q, const std::array<Vec3, 3>& t) {
  const int p_side = side(t[0], t[1], t[2], p), q_side = side(t[0], t[1], t[2], q);
  if (p_side == 0 && q_side == 0) return meet_in_plane(p, q, t);
  if (p_side * q_side > 0) return false;
  const int ab = side(p, q, t[0], t[1]), bc = side(p, q, t[1], t[2]), ca = side(p, q, t[2], t[0]);
  return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

class Pairs {
 public:
  explicit Pairs(const TriangleMesh& surface) : surface_(surface) {}

  bool meet(const Triangle& s, const Triangle& t) const {
    // Moves shared nodes to the front of both, in the same order.
    Triangle a = s, b = t;
    int shared = 0;
    for (int i = 0; i < 3; ++i) {
      const auto at = std::find(b.begin() + shared, b.end(), a[i]);
      if (at == b.end()) continue;
      std::swap(a[i], a[shared]);
      std::iter_swap(at, b.begin() + shared);
      ++shared;
    }
    const auto x = corners(a), y = corners(b);
    if (shared == 3) return true;
    if (shared == 2) return folded(x[0], x[1], x[2], y[2]);
    // Beyond a shared node, triangles meet if and only if the edge opposite to it in one meets the other.
    if (shared == 1) return segment_meets(x[1], x[2], y) || segment_meets(y[1], y[2], x);
    for (int i = 0; i < 3; ++i)
      if (segment_meets(x[i], x[(i + 1) % 3], y) || segment_meets(y[i], y[(i + 1) % 3], x)) return true;
    return false;
  }

  Eigen::AlignedBox3d box(int triangle) const {
    Eigen::AlignedBox3d result;
    for (int node : surface_.triangles[triangle]) result.extend(surface_.nodes[node]);
    return result;
  }

 private:
  std::array<Vec3, 3> corners(const Triangle& t) const {
    return {surface_.nodes[t[0]], surface_.nodes[t[1]], surface_.nodes[t[2]]};
  }

  // Whether triangles uva and uvb lie in one plane and on the same side of their common edge uv.
  static bool folded(const Vec3& u, const Vec3& v, const Vec3& a, const Vec3& b) {
    return side(u, v, a, b) == 0 && (v - u).cross(a - u).dot((v - u).cross(b - u)) > 0;
  }

  const TriangleMesh& surface_;
};

// The visitor that Eigen::BVIntersect requires; compares each pair of triangles once.
struct Search {
  using Box = Eigen::AlignedBox3d;

  const TriangleMesh& surface;
  const Pairs& pairs;
  Intersections found;

  bool intersectVolumeVolume(const Box& a, const Box& b) const { return a.intersects(b); }
  bool intersectVolumeObject(const Box& a, int t) const { return a.intersects(pairs.box(t)); }
  bool intersectObjectVolume(int t, const Box& a) const { return a.intersects(pairs.box(t)); }
  bool intersectObjectObject(int s, int t) {
    if (s >= t || !pairs.box(s).intersects(pairs.box(t))) return false;
    if (!pairs.meet(surface.triangles[s], surface.triangles[t])) return false;
    if (found.pairs == 0 || std::pair(s, t) < std::pair(found.first, found.second)) {
      found.first = s;
      found.second = t;
    }
    found.triangles.insert(found.triangles.end(), {s, t});
    return ++found.pairs >= max_pairs;
  }
};

}  // namespace

Intersections self_intersections(const TriangleMesh& surface) {
  const Pairs pairs(surface);
  std::vector<int> triangles;
  std::vector<Eigen::AlignedBox3d> boxes;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    triangles.push_back(static_cast<int>(t));
    boxes.push_back(pairs.box(triangles.back()));
  }
  const Eigen::KdBVH<double, 3, int> tree(triangles.begin(), triangles.end(), boxes.begin(), boxes.end());
  Search search{surface, pairs, {}};
  Eigen::BVIntersect(tree, tree, search);
  std::vector<int>& list = search.found.triangles;
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
  return search.found;
}

}  // namespace heml
