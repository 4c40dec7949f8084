#include <algorithm>
#include <cmath>
#include <heml/math/closest.hpp>
#include <heml/mesh/split_triangle.hpp>
#include <heml/session/skin_split.hpp>
#include <map>
#include <numeric>
#include <set>

namespace heml {
namespace {

constexpr double least_part = 1e-6;  // of an edge between two points on it, and of a triangle beside one
constexpr double shake_in_edges = 1e-5;
constexpr double before = -1, beyond = 2;
constexpr std::size_t most_points = 40;  // in a triangle; one with more stays whole

using Side = std::array<int, 2>;  // welded vertices, ascending

/// A strip on an edge of the rim, of two triangles: (a0, b0, b1) and (a0, b1, a1).
struct Curtain {
  Vec3 a0, a1, b0, b1;
};

bool is_left(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v) { return signed_volume(p, q, u, v) >= 0; }

/// Where the segment p to q passes through the triangle u, v, w of which `inside` says that the line does.
std::optional<double> place_on(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v, const Vec3& w, bool inside) {
  const double at_p = signed_volume(u, v, w, p), at_q = signed_volume(u, v, w, q);
  if (!inside || (at_p >= 0) == (at_q >= 0)) return std::nullopt;
  return std::clamp(at_p / (at_p - at_q), least_part, 1 - least_part);
}

/// Where the curtain crosses a side from p to q: up to one place on each triangle. Calls with the same p and q, and
/// curtains with a common end, agree on every sign, so that a line along the rim crosses a surface without gaps.
std::array<std::optional<double>, 2> crossings(const Curtain& c, const Vec3& p, const Vec3& q) {
  const bool bottom = is_left(p, q, c.a0, c.b0), top = is_left(p, q, c.a1, c.b1), diagonal = is_left(p, q, c.a0, c.b1);
  const bool at_a = is_left(p, q, c.a0, c.a1), at_b = is_left(p, q, c.b0, c.b1);
  return {place_on(p, q, c.a0, c.b0, c.b1, bottom == at_b && at_b != diagonal),
          place_on(p, q, c.a0, c.b1, c.a1, diagonal != top && top == at_a)};
}

class Splitting {
  /// Of a line along the rim in a triangle.
  struct End {
    int point;
    double along;  // 0 to 1, from the first to the second node of the rim's edge; `before` and `beyond` over these
  };

 public:
  Splitting(const WoundRim& rim, const DividedSurface& skin, double reach)
      : rim_(rim), skin_(skin), mesh_(skin.surface.surface()), reach_(reach) {
    shake();
  }

  SplitSkin run() {
    for (std::size_t e = 0; e < rim_.edges.size(); ++e) cross(e);
    keep_apart();
    for (const int t : divided()) split(t);
    result_.near.assign(near_.begin(), near_.end());
    return std::move(result_);
  }

 private:
  /// Moves the rim out of special places, such as along edges of the surface, by less than is seen.
  void shake() {
    double length = 0;
    for (const WoundRim::Edge& edge : rim_.edges)
      length += (rim_.nodes[static_cast<std::size_t>(edge.nodes[0])].place -
                 rim_.nodes[static_cast<std::size_t>(edge.nodes[1])].place)
                    .norm();
    const double most = shake_in_edges * length / static_cast<double>(std::max<std::size_t>(1, rim_.edges.size()));
    for (std::size_t n = 0; n < rim_.nodes.size(); ++n) {
      const auto k = static_cast<double>(n);
      rim_.nodes[n].place += most * Vec3(std::sin(12.9 * k + 1), std::sin(78.2 * k + 2), std::sin(37.7 * k + 3));
    }
  }

  const Vec3& node(int v) const { return mesh_.nodes[static_cast<std::size_t>(v)]; }
  int welded(int v) const { return static_cast<int>(skin_.same[static_cast<std::size_t>(v)]); }
  const Triangle& triangle(int t) const { return mesh_.triangles[static_cast<std::size_t>(t)]; }
  Side side(const Triangle& t, std::size_t k) const {
    const int a = welded(t[k]), b = welded(t[(k + 1) % 3]);
    return {std::min(a, b), std::max(a, b)};
  }
  int add_point(const Vec3& place, const Vec3& foot) {
    result_.points.push_back({place, foot});
    return static_cast<int>(result_.points.size()) - 1;
  }

