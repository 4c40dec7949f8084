#include <algorithm>
#include <heml/math/closest.hpp>
#include <heml/mesh/blade_front.hpp>
#include <heml/mesh/faces.hpp>
#include <map>

namespace heml {

BladeFront::BladeFront(const std::array<Vec3, 2>& blade, const TetMesh& mesh, const std::vector<Vec3>& x,
                       const Topology& topology)
    : path_{blade} {
  const auto at = [&](int n) -> const Vec3& { return x[static_cast<std::size_t>(n)]; };
  const Eigen::AlignedBox3d segment(blade[0].cwiseMin(blade[1]), blade[0].cwiseMax(blade[1]));
  std::map<std::array<int, 3>, Point> faces;
  for (const int t : topology.elements) {
    const Tet& tet = mesh.tets[static_cast<std::size_t>(t)];
    Eigen::AlignedBox3d box;
    for (const int n : tet) box.extend(at(n));
    if (!box.intersects(segment)) continue;
    for (const auto& face : tet_faces) {
      std::array<int, 3> nodes;
      for (std::size_t k = 0; k < 3; ++k) nodes[k] = tet[static_cast<std::size_t>(face[k])];
      std::sort(nodes.begin(), nodes.end());
      if (faces.contains(nodes)) continue;
      const auto [a, b, c] = nodes;
      const auto along = segment_triangle_crossing(blade[0], blade[1], {at(a), at(b), at(c)});
      if (!along) continue;
      const Vec3 place = blade[0] + *along * (blade[1] - blade[0]);
      const auto [u, v, w] = closest_point_weights(place, at(a), at(b), at(c));
      faces[nodes] = {*along, {a, b, c, c}, {u, v, w, 0}};
    }
  }
  for (const auto& [nodes, point] : faces) points_.push_back(point);
  for (std::size_t end = 0; end < 2; ++end) add_end(static_cast<double>(end), blade[end], mesh, x, topology);
  std::stable_sort(points_.begin(), points_.end(), [](const Point& a, const Point& b) { return a.along < b.along; });
}

/// Adds an end of the blade if it lies in an element.
void BladeFront::add_end(double along, const Vec3& place, const TetMesh& mesh, const std::vector<Vec3>& x,
                         const Topology& topology) {
  for (const int t : topology.elements) {
    const Tet& tet = mesh.tets[static_cast<std::size_t>(t)];
    std::array<Vec3, 4> corners;
    Eigen::AlignedBox3d box;
    for (std::size_t a = 0; a < 4; ++a) box.extend(corners[a] = x[static_cast<std::size_t>(tet[a])]);
    if (!box.contains(place)) continue;
    const double whole = signed_volume(corners[0], corners[1], corners[2], corners[3]);
    if (!(whole > 0)) continue;
    Point point{along, tet, {}};
    for (std::size_t a = 0; a < 4; ++a) {
      std::array<Vec3, 4> part = corners;
      part[a] = place;
      point.weights[a] = signed_volume(part[0], part[1], part[2], part[3]) / whole;
    }
    if (*std::min_element(point.weights.begin(), point.weights.end()) < 0) continue;
    points_.push_back(point);
    return;
  }
}

Sweep BladeFront::join(const Sweep& sweep, const std::vector<Vec3>& x, double tolerance) const {
  if (path_.empty() || sweep.blades.empty()) return sweep;
  const auto& last = path_.back();
  for (std::size_t end = 0; end < 2; ++end)
    if ((sweep.blades.front()[end] - last[end]).norm() > tolerance) return sweep;
  std::vector<std::array<Vec3, 2>> blades = path_;
  blades.insert(blades.end(), sweep.blades.begin() + 1, sweep.blades.end());
  if (!in_tissue() || blades.size() < 2) return {std::move(blades)};

  std::vector<std::pair<double, Vec3>> curve;
  if (points_.front().along > 0) curve.emplace_back(0, blades[0][0]);
  for (const Point& point : points_) {
    Vec3 place = Vec3::Zero();
    for (std::size_t a = 0; a < 4; ++a) place += point.weights[a] * x[static_cast<std::size_t>(point.nodes[a])];
    curve.emplace_back(point.along, place);
  }
  if (points_.back().along < 1) curve.emplace_back(1, blades[0][1]);

  // A strip of a short blade for each segment of the curve; between two strips the blade shrinks to a point, which
  // sweeps no area.
  const auto& next = blades[1];
  const auto on_next = [&](double along) -> Vec3 { return next[0] + along * (next[1] - next[0]); };
  Sweep joined;
  for (std::size_t k = 1; k < curve.size(); ++k) {
    const auto& [from, start] = curve[k - 1];
    const auto& [to, end] = curve[k];
    joined.blades.push_back({start, end});
    joined.blades.push_back({on_next(from), on_next(to)});
    joined.blades.push_back({on_next(to), on_next(to)});
    joined.blades.push_back({end, end});
  }
  joined.blades.back() = {on_next(1), on_next(1)};
  joined.blades.insert(joined.blades.end(), blades.begin() + 1, blades.end());
  return joined;
}

void BladeFront::pass(const Sweep& sweep) {
  if (!sweep.blades.empty()) path_.insert(path_.end(), sweep.blades.begin() + 1, sweep.blades.end());
}

}  // namespace heml
