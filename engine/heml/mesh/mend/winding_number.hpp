#pragma once
// Generalised winding number of a surface, which need not be closed: about 1 inside and 0 outside, the sum of its
// triangles' solid angles over 4π (A. Jacobson, L. Kavan & O. Sorkine-Hornung, ACM Transactions on Graphics 32(4),
// 2013). Triangles far away are summed as one dipole (G. Barill et al., ACM Transactions on Graphics 37(4), 2018).
#include <heml/mesh/improve/surface_tree.hpp>
#include <heml/mesh/labels/region_field.hpp>

namespace heml {

class WindingNumber : public RegionField {
 public:
  explicit WindingNumber(TriangleMesh surface);

  double at(const Vec3& x) const;
  /// Region 1 is where the surface winds round, more than half of once.
  int label_at(const Vec3& x) const override { return at(x) > 0.5 ? 1 : 0; }
  double difference(int a, int, const Vec3& x) const override { return a == 1 ? at(x) - 0.5 : 0.5 - at(x); }

  const SurfaceTree& tree() const { return tree_; }

 private:
  struct Dipole {
    Vec3 area = Vec3::Zero();    ///< sum of area vectors, m²
    Vec3 centre = Vec3::Zero();  ///< mean by area, m
    double size = 0;             ///< area, m²
    double reach = 0;            ///< squared distance from which it stands for its triangles, m²
  };
  SurfaceTree tree_;
  std::vector<Dipole> dipoles_;  ///< of the tree's branches
};

}  // namespace heml
