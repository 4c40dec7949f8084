#include <heml/math/box_pairs.hpp>
#include <numeric>
#include <unsupported/Eigen/BVH>

namespace heml {
namespace {

struct PairSearch {
  using Box = Eigen::AlignedBox3d;
  bool intersectVolumeVolume(const Box& a, const Box& b) const { return a.intersects(b); }
  bool intersectVolumeObject(const Box& a, int b) const { return a.intersects(boxes[static_cast<std::size_t>(b)]); }
  bool intersectObjectVolume(int a, const Box& b) const { return intersectVolumeObject(b, a); }
  bool intersectObjectObject(int a, int b) {
    if (a < b && intersectVolumeObject(boxes[static_cast<std::size_t>(a)], b)) found.emplace_back(a, b);
    return false;  // go on
  }
  const std::vector<Box>& boxes;
  std::vector<std::pair<int, int>> found = {};
};

}  // namespace

std::vector<std::pair<int, int>> intersecting_pairs(const std::vector<Eigen::AlignedBox3d>& boxes) {
  PairSearch search{boxes};
  if (boxes.size() < 2) return {};
  std::vector<int> indices(boxes.size());
  std::iota(indices.begin(), indices.end(), 0);
  const Eigen::KdBVH<double, 3, int> tree(indices.begin(), indices.end(), boxes.begin(), boxes.end());
  Eigen::BVIntersect(tree, tree, search);
  return search.found;
}

}  // namespace heml
