#pragma once
// The surface that a blade sweeps, as triangles between its cutting edge at successive times:
//
//     blade 0     1        2
//        tip ●────●────────●
//            │  ╱ │     ╱  │      two triangles between neighbours
//        end ●────●────────●
#include <heml/mesh/tet_mesh.hpp>
#include <optional>
#include <span>

namespace heml {

/// The two ends of a blade's cutting edge, m, at two or more successive times.
struct Sweep {
  std::vector<std::array<Vec3, 2>> blades;
};

/// The surface of a sweep without degenerate triangles. Queries are linear in the number of triangles.
class SweptSurface {
 public:
  explicit SweptSurface(const Sweep& sweep);

  bool empty() const { return triangles_.empty(); }
  const Eigen::AlignedBox3d& box() const { return box_; }

  /// Parameter of the first intersection with the segment from a (0) to b (1). Watertight: no gap between neighbouring
  /// triangles. None if there is no intersection or the segment lies in the surface.
  std::optional<double> crossing(const Vec3& a, const Vec3& b) const;

  /// Closest point on the surface, the normal of its triangle, and the distance.
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
