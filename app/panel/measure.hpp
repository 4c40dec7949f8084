#pragma once
// Measuring on the surface: up to three points that follow the tissue, and what is known of them at each time.
//
//    1 point: value of the field there     2 points: distance     3 points: both distances, angle at the second one
//    The piece: area and volume of what hangs together with the last point.
#include <app/panel/piece.hpp>
#include <app/render/surface_point.hpp>
#include <limits>
#include <string>
#include <vector>

namespace heml::panel {

inline constexpr double not_measured = std::numeric_limits<double>::quiet_NaN();

/// Numbers are NaN while they are not known: too few points, or a point that is no longer on the shown surface.
struct Measured {
  double time = 0;  ///< s
  Field field = Field::none;
  std::vector<Vec3f> places;        ///< m, of the points; NaN
  double value = not_measured;      ///< of the field at the last point, in its unit
  double distance = not_measured;   ///< m, from the first point to the second
  double second = not_measured;     ///< m, from the second point to the third
  double angle = not_measured;      ///< degrees, at the second point
  double area = not_measured, volume = not_measured;  ///< m², m³, of the piece
};

class Measure {
 public:
  static constexpr std::size_t max_points = 3;

  void add(const render::SurfacePoint& point);  ///< a fourth point is the first of new ones
  void clear();
  const std::vector<render::SurfacePoint>& points() const { return points_; }
  bool is_empty() const { return points_.empty(); }  ///< otherwise frames should carry their solid

  /// Measures a frame, and keeps what it finds if the frame is later than the last one kept.
  void update(const Frame& frame);
  const Measured& now() const { return now_; }              ///< of the last frame
  const std::vector<Measured>& kept() const { return kept_; }  ///< since the last point was set, or since a reset

  /// What was kept, a row for each frame; empty cells where a number is not known.
  std::string csv() const;

 private:
  void keep(long tick);

  std::vector<render::SurfacePoint> points_;
  std::vector<std::optional<Vec3f>> rests_;  ///< m, of points at rest, once they were seen
  Measured now_;
  std::vector<Measured> kept_;
  long kept_tick_ = -1;
  Piece piece_;
};

}  // namespace heml::panel
