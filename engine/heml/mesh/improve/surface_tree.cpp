#include <algorithm>
#include <heml/math/closest.hpp>
#include <heml/mesh/faces.hpp>
#include <heml/mesh/improve/local_mesh.hpp>
#include <heml/mesh/improve/surface_tree.hpp>
#include <numeric>
#include <set>
#include <utility>

namespace heml {
namespace {

constexpr int triangles_of_leaf = 4;

/// Of a ray's hit, in multiples of `along` (Möller & Trumbore 1997); −1 for none.
double ray_triangle_distance(const Vec3& start, const Vec3& along, const std::array<Vec3, 3>& t) {
  const Vec3 ab = t[1] - t[0], ac = t[2] - t[0], cross = along.cross(ac), offset = start - t[0];
  const double determinant = ab.dot(cross);
  if (determinant == 0) return -1;
  const Vec3 other = offset.cross(ab);
  const double u = offset.dot(cross) / determinant, v = along.dot(other) / determinant;
  return u >= 0 && v >= 0 && u + v <= 1 ? ac.dot(other) / determinant : -1;
}

double one_sided_distance(const SurfaceTree& from, const SurfaceTree& to) {
  double farthest = 0;
  for (const auto& samples : samples_of(from.surface()))
    for (const Vec3& x : samples) farthest = std::max(farthest, to.nearest(x).distance);
  return farthest;
}

}  // namespace

SurfaceTree::SurfaceTree(TriangleMesh surface) : surface_(std::move(surface)), order_(surface_.triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  std::vector<Vec3> centres;
  for (const auto& [a, b, c] : surface_.triangles)
    centres.push_back((surface_.nodes[a] + surface_.nodes[b] + surface_.nodes[c]) / 3);
  if (!order_.empty()) build(0, static_cast<int>(order_.size()), centres);
}

void SurfaceTree::build(int first, int last, const std::vector<Vec3>& centres) {
  const std::size_t here = branches_.size();
  branches_.push_back({{}, first, last});
  Eigen::AlignedBox3d box, spread;
  for (int k = first; k < last; ++k) {
    for (const Vec3& x : corners(order_[k])) box.extend(x);
    spread.extend(centres[order_[k]]);
  }
  branches_[here].box = box;
  if (last - first <= triangles_of_leaf) return;
  Eigen::Index axis = 0;
  spread.sizes().maxCoeff(&axis);
  const int middle = (first + last) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                   [&](int a, int b) { return std::pair(centres[a][axis], a) < std::pair(centres[b][axis], b); });
  build(first, middle, centres);
  branches_[here].second = static_cast<int>(branches_.size());
  build(middle, last, centres);
}

std::array<Vec3, 3> SurfaceTree::corners(int triangle) const {
  const auto& [a, b, c] = surface_.triangles[triangle];
  return {surface_.nodes[a], surface_.nodes[b], surface_.nodes[c]};
}

SurfaceTree::Nearest SurfaceTree::nearest(const Vec3& x, double within, bool any) const {
  Nearest nearest;
  double best = within * within;
  if (branches_.empty()) return nearest;
  std::array<std::pair<double, int>, 64> stack;
  std::size_t size = 0;
  stack[size++] = {branches_[0].box.squaredExteriorDistance(x), 0};
  while (size > 0) {
    const auto [distance, b] = stack[--size];
    if (distance > best) continue;
    const Branch& branch = branches_[b];
    if (branch.second < 0) {
      for (int k = branch.first; k < branch.last; ++k) {
        const Vec3 point = nearest_on_triangle(x, corners(order_[k]));
        const double square = (point - x).squaredNorm();
        if (square < best || (nearest.triangle < 0 && square <= best)) {
          best = square;
          nearest = {order_[k], point, std::sqrt(square)};
          if (any) return nearest;
        }
      }
      continue;
    }
    const std::pair<double, int> one{branches_[b + 1].box.squaredExteriorDistance(x), b + 1};
    const std::pair<double, int> two{branches_[branch.second].box.squaredExteriorDistance(x), branch.second};
    stack[size++] = std::max(one, two);
    stack[size++] = std::min(one, two);
  }
  return nearest;
}

std::vector<int> SurfaceTree::overlapping(const Eigen::AlignedBox3d& box) const {
  std::vector<int> found, open;
  if (!branches_.empty()) open.push_back(0);
  while (!open.empty()) {
    const int b = open.back();
    open.pop_back();
    const Branch& branch = branches_[b];
    if (!branch.box.intersects(box)) continue;
    if (branch.second < 0) {
      found.insert(found.end(), order_.begin() + branch.first, order_.begin() + branch.last);
    } else {
      open.push_back(b + 1);
      open.push_back(branch.second);
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

bool SurfaceTree::is_hit(const Vec3& start, const Vec3& along, double after) const {
  const Vec3 inverse = along.cwiseInverse();
  const auto meets_box = [&](const Eigen::AlignedBox3d& box) {
    double from = after, to = std::numeric_limits<double>::infinity();
    for (int d = 0; d < 3; ++d) {
      const double a = (box.min()[d] - start[d]) * inverse[d], b = (box.max()[d] - start[d]) * inverse[d];
      from = std::max(from, std::min(a, b));
      to = std::min(to, std::max(a, b));
    }
    return from <= to;
  };
  std::vector<int> open;
  if (!branches_.empty()) open.push_back(0);
  while (!open.empty()) {
    const int b = open.back();
    open.pop_back();
    if (!meets_box(branches_[b].box)) continue;
    if (branches_[b].second < 0) {
      for (const int t : triangles_of(branches_[b]))
        if (ray_triangle_distance(start, along, corners(t)) > after) return true;
    } else {
      open.push_back(b + 1);
      open.push_back(branches_[b].second);
    }
  }
  return false;
}

Vec3 nearest_on_triangle(const Vec3& x, const std::array<Vec3, 3>& triangle) {
  const auto& [a, b, c] = triangle;
  const auto w = closest_point_weights(x, a, b, c);
  const Vec3 point = w[0] * a + w[1] * b + w[2] * c;
  return point.allFinite() ? point : a;  // of a triangle without area
}

TriangleMesh constrained_surface(const TetMesh& mesh) {
  const LocalMesh local(mesh, {});
  TriangleMesh surface{mesh.nodes, {}, mesh.source};
  for (int n = 0; n < local.nodes(); ++n)
    for (const Triangle& face : local.surface_faces(n))
      if (n < face[1] && n < face[2]) surface.triangles.push_back(face);
  return surface;
}

std::vector<std::vector<Vec3>> samples_of(const TriangleMesh& surface) {
  std::vector<std::vector<Vec3>> samples(surface.triangles.size());
  std::vector<char> seen(surface.nodes.size(), 0);
  std::set<std::pair<int, int>> edges;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = surface.triangles[t][k], b = surface.triangles[t][(k + 1) % 3];
      sum += surface.nodes[a];
      if (!std::exchange(seen[a], 1)) samples[t].push_back(surface.nodes[a]);
      if (edges.insert(std::minmax(a, b)).second) samples[t].push_back((surface.nodes[a] + surface.nodes[b]) / 2);
    }
    samples[t].push_back(sum / 3);
  }
  return samples;
}

double surface_distance(const SurfaceTree& a, const SurfaceTree& b) {
  return std::max(one_sided_distance(a, b), one_sided_distance(b, a));
}

}  // namespace heml
