#pragma once
// The surface a blade sweeps, as triangles between its edge at one moment and the next:
//
//     blade 0     1        2
//        tip ●────●────────●
//            │  ╱ │     ╱  │      two triangles between neighbours
//        end ●────●────────●
#include <heml/mesh/tet_mesh.hpp>
#include <optional>
#include <span>

namespace heml {

/// A blade's edge, both ends, m, at successive moments: two at least.
struct Sweep {
  std::vector<std::array<Vec3, 2>> blades;
};

/// The surface of a sweep. Triangles that are lines or points take no part.
class SweptSurface {
 public:
  explicit SweptSurface(const Sweep& sweep);

  bool empty() const { return triangles_.empty(); }
  const Eigen::AlignedBox3d& box() const { return box_; }

  /// Where the segment from a to b first goes through: 0 at a, 1 at b. Neighbouring triangles leave no gap between
  /// them. None too where it lies in the surface.
  std::optional<double> crossing(const Vec3& a, const Vec3& b) const;

  /// The triangle nearest to a point, and how far away it is, m.
  struct Nearest {
    Vec3 point, normal;  ///< m; unit
    double distance;
  };
  Nearest nearest(const Vec3& to) const;

 private:
  std::vector<std::array<Vec3, 3>> triangles_;
  Eigen::AlignedBox3d box_;
};

}  // namespace heml
