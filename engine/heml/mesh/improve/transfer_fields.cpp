#include <algorithm>
#include <heml/mesh/field_of_piece.hpp>
#include <heml/mesh/improve/transfer_fields.hpp>
#include <limits>
#include <map>

namespace heml {
namespace {

Vec3 centroid_of(const TetMesh& mesh, std::size_t t) {
  Vec3 sum = Vec3::Zero();
  for (const int n : mesh.tets[t]) sum += mesh.nodes[n];
  return sum / 4;
}

/// Points in a balanced tree: the middle of a range divides the points before it from those after it, along an axis
/// that turns with the depth.
class PointTree {
 public:
  void add(const Vec3& x, std::size_t id) { points_.push_back({x, id}); }

  void build() { build(0, points_.size(), 0); }

  std::size_t nearest(const Vec3& x) const {
    Best best;
    search(x, 0, points_.size(), 0, best);
    return best.id;
  }

 private:
  struct Point {
    Vec3 x;
    std::size_t id;
  };
  struct Best {
    double square = std::numeric_limits<double>::infinity();
    std::size_t id = 0;
  };

  void build(std::size_t first, std::size_t last, int axis) {
    if (last - first < 2) return;
    const std::size_t middle = (first + last) / 2;
    const auto at = [&](std::size_t k) { return points_.begin() + static_cast<std::ptrdiff_t>(k); };
    std::nth_element(at(first), at(middle), at(last), [axis](const Point& a, const Point& b) {
      return std::pair(a.x[axis], a.id) < std::pair(b.x[axis], b.id);
    });
    build(first, middle, (axis + 1) % 3);
    build(middle + 1, last, (axis + 1) % 3);
  }

  void search(const Vec3& x, std::size_t first, std::size_t last, int axis, Best& best) const {
    if (first == last) return;
    const std::size_t middle = (first + last) / 2;
    const double square = (points_[middle].x - x).squaredNorm();
    if (square < best.square || (square == best.square && points_[middle].id < best.id))
      best = {square, points_[middle].id};
    const double side = x[axis] - points_[middle].x[axis];
    const int next = (axis + 1) % 3;
    if (side < 0) {
      search(x, first, middle, next, best);
      if (side * side <= best.square) search(x, middle + 1, last, next, best);
    } else {
      search(x, middle + 1, last, next, best);
      if (side * side <= best.square) search(x, first, middle, next, best);
    }
  }

  std::vector<Point> points_;
};

}  // namespace

void transfer_fields(const TetMesh& from, TetMesh& to) {
  if (from.fields.empty()) return;
  std::map<int, PointTree> trees;
  for (std::size_t t = 0; t < from.tets.size(); ++t) trees[from.regions[t]].add(centroid_of(from, t), t);
  for (auto& [region, tree] : trees) tree.build();
  to.fields = from.fields;
  std::vector<int> nearest;
  for (std::size_t t = 0; t < to.tets.size(); ++t)
    nearest.push_back(static_cast<int>(trees.at(to.regions[t]).nearest(centroid_of(to, t))));
  for (ElementField& field : to.fields) field = field_of_pieces(field, from, to, nearest);
}

}  // namespace heml