  /// Finds where the curtain on an edge of the rim crosses triangles that face its way.
  void cross(std::size_t edge) {
    const auto& [i, j] = rim_.edges[edge].nodes;
    const WoundRim::Node &a = rim_.nodes[static_cast<std::size_t>(i)], &b = rim_.nodes[static_cast<std::size_t>(j)];
    const Curtain curtain{a.place - reach_ * a.normal, a.place + reach_ * a.normal, b.place - reach_ * b.normal,
                          b.place + reach_ * b.normal};
    Eigen::AlignedBox3d box;
    for (const Vec3& x : {curtain.a0, curtain.a1, curtain.b0, curtain.b1}) box.extend(x);
    for (const int t : skin_.surface.overlapping(box)) {
      const auto [p, q, r] = skin_.surface.corners(t);
      if ((q - p).cross(r - p).dot(a.normal + b.normal) <= 0) continue;
      near_.insert(t);
      std::vector<End> ends;
      for (std::size_t k = 0; k < 3; ++k) cross_side(edge, curtain, side(triangle(t), k), ends);
      if (const int point = cross_inside(t, i, curtain.a0, curtain.a1); point >= 0) ends.push_back({point, before});
      if (const int point = cross_inside(t, j, curtain.b0, curtain.b1); point >= 0) ends.push_back({point, beyond});
      if (ends.size() != 2 || ends[0].point == ends[1].point) continue;
      if (ends[0].along > ends[1].along) std::swap(ends[0], ends[1]);
      const int from = ends[0].point, to = ends[1].point;
      segments_[t].push_back({from, to});
      result_.along_rim[{from, to}] = rim_.edges[edge].faces[0];
      result_.along_rim[{to, from}] = rim_.edges[edge].faces[1];
    }
  }

  void cross_side(std::size_t edge, const Curtain& curtain, const Side& side, std::vector<End>& ends) {
    const Vec3 &p = node(side[0]), &q = node(side[1]);
    const auto places = crossings(curtain, p, q);
    for (std::size_t part = 0; part < 2; ++part) {
      if (!places[part]) continue;
      const auto [known, is_new] = side_points_.try_emplace({side, 2 * edge + part}, End{-1, 0});
      if (is_new) {
        const Vec3 place = p + *places[part] * (q - p);
        const double along = part == 0 ? 1 - closest_point_weights(place, curtain.a0, curtain.b0, curtain.b1)[0]
                                       : closest_point_weights(place, curtain.a0, curtain.b1, curtain.a1)[1];
        const auto& [i, j] = rim_.edges[edge].nodes;
        const Vec3 &from = rim_.nodes[static_cast<std::size_t>(i)].place,
                   &to = rim_.nodes[static_cast<std::size_t>(j)].place;
        known->second = {add_point(place, from + along * (to - from)), along};
        on_sides_[side].push_back({*places[part], known->second.point});
      }
      ends.push_back(known->second);
    }
  }

  /// The point where the end of a curtain over a node of the rim passes through a triangle; −1: it does not.
  int cross_inside(int t, int rim_node, const Vec3& below, const Vec3& above) {
    const Triangle& corners = triangle(t);
    std::array<bool, 3> left{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Side s = side(corners, k);
      left[k] = is_left(node(s[0]), node(s[1]), below, above) == (s[0] == welded(corners[k]));
    }
    if (left[0] != left[1] || left[1] != left[2]) return -1;
    const Vec3 &p = node(corners[0]), &q = node(corners[1]), &r = node(corners[2]);
    const double at_low = signed_volume(p, q, r, below), at_high = signed_volume(p, q, r, above);
    if ((at_low >= 0) == (at_high >= 0)) return -1;
    const auto [known, is_new] = inside_points_.try_emplace({t, rim_node}, -1);
    if (is_new) {
      const Vec3 x = below + at_low / (at_low - at_high) * (above - below);
      const auto w = closest_point_weights(x, p, q, r);
      Vec3 weights(std::max(w[0], least_part), std::max(w[1], least_part), std::max(w[2], least_part));
      weights /= weights.sum();
      known->second = add_point(weights[0] * p + weights[1] * q + weights[2] * r,
                                rim_.nodes[static_cast<std::size_t>(rim_node)].place);
      inside_[t].push_back(known->second);
    }
    return known->second;
  }

