#pragma once
// A surface to measure distances from: a tree of boxes round its triangles.
#include <heml/mesh/tet_mesh.hpp>
#include <limits>
#include <span>
#include <vector>

namespace heml {

class SurfaceTree {
 public:
  explicit SurfaceTree(TriangleMesh surface);

  struct Nearest {
    int triangle = -1;
    Vec3 point = Vec3::Zero();
    double distance = std::numeric_limits<double>::infinity();  ///< m
  };
  /// The nearest point of the surface; no triangle if none is nearer than `within`.
  Nearest nearest(const Vec3& x, double within = std::numeric_limits<double>::infinity()) const {
    return nearest(x, within, false);
  }
  bool is_within(const Vec3& x, double distance) const { return nearest(x, distance, true).triangle >= 0; }
  /// The triangles whose boxes overlap a box, ascending.
  std::vector<int> overlapping(const Eigen::AlignedBox3d& box) const;

  /// Whether a ray from `start` along `along` meets a triangle farther away than `after`, in multiples of `along`.
  bool is_hit(const Vec3& start, const Vec3& along, double after) const;

  const TriangleMesh& surface() const { return surface_; }
  std::array<Vec3, 3> corners(int triangle) const;

  struct Branch {
    Eigen::AlignedBox3d box;
    int first, last;  ///< of the order of triangles
    int second = -1;  ///< its second half; the first half follows it. −1: a leaf
  };
  const std::vector<Branch>& branches() const { return branches_; }  ///< the whole first, parts after what they are of
  std::span<const int> triangles_of(const Branch& branch) const {
    return {order_.data() + branch.first, order_.data() + branch.last};
  }

 private:
  Nearest nearest(const Vec3& x, double within, bool any) const;  ///< any: the first one found
  void build(int first, int last, const std::vector<Vec3>& centres);

  TriangleMesh surface_;
  std::vector<int> order_;
  std::vector<Branch> branches_;
};

/// The point of a triangle nearest to x.
Vec3 nearest_on_triangle(const Vec3& x, const std::array<Vec3, 3>& triangle);

/// The constrained faces of a mesh (boundary and interfaces between regions), each once.
TriangleMesh constrained_surface(const TetMesh& mesh);

/// Corners, midpoints of edges and centroids of the triangles, each at the first triangle that has it.
std::vector<std::vector<Vec3>> samples_of(const TriangleMesh& surface);

/// The greatest distance of the samples of either surface from the other, m.
double surface_distance(const SurfaceTree& a, const SurfaceTree& b);

}  // namespace heml
