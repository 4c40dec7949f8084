#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <heml/tools/face_slide.hpp>

namespace heml {
namespace {

constexpr double at_end = 1e-9;          // of the axis
constexpr double same_direction = 1e-3;  // sine of the angle between the axis and an edge
constexpr double least_distance = 0.5;   // of the capsule's radius: t²/d stays bounded

/// A direction in which the nearest points of face and axis slide, perpendicular to the normal.
struct Direction {
  Vec3 along = Vec3::Zero();     // unit
  std::array<double, 3> rate{};  // 1/m, of the corners' weights
};

/// Of a point inside a face two, perpendicular to each other; of one on an edge one; of a corner none.
std::vector<Direction> directions_on_face(const ContactPoint& point, const std::array<Vec3, 3>& x) {
  std::vector<std::size_t> touching;
  for (std::size_t k = 0; k < 3; ++k)
    if (point.weights[k] > 0) touching.push_back(k);
  if (touching.size() < 2) return {};
  const Vec3 edge = x[touching[1]] - x[touching[0]];
  const double length = edge.norm();
  if (!(length > 0)) return {};
  Direction first{edge / length, {}};
  if (touching.size() == 2) {
    first.rate[touching[0]] = -1 / length;
    first.rate[touching[1]] = 1 / length;
    return {first};
  }
  const Vec3 other = x[2] - x[0], N = edge.cross(other);
  const double square = N.squaredNorm();
  if (!(square > 0)) return {};
  const Vec3 of_b = other.cross(N) / square, of_c = N.cross(edge) / square;  // gradients of the weights
  Direction second{N.cross(first.along).normalized(), {}};
  for (Direction* each : {&first, &second})
    each->rate = {-each->along.dot(of_b + of_c), each->along.dot(of_b), each->along.dot(of_c)};
  return {first, second};
}

/// Along the axis, less what one along an edge already has; none where the point is nearest to an end.
std::optional<Direction> direction_on_axis(const ContactSurface& capsule, const Vec3& on_axis,
                                           const std::vector<Direction>& on_edge) {
  const Vec3 axis = capsule.other - capsule.point;
  const double square = axis.squaredNorm(), where = axis.dot(on_axis - capsule.point);
  if (on_edge.size() > 1 || !(where > at_end * square && where < (1 - at_end) * square)) return std::nullopt;
  Direction result{axis / std::sqrt(square), {}};
  if (on_edge.empty()) return result;
  const double share = result.along.dot(on_edge[0].along);
  result.along -= share * on_edge[0].along;
  const double rest = result.along.norm();
  if (rest < same_direction) return std::nullopt;
  result.along /= rest;
  for (std::size_t k = 0; k < 3; ++k) result.rate[k] = -share / rest * on_edge[0].rate[k];
  return result;
}

}  // namespace

void add_face_slides(const ContactSurface& capsule, const ContactPoint& point, const std::array<Vec3, 3>& x,
                     double force, std::vector<RankOneTerm>& out) {
  const double distance = point.gap + capsule.radius;
  if (!(distance > 0) || !(force > 0)) return;
  std::vector<Direction> directions = directions_on_face(point, x);
  const Vec3 place = point.weights[0] * x[0] + point.weights[1] * x[1] + point.weights[2] * x[2];
  if (const auto axial = direction_on_axis(capsule, place - distance * point.normal, directions))
    directions.push_back(*axial);
  const double d = std::max(distance, least_distance * capsule.radius);
  for (const Direction& direction : directions) {
    const auto of_corner = [&](std::size_t k) -> Vec3 {
      return std::sqrt(force * d) * (point.weights[k] / d * direction.along + direction.rate[k] * point.normal);
    };
    out.push_back({3, point.nodes, {of_corner(0), of_corner(1), of_corner(2), Vec3::Zero()}});
  }
  const Vec3 first = point.normal.unitOrthogonal();
  for (const Vec3& along : {first, Vec3(point.normal.cross(first))}) {
    const auto travel = [&](std::size_t k) -> Vec3 { return std::sqrt(force / d) * point.weights[k] * along; };
    out.push_back({3, point.nodes, {travel(0), travel(1), travel(2), Vec3::Zero()}, -1});
  }
}

}  // namespace heml
