#include <algorithm>
#include <heml/mesh/split_triangle.hpp>

namespace heml {
namespace {

using Edge = std::array<int, 2>;

class Splitter {
 public:
  explicit Splitter(std::span<const Eigen::Vector2d> points)
      : points_(points), joined_(points.size() * points.size(), 0) {
    tolerance_ = 1e-12 * std::abs(area(0, 1, 2));
  }

  /// Adds an edge unless it crosses an earlier one or passes through a point.
  void add(const Edge& edge) {
    if (is_joined(edge[0], edge[1]) || passes_through_point(edge)) return;
    for (const Edge& other : edges_)
      if (cross(edge, other)) return;
    add_unseen(edge);
  }
  void add_unseen(const Edge& edge) {
    edges_.push_back(edge);
    joined_[at(edge[0], edge[1])] = joined_[at(edge[1], edge[0])] = 1;
  }
  /// Triples of joined points without another one inside are the parts.
  std::vector<Triangle> parts() const {
    std::vector<Triangle> result;
    const int n = static_cast<int>(points_.size());
    for (int i = 0; i < n; ++i)
      for (int j = i + 1; j < n; ++j)
        for (int k = j + 1; k < n && is_joined(i, j); ++k) {
          if (!is_joined(i, k) || !is_joined(j, k) || sign(i, j, k) == 0) continue;
          const Triangle part = sign(i, j, k) > 0 ? Triangle{i, j, k} : Triangle{i, k, j};
          if (is_empty(part)) result.push_back(part);
        }
    return result;
  }
  double squared_length(const Edge& edge) const { return (point(edge[1]) - point(edge[0])).squaredNorm(); }

 private:
  const Eigen::Vector2d& point(int i) const { return points_[static_cast<std::size_t>(i)]; }
  std::size_t at(int i, int j) const {
    return static_cast<std::size_t>(i) * points_.size() + static_cast<std::size_t>(j);
  }
  bool is_joined(int i, int j) const { return joined_[at(i, j)] != 0; }
  /// Twice the signed area.
  double area(int i, int j, int k) const {
    const Eigen::Vector2d a = point(j) - point(i), b = point(k) - point(i);
    return a.x() * b.y() - a.y() * b.x();
  }
  int sign(int i, int j, int k) const {
    const double twice = area(i, j, k);
    return twice > tolerance_ ? 1 : twice < -tolerance_ ? -1 : 0;
  }
  bool cross(const Edge& a, const Edge& b) const {
    if (a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1]) return false;
    return sign(a[0], a[1], b[0]) * sign(a[0], a[1], b[1]) < 0 && sign(b[0], b[1], a[0]) * sign(b[0], b[1], a[1]) < 0;
  }
  bool passes_through_point(const Edge& edge) const {
    const Eigen::Vector2d along = point(edge[1]) - point(edge[0]);
    for (int m = 0; m < static_cast<int>(points_.size()); ++m) {
      if (m == edge[0] || m == edge[1] || sign(edge[0], edge[1], m) != 0) continue;
      const double place = (point(m) - point(edge[0])).dot(along) / along.squaredNorm();
      if (place > 1e-9 && place < 1 - 1e-9) return true;
    }
    return false;
  }
  bool is_empty(const Triangle& t) const {
    for (int m = 0; m < static_cast<int>(points_.size()); ++m)
      if (m != t[0] && m != t[1] && m != t[2] && sign(t[0], t[1], m) > 0 && sign(t[1], t[2], m) > 0 &&
          sign(t[2], t[0], m) > 0)
        return false;
    return true;
  }

  std::span<const Eigen::Vector2d> points_;
  std::vector<char> joined_;  // #P×#P
  std::vector<Edge> edges_;
  double tolerance_;
};

}  // namespace

std::vector<Triangle> split_triangle(std::span<const Eigen::Vector2d> points,
                                     const std::array<std::vector<int>, 3>& sides,
                                     std::span<const std::array<int, 2>> segments) {
  Splitter splitter(points);
  const int n = static_cast<int>(points.size());
  std::vector<std::array<char, 3>> on_side(points.size(), {0, 0, 0});
  for (std::size_t k = 0; k < 3; ++k) {
    int last = static_cast<int>(k);
    on_side[k][k] = on_side[(k + 1) % 3][k] = 1;
    for (const int i : sides[k]) {
      splitter.add_unseen({last, i});
      on_side[static_cast<std::size_t>(i)][k] = 1;
      last = i;
    }
    splitter.add_unseen({last, static_cast<int>((k + 1) % 3)});
  }
  for (const Edge& segment : segments) splitter.add(segment);
  std::vector<Edge> others;
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j) {
      const auto &a = on_side[static_cast<std::size_t>(i)], &b = on_side[static_cast<std::size_t>(j)];
      const bool along_side = (a[0] && b[0]) || (a[1] && b[1]) || (a[2] && b[2]);
      if (!along_side) others.push_back({i, j});
    }
  std::stable_sort(others.begin(), others.end(), [&](const Edge& a, const Edge& b) {
    return splitter.squared_length(a) < splitter.squared_length(b);
  });
  for (const Edge& edge : others) splitter.add(edge);
  return splitter.parts();
}

}  // namespace heml
