#include <algorithm>
#include <heml/math/closest.hpp>
#include <heml/mesh/blade_front.hpp>
#include <heml/mesh/faces.hpp>
#include <limits>
#include <set>

namespace heml {
namespace {

Vec3 on_blade(const std::array<Vec3, 2>& blade, double along) { return blade[0] + along * (blade[1] - blade[0]); }

std::array<double, 4> barycentric(const Vec3& place, const std::array<Vec3, 4>& corners) {
  const double whole = signed_volume(corners[0], corners[1], corners[2], corners[3]);
  std::array<double, 4> weights;
  for (std::size_t a = 0; a < 4; ++a) {
    std::array<Vec3, 4> part = corners;
    part[a] = place;
    weights[a] = signed_volume(part[0], part[1], part[2], part[3]) / whole;
  }
  return weights;
}

}  // namespace

BladeFront::BladeFront(const std::array<Vec3, 2>& blade, const TetMesh& mesh, const std::vector<Vec3>& x,
                       const Topology& topology)
    : path_{blade} {
  const Eigen::AlignedBox3d segment(blade[0].cwiseMin(blade[1]), blade[0].cwiseMax(blade[1]));
  std::set<std::array<int, 3>> seen;
  for (const int t : topology.elements) {
    const Tet& tet = mesh.tets[static_cast<std::size_t>(t)];
    std::array<Vec3, 4> corners;
    Eigen::AlignedBox3d box;
    for (std::size_t a = 0; a < 4; ++a) box.extend(corners[a] = x[static_cast<std::size_t>(tet[a])]);
    if (!box.intersects(segment) || signed_volume(corners[0], corners[1], corners[2], corners[3]) == 0) continue;
    for (const auto& face : tet_faces) {
      std::array<std::pair<int, Vec3>, 3> triangle;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto a = static_cast<std::size_t>(face[k]);
        triangle[k] = {tet[a], corners[a]};
      }
      std::sort(triangle.begin(), triangle.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
      const auto& [a, b, c] = triangle;
      const auto along = segment_triangle_crossing(blade[0], blade[1], {a.second, b.second, c.second});
      if (along && seen.insert({a.first, b.first, c.first}).second) add_point(*along, tet, corners);
    }
    for (const double end : {0.0, 1.0})
      if (const auto weights = barycentric(on_blade(blade, end), corners);
          *std::min_element(weights.begin(), weights.end()) >= 0)
        points_.push_back({end, tet, weights});
  }
  if (points_.empty()) attach_beside(x, topology, mesh);
  std::stable_sort(points_.begin(), points_.end(), [](const Point& a, const Point& b) { return a.along < b.along; });
}

void BladeFront::attach_beside(const std::vector<Vec3>& x, const Topology& topology, const TetMesh& mesh) {
  const Vec3 along = path_.front()[1] - path_.front()[0];
  double nearest = std::numeric_limits<double>::infinity();
  for (const int t : topology.elements)
    for (const int n : mesh.tets[static_cast<std::size_t>(t)]) {
      const Vec3 to_node = x[static_cast<std::size_t>(n)] - path_.front()[0];
      const double length = along.squaredNorm();
      const double where = length > 0 ? std::clamp(to_node.dot(along) / length, 0.0, 1.0) : 0;
      const double distance = (to_node - where * along).squaredNorm();
      if (distance >= nearest) continue;
      nearest = distance;
      beside_ = n;
    }
  if (beside_ >= 0) beside_place_ = x[static_cast<std::size_t>(beside_)];
}

/// Adds the point of the blade in or on an element with corners at the given places.
void BladeFront::add_point(double along, const Tet& tet, const std::array<Vec3, 4>& corners) {
  points_.push_back({along, tet, barycentric(on_blade(path_.front(), along), corners)});
}

OrientedSweep BladeFront::join(const Sweep& sweep, const TetMesh& mesh, const std::vector<Vec3>& x,
                               const Topology& topology, double tolerance, const Heading& heading) const {
  if (path_.empty() || sweep.blades.empty()) return oriented(sweep);
  const auto& last = path_.back();
  for (std::size_t end = 0; end < 2; ++end)
    if ((sweep.blades.front()[end] - last[end]).norm() > tolerance) return oriented(sweep);
  std::vector<std::array<Vec3, 2>> blades = path_;
  blades.insert(blades.end(), sweep.blades.begin() + 1, sweep.blades.end());
  if (!in_tissue() && beside_ >= 0) {
    const Vec3 moved = x[static_cast<std::size_t>(beside_)] - beside_place_;
    if (!moved.isZero(0) && BladeFront(path_.front(), mesh, x, topology).in_tissue())
      blades.insert(blades.begin(), {blades.front()[0] + moved, blades.front()[1] + moved});
  }
  const OrientedSweep whole = oriented({blades}, heading);
  if (!in_tissue() || blades.size() < 2) return whole;

  const std::vector<CurvePoint> curve = curve_now(x);
  std::size_t first = 1;
  while (first < blades.size() && !is_ahead(blades[first - 1], blades[first], curve)) ++first;
  OrientedSweep result{{}, {}, whole.heading};
  if (first == blades.size()) return result;
  Sweep& joined = result.sweep;
  // A strip of a short blade for each segment of the curve; between two strips the blade shrinks to a point, which
  // sweeps no area.
  const auto& next = blades[first];
  for (std::size_t k = 1; k < curve.size(); ++k) {
    const Vec3 from = on_blade(next, curve[k - 1].along), to = on_blade(next, curve[k].along);
    joined.blades.push_back({curve[k - 1].place, curve[k].place});
    joined.blades.push_back({from, to});
    joined.blades.push_back({to, to});
    joined.blades.push_back({curve[k].place, curve[k].place});
  }
  joined.blades.pop_back();
  const auto own = static_cast<std::ptrdiff_t>(first);
  joined.blades.insert(joined.blades.end(), blades.begin() + own, blades.end());
  // The strips go the way of the motion that ends at the next blade.
  result.signs.assign(joined.blades.size() - blades.size() + first, whole.signs[first - 1]);
  result.signs.insert(result.signs.end(), whole.signs.begin() + own, whole.signs.end());
  return result;
}

/// The front as it lies now. Ends of the blade outside the tissue move with the nearest point of the front.
std::vector<BladeFront::CurvePoint> BladeFront::curve_now(const std::vector<Vec3>& x) const {
  const auto& blade = path_.front();
  std::vector<CurvePoint> curve;
  for (const Point& point : points_) {
    Vec3 place = Vec3::Zero();
    for (std::size_t a = 0; a < 4; ++a) place += point.weights[a] * x[static_cast<std::size_t>(point.nodes[a])];
    curve.push_back({point.along, place, true});
  }
  const auto end = [&](double along, const CurvePoint& nearest) {
    return CurvePoint{along, on_blade(blade, along) + nearest.place - on_blade(blade, nearest.along), false};
  };
  if (curve.front().along > 0) curve.insert(curve.begin(), end(0, curve.front()));
  if (curve.back().along < 1) curve.push_back(end(1, curve.back()));
  return curve;
}

/// Whether a blade that comes from another position has passed all points of the front that are in the tissue.
bool BladeFront::is_ahead(const std::array<Vec3, 2>& before, const std::array<Vec3, 2>& blade,
                          const std::vector<CurvePoint>& curve) {
  return std::all_of(curve.begin(), curve.end(), [&](const CurvePoint& point) {
    const Vec3 place = on_blade(blade, point.along);
    return !point.in_tissue || (place - point.place).dot(place - on_blade(before, point.along)) >= 0;
  });
}

void BladeFront::pass(const Sweep& sweep) {
  if (!sweep.blades.empty()) path_.insert(path_.end(), sweep.blades.begin() + 1, sweep.blades.end());
}

}  // namespace heml
