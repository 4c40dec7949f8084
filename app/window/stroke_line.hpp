#pragma once
// The line that a scalpel's stroke has drawn on the skin. Its points move with the tissue; where that has parted, the
// line ends and the wound shows.
#include <app/render/surface_point.hpp>
#include <array>
#include <heml/session/frame.hpp>
#include <vector>

namespace heml::window {

class StrokeLine {
 public:
  void clear() { points_.clear(); }
  /// Adds the point of the skin at a hit.
  void add(const render::Hit& hit, const Frame& frame, const SurfaceMesh& surface_mesh);
  /// The line leaves the skin: the next point begins another piece.
  void lift();
  /// Segments as the tissue lies in a frame, m.
  std::vector<std::array<Vec3f, 2>> segments(const Frame& frame, const SurfaceMesh& surface_mesh) const;

 private:
  struct Point {
    render::SurfacePoint at;
    float extent;  // m, longest side of the triangle when it was hit
    bool begins;   // a piece of the line
  };
  std::vector<Point> points_;
  bool lifted_ = true;
};

}  // namespace heml::window
