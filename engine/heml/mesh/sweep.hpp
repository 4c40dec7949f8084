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

/// The way a blade goes, and which side of its motion is the upper one of the surface that it sweeps. Where it turns
/// back the other side is, so that a cut gone over twice keeps its sides.
struct Heading {
  Vec3 motion = Vec3::Zero();  ///< m, the last one; zero: none yet
  int sign = 1;                ///< 1: (tip to end) × motion points to the upper side, −1: to the lower

  void turn(const std::array<Vec3, 2>& from, const std::array<Vec3, 2>& to);
  bool operator==(const Heading&) const = default;
};

/// A sweep, and Heading::sign of each motion, from a blade to the next.
struct OrientedSweep {
  Sweep sweep;
  std::vector<int> signs;
  Heading heading;  ///< at its end
};

/// Of a sweep that a heading leads to.
OrientedSweep oriented(const Sweep& sweep, Heading heading = {});

/// The surface of a sweep without degenerate triangles. Queries are linear in the number of triangles.
class SweptSurface {
 public:
  explicit SweptSurface(const OrientedSweep& oriented);

  bool empty() const { return triangles_.empty(); }
  const Eigen::AlignedBox3d& box() const { return box_; }

  /// The intersection with a segment from a to b.
  struct Crossing {
    double where;   ///< 0 at a, 1 at b; the first along the segment
    bool from_top;  ///< a is on the upper side; b is on the other
  };
  /// Watertight: no gap between neighbouring triangles. None if there is no intersection, the segment lies in the
  /// surface, or both its ends are on one side, beyond a fold.
  std::optional<Crossing> crossing(const Vec3& a, const Vec3& b) const;

  /// Closest point on the surface, the normal of its triangle to the upper side, and the distance.
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