  /// Orders the points along each side, and moves apart those at one place.
  void keep_apart() {
    for (auto& [side, points] : on_sides_) {
      std::sort(points.begin(), points.end());
      const Vec3 &p = node(side[0]), &q = node(side[1]);
      double last = 0;
      for (auto& [place, point] : points) {
        last = place = std::max(place, last + least_part);
        result_.points[static_cast<std::size_t>(point)].place = p + place * (q - p);
      }
    }
  }

  /// Triangles with a point inside or on a side, ascending.
  std::set<int> divided() const {
    std::set<int> result;
    for (const auto& [t, points] : inside_) result.insert(t);
    for (const auto& side_points : on_sides_) {
      const Side& s = side_points.first;
      for (std::size_t k = skin_.first[static_cast<std::size_t>(s[0])];
           k < skin_.first[static_cast<std::size_t>(s[0]) + 1]; ++k) {
        const Triangle& corners = triangle(skin_.around[k]);
        if (std::any_of(corners.begin(), corners.end(), [&](int v) { return welded(v) == s[1]; }))
          result.insert(skin_.around[k]);
      }
    }
    return result;
  }

  void split(int t) {
    const Triangle& corners = triangle(t);
    std::vector<int> ids(corners.begin(), corners.end());
    std::array<std::vector<int>, 3> sides;
    std::map<int, int> local;
    const auto add = [&](int point) {
      local[point] = static_cast<int>(ids.size());
      ids.push_back(static_cast<int>(mesh_.nodes.size()) + point);
      return local[point];
    };
    for (std::size_t k = 0; k < 3; ++k) {
      const Side s = side(corners, k);
      const auto found = on_sides_.find(s);
      if (found == on_sides_.end()) continue;
      for (const auto& [place, point] : found->second) sides[k].push_back(add(point));
      if (s[0] != welded(corners[k])) std::reverse(sides[k].begin(), sides[k].end());
    }
    if (const auto found = inside_.find(t); found != inside_.end())
      for (const int point : found->second) add(point);
    if (ids.size() > most_points) return;
    std::vector<std::array<int, 2>> segments;
    if (const auto found = segments_.find(t); found != segments_.end())
      for (const auto& [a, b] : found->second) segments.push_back({local.at(a), local.at(b)});
    add_parts(t, ids, sides, segments);
  }

  void add_parts(int t, const std::vector<int>& ids, const std::array<std::vector<int>, 3>& sides,
                 const std::vector<std::array<int, 2>>& segments) {
    const auto [p, q, r] = skin_.surface.corners(t);
    const Vec3 normal = (q - p).cross(r - p), along = (q - p).normalized(), across = normal.cross(along).normalized();
    std::vector<Eigen::Vector2d> flat;
    std::vector<Vec3> weights;
    for (const int id : ids) {
      const int point = id - static_cast<int>(mesh_.nodes.size());
      const Vec3 x = point < 0 ? node(id) : result_.points[static_cast<std::size_t>(point)].place;
      flat.emplace_back(along.dot(x - p), across.dot(x - p));
      const double second = (x - p).cross(r - p).dot(normal) / normal.squaredNorm();
      const double third = (q - p).cross(x - p).dot(normal) / normal.squaredNorm();
      weights.emplace_back(1 - second - third, second, third);
    }
    for (const Triangle& part : split_triangle(flat, sides, segments)) {
      SplitSkin::Part& added = result_.parts.emplace_back();
      added.triangle = t;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto i = static_cast<std::size_t>(part[k]);
        added.corners[k] = ids[i];
        added.weights[k] = weights[i];
      }
    }
  }

  WoundRim rim_;
  const DividedSurface& skin_;
  const TriangleMesh& mesh_;
  double reach_;
  std::map<std::pair<Side, std::size_t>, End> side_points_;       // by side, edge of the rim and half of its curtain
  std::map<Side, std::vector<std::pair<double, int>>> on_sides_;  // place from the lower vertex, point
  std::map<std::pair<int, int>, int> inside_points_;              // by triangle and node of the rim
  std::map<int, std::vector<int>> inside_;                        // points by triangle
  std::map<int, std::vector<std::array<int, 2>>> segments_;       // pairs of points by triangle
  std::set<int> near_;
  SplitSkin result_;
};

}  // namespace

SplitSkin split_along(const WoundRim& rim, const DividedSurface& skin, double reach) {
  return Splitting(rim, skin, reach).run();
}

}  // namespace heml
