#include "app/render/ambient_occlusion.hpp"

#include <algorithm>
#include <app/render/ray_triangle.hpp>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

namespace heml::render {
namespace {

using Box = Eigen::AlignedBox3f;

// Bounding volume hierarchy of the triangles, split at the median of the longest axis.
class Occluder {
 public:
  explicit Occluder(const SurfaceMesh& surface_mesh)
      : surface_mesh_(surface_mesh), order_(surface_mesh.triangles.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    if (!order_.empty()) build(0, static_cast<int>(order_.size()));
  }

  bool blocks(const Vec3f& origin, const Vec3f& direction, float reach) const {
    const Vec3f inverse = direction.cwiseInverse();
    std::array<int, 64> stack;
    int size = 0;
    if (!nodes_.empty()) stack[size++] = 0;
    while (size > 0) {
      const Node& node = nodes_[stack[--size]];
      if (!enters(node.box, origin, inverse, reach)) continue;
      if (node.right < 0) {
        for (int i = node.first; i < node.last; ++i) {
          const auto& [a, b, c] = surface_mesh_.triangles[order_[i]];
          if (ray_meets(origin, direction, surface_mesh_.rest[a], surface_mesh_.rest[b], surface_mesh_.rest[c]) < reach)
            return true;
        }
      } else {
        stack[size++] = node.right;
        stack[size++] = static_cast<int>(&node - nodes_.data()) + 1;
      }
    }
    return false;
  }

 private:
  struct Node {
    Box box;
    int first, last;  // range in order_
    int right = -1;   // index of the right child; the left child follows its parent; −1: leaf
  };

  static bool enters(const Box& box, const Vec3f& origin, const Vec3f& inverse, float reach) {
    const Vec3f a = (box.min() - origin).cwiseProduct(inverse), b = (box.max() - origin).cwiseProduct(inverse);
    return std::max(a.cwiseMin(b).maxCoeff(), 0.0f) <= std::min(a.cwiseMax(b).minCoeff(), reach);
  }

  Vec3f centre(int triangle) const {
    const auto& [a, b, c] = surface_mesh_.triangles[triangle];
    return (surface_mesh_.rest[a] + surface_mesh_.rest[b] + surface_mesh_.rest[c]) / 3;
  }

  void build(int first, int last) {
    const std::size_t self = nodes_.size();
    nodes_.push_back({Box(), first, last});
    Box centres;
    for (int i = first; i < last; ++i) {
      for (const int node : surface_mesh_.triangles[order_[i]]) nodes_[self].box.extend(surface_mesh_.rest[node]);
      centres.extend(centre(order_[i]));
    }
    if (last - first <= 4) return;
    Eigen::Index axis = 0;
    centres.sizes().maxCoeff(&axis);
    const int middle = (first + last) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                     [&](int a, int b) { return std::pair(centre(a)[axis], a) < std::pair(centre(b)[axis], b); });
    build(first, middle);
    nodes_[self].right = static_cast<int>(nodes_.size());
    build(middle, last);
  }

  const SurfaceMesh& surface_mesh_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

// Cosine-weighted directions about z, stratified: one in each cell of a grid.
std::vector<Vec3f> directions(int side, unsigned seed) {
  std::minstd_rand random(seed);
  const auto uniform = [&] { return static_cast<float>(random() % 65536) / 65536; };
  std::vector<Vec3f> result;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      const float s = (static_cast<float>(i) + uniform()) / static_cast<float>(side);
      const float turn = (static_cast<float>(j) + uniform()) / static_cast<float>(side);
      const float angle = 2 * std::numbers::pi_v<float> * turn, r = std::sqrt(s);
      result.emplace_back(r * std::cos(angle), r * std::sin(angle), std::sqrt(1 - s));
    }
  return result;
}

// Averages with the neighbours: removes the noise of the few rays.
void smooth(const SurfaceMesh& surface_mesh, std::vector<float>& values) {
  std::vector<float> sum = values, weight(values.size(), 1);
  for (const Triangle& triangle : surface_mesh.triangles)
    for (int k = 0; k < 3; ++k)
      for (const int other : {triangle[(k + 1) % 3], triangle[(k + 2) % 3]}) {
        sum[triangle[k]] += 0.5f * values[other];
        weight[triangle[k]] += 0.5f;
      }
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = sum[i] / weight[i];
}

}  // namespace

std::vector<float> ambient_occlusion(const SurfaceMesh& surface_mesh, const std::vector<Vec3f>& normals, float reach) {
  const Occluder occluder(surface_mesh);
  const std::vector<Vec3f> rays = directions(surface_mesh.rest.size() < 10000 ? 10 : 5, 20010301);
  std::vector<float> open(surface_mesh.rest.size(), 1);
  for (std::size_t i = 0; i < open.size(); ++i) {
    const Vec3f n = normals[i];
    if (n.isZero()) continue;
    const Eigen::Quaternionf turn = Eigen::Quaternionf::FromTwoVectors(Vec3f::UnitZ(), n);
    const Vec3f origin = surface_mesh.rest[i] + 1e-3f * reach * n;
    int blocked = 0;
    for (const Vec3f& ray : rays) blocked += occluder.blocks(origin, turn * ray, reach);
    open[i] = 1 - static_cast<float>(blocked) / static_cast<float>(rays.size());
  }
  smooth(surface_mesh, open);
  smooth(surface_mesh, open);
  return open;
}

}  // namespace heml::render
