#include <algorithm>
#include <heml/math/closest.hpp>
#include <heml/mesh/burn.hpp>
#include <heml/mesh/faces.hpp>
#include <limits>

namespace heml {
namespace {

using Corners = std::array<Vec3, 4>;  // of an element

double distance(const Vec3& x, const std::array<Vec3, 3>& triangle) {
  const auto& [a, b, c] = triangle;
  const auto [u, v, w] = closest_point_weights(x, a, b, c);
  return (u * a + v * b + w * c - x).norm();
}

/// Whether a point is in an element, which may be inverted.
bool contains(const Corners& tet, const Vec3& x) {
  int above = 0, below = 0;
  for (std::size_t c = 0; c < 4; ++c) {
    Corners part = tet;
    part[c] = x;
    const double volume = (part[1] - part[0]).cross(part[2] - part[0]).dot(part[3] - part[0]);
    above += volume > 0;
    below += volume < 0;
  }
  return above == 0 || below == 0;
}

/// The path of an electrode: triangles where it sweeps a surface, and segments, which are their edges, or all there is
/// where the electrode is a point.
class Path {
 public:
  explicit Path(const Sweep& sweep) {
    const auto& blades = sweep.blades;
    for (std::size_t k = 0; k < blades.size(); ++k) {
      add_segment(blades[k][0], blades[k][1]);
      if (k == 0) continue;
      const auto& [tip, end] = blades[k - 1];
      const auto& [next_tip, next_end] = blades[k];
      add_segment(tip, next_tip);
      add_segment(end, next_end);
      add_segment(end, next_tip);
      add_triangle(tip, end, next_tip);
      add_triangle(next_tip, end, next_end);
    }
  }

  const Eigen::AlignedBox3d& box() const { return box_; }

  /// From an element; 0 where they meet.
  double distance_to(const Corners& tet) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Segment& segment : segments_) nearest = std::min(nearest, distance(segment, tet));
    for (const auto& triangle : triangles_) {
      for (const Vec3& corner : tet) nearest = std::min(nearest, heml::distance(corner, triangle));
      for (const auto& [a, b] : tet_edges)
        if (segment_triangle_crossing(tet[a], tet[b], triangle)) return 0;
    }
    return nearest;
  }

 private:
  struct Segment {
    Vec3 from, to;
  };

  static double distance(const Segment& segment, const Corners& tet) {
    if (contains(tet, segment.from) || contains(tet, segment.to)) return 0;
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& corners : tet_faces) {
      std::array<Vec3, 3> face;
      for (std::size_t k = 0; k < 3; ++k) face[k] = tet[static_cast<std::size_t>(corners[k])];
      if (segment_triangle_crossing(segment.from, segment.to, face)) return 0;
      nearest = std::min({nearest, heml::distance(segment.from, face), heml::distance(segment.to, face)});
    }
    const Vec3 along = segment.to - segment.from;
    for (const auto& [a, b] : tet_edges) {
      const auto [s, t] = closest_on_segments(segment.from, along, tet[a], tet[b] - tet[a]);
      nearest = std::min(nearest, (segment.from + s * along - tet[a] - t * (tet[b] - tet[a])).norm());
    }
    return nearest;
  }

  void add_segment(const Vec3& from, const Vec3& to) {
    segments_.push_back({from, to});
    box_.extend(from).extend(to);
  }

  /// None without an area: its edges are all there is.
  void add_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double longest = std::max((b - a).squaredNorm(), (c - a).squaredNorm());
    if ((b - a).cross(c - a).norm() > 1e-12 * longest) triangles_.push_back({a, b, c});
  }

  std::vector<Segment> segments_;
  std::vector<std::array<Vec3, 3>> triangles_;
  Eigen::AlignedBox3d box_;
};

}  // namespace

double burn_level(double distance, double radius) {
  const double t = std::clamp(2 * distance / radius - 1, 0.0, 1.0);
  return 1 - t * t * (3 - 2 * t);
}

std::vector<Burn> burns_after(const Heat& heat, const Sweep& sweep, const TetMesh& mesh, const std::vector<Vec3>& x,
                              const Topology& topology) {
  std::vector<Burn> burns = mesh.burns;
  burns.resize(mesh.tets.size());
  const Path path(sweep);
  for (const int element : topology.elements) {
    const auto t = static_cast<std::size_t>(element);
    Corners tet;
    for (std::size_t c = 0; c < 4; ++c) tet[c] = x[static_cast<std::size_t>(mesh.tets[t][c])];
    Eigen::AlignedBox3d box(tet[0]);
    for (const Vec3& corner : tet) box.extend(corner);
    if (!(box.exteriorDistance(path.box()) < heat.radius)) continue;
    const double level = burn_level(path.distance_to(tet), heat.radius);
    burns[t].level = std::max(burns[t].level, level);
    burns[t].shrink = std::max(burns[t].shrink, heat.shrink * level);
  }
  return burns;
}

bool are_contracting(const std::vector<Burn>& burns) {
  return std::any_of(burns.begin(), burns.end(), [](const Burn& burn) { return burn.scale > 1 - burn.shrink; });
}

void contract(std::vector<Burn>& burns, double by) {
  for (Burn& burn : burns)
    if (const double end = 1 - burn.shrink; burn.scale > end) burn.scale = std::max(end, burn.scale - by);
}

}  // namespace heml
