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

/// The surface of a sweep without degenerate triangles. Queries are linear in the number of triangles. Its upper side
/// is the same from triangle to triangle, also where the blade turns back.
class SweptSurface {
 public:
  /// normal: to the upper side of the first triangle, roughly; zero: any side.
  explicit SweptSurface(const Sweep& sweep, const Vec3& normal = Vec3::Zero());

  bool empty() const { return triangles_.empty(); }
  const Eigen::AlignedBox3d& box() const { return box_; }
  /// Normal of the last triangle, to its upper side. Zero for no triangle.
  Vec3 last_normal() const;

  /// The intersection with a segment from a to b.
  struct Crossing {
    double where;   ///< 0 at a, 1 at b; the first along the segment
    bool from_top;  ///< a is on the upper side of the triangle that was swept first; b is on the other
  };
  /// Watertight: no gap between neighbouring triangles. None if there is no intersection or the segment lies in the
  /// surface.
  std::optional<Crossing> crossing(const Vec3& a, const Vec3& b) const;

  /// Closest point on the surface, the normal of its triangle, and the distance.
  struct Nearest {
    Vec3 point, normal;  ///< m; unit
    double distance;
  };
  Nearest nearest(const Vec3& to) const;

 private:
  struct Triangle {
    std::array<Vec3, 3> corners;  ///< m
    Vec3 normal;                  ///< unit, to the upper side
    Eigen::AlignedBox3d box;
  };
  std::vector<Triangle> triangles_;
  Eigen::AlignedBox3d box_;
};

}  // namespace heml
