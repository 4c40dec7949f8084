#pragma once
// Bodies as signed functions of space: negative inside, positive outside, close to the distance near the surface.
//
//   primitives (ellipsoid, tube, half_space) ──► smooth_union, smooth_cut ──► a Shape ──► contour.hpp
#include <functional>
#include <heml/math/types.hpp>
#include <vector>

namespace heml::make {

/// f(p), m. Zero on the surface.
using Shape = std::function<double(const Vec3& p)>;

/// First-order distance to an ellipsoid with semi-axes `radii`, m.
double ellipsoid(const Vec3& p, const Vec3& centre, const Vec3& radii);

/// A place on the axis of a tube.
struct Station {
  Vec3 centre;
  double radius;
};

/// A Catmull–Rom curve through stations, swept by a sphere of changing radius.
class Tube {
 public:
  explicit Tube(const std::vector<Station>& stations);
  double distance(const Vec3& p) const;
  Station last() const { return samples_.back(); }
  /// Unit tangent at the last station, pointing out of the tube.
  Vec3 direction() const;

 private:
  std::vector<Station> samples_;
};

/// Distance to the plane through `origin`; negative on the side `normal` points away from.
double half_space(const Vec3& p, const Vec3& origin, const Vec3& normal);

/// The union, with a fillet about `blend` wide (polynomial smooth minimum; Quilez).
double smooth_union(double a, double b, double blend);
/// What is in both a and b, the ridge rounded likewise.
double smooth_intersection(double a, double b, double blend);
/// a without b, the rim rounded likewise.
double smooth_cut(double a, double b, double blend);

/// ∇f by central differences.
Vec3 gradient(const Shape& shape, const Vec3& p);

/// The point of the surface reached from p along ∇f.
Vec3 project(const Shape& shape, Vec3 p);

}  // namespace heml::make
