#pragma once
// What tissue does not pass, and where it meets it: a table is a half space, a probe a capsule (a ball where its shaft
// has no length), a suture a thread between two nodes that is never longer than it is. Whoever keeps tissue there, by
// impulses or by an energy, asks all three the same: at which points of the tissue, how far it may go, and which way is
// back.
//
//   half space: at every node          capsule: at the point of each face that is nearest to its axis
//
//     o   o   o   gap > 0                      ──────────────┐ tail
//   ──┴───┴───┴── normal ↑                     axis · · · · ·│ radius
//   ////////////  gap < 0                      ──────────────┘
//
// A plane lies below all of a face that is above it with its corners; a probe may be smaller than a face. The "point"
// of a thread is the difference of its ends, which must stay within a ball of the thread's length.
#include <heml/math/types.hpp>
#include <heml/mesh/tet_mesh.hpp>
#include <optional>
#include <span>
#include <vector>

namespace heml {

/// A fixed half space to rest on.
struct Table {
  Vec3 point = Vec3::Zero();    ///< m, on it
  Vec3 normal = Vec3::UnitY();  ///< unit, towards the tissue
  double friction = 0;          ///< Coulomb's coefficient
};

/// A rigid ball or capsule that goes along a path at a steady speed, and stays at its end.
class Probe {
 public:
  /// radius: m. shaft: m, from the tip's centre to the other end of the axis; 0: a ball.
  Probe(double radius, const Vec3& shaft, double friction) : radius_(radius), shaft_(shaft), friction_(friction) {}

  /// Sets out at a time, s, from where it is then, or from the path's first place when it was nowhere. path: places of
  /// the tip, m, one or more. speed: m/s.
  void go(const std::vector<Vec3>& path, double speed, double time);
  /// Where the tip is at a time, m.
  Vec3 tip(double time) const;

  double radius() const { return radius_; }
  double friction() const { return friction_; }
  const Vec3& shaft() const { return shaft_; }
  double speed() const { return speed_; }  ///< m/s, while it goes

 private:
  double radius_;
  Vec3 shaft_;
  double friction_, speed_ = 0, start_ = 0;
  std::vector<Vec3> path_;
};

/// A thread between two nodes, drawn in steadily.
struct Suture {
  std::array<int, 2> nodes;  ///< inner numbers
  double from, to;           ///< m, lengths at the start and the end
  double start, ramp_time;   ///< s
  double length(double time) const;
};

/// One of them at one moment.
struct ContactSurface {
  enum class Shape { plane, capsule, thread, tissue };
  Shape shape;
  Vec3 point;                 ///< m: on the plane; the capsule's tip
  Vec3 other;                 ///< the plane's normal, unit; the capsule's other end, m
  double radius;              ///< m, of the capsule; the thread's length
  double friction;            ///< Coulomb's coefficient
  std::array<int, 2> ends{};  ///< of the thread
};

ContactSurface surface_of(const Table& table);
ContactSurface surface_of(const Probe& probe, double time);
ContactSurface surface_of(const Suture& suture, double time);

/// A point of the tissue near a surface: a sum of nodes' positions. Of a face the weights' sum is 1; of a thread's
/// ends, and of tissue that meets tissue, where the point is the way from one to the other, it is 0.
struct ContactPoint {
  std::array<int, 4> nodes;
  std::array<double, 4> weights;
  int count;    ///< of nodes: 1, 2 (a thread), 3 (a face) or 4 (self_contact.hpp)
  double gap;   ///< m, negative where it must not be
  Vec3 normal;  ///< unit, the way back
};

/// The point of a face (corners a, b, c, m) that is nearest to a capsule; nothing where they are further apart than
/// `reach`, m, or where no direction is out.
std::optional<ContactPoint> capsule_face_contact(const ContactSurface& capsule, const Triangle& face, const Vec3& a,
                                                 const Vec3& b, const Vec3& c, double reach);

/// The thread's, its ends being at a and b, m; nothing where it is slack by more than `reach`, m, or has no direction.
std::optional<ContactPoint> thread_contact(const ContactSurface& thread, const Vec3& a, const Vec3& b, double reach);

/// What of a body can touch: the nodes and the faces of its surface, inner numbers.
struct ContactBoundary {
  std::vector<int> nodes;       ///< ascending
  std::vector<Triangle> faces;  ///< outward
};

/// Calls visit(point) for each point of the skin nearer to the surface than `reach`, m, in the skin's order.
/// at(node): m.
template <class At, class Visit>
void each_contact(const ContactSurface& surface, const ContactBoundary& boundary, double reach, const At& at,
                  const Visit& visit) {
  if (surface.shape == ContactSurface::Shape::thread) {
    if (const auto point = thread_contact(surface, at(surface.ends[0]), at(surface.ends[1]), reach)) visit(*point);
    return;
  }
  if (surface.shape == ContactSurface::Shape::plane) {
    for (const int n : boundary.nodes) {
      const double gap = surface.other.dot(at(n) - surface.point);
      if (gap < reach) visit(ContactPoint{{n, n, n, n}, {1, 0, 0, 0}, 1, gap, surface.other});
    }
    return;
  }
  const Vec3 middle = (surface.point + surface.other) / 2;
  const double extent = (surface.other - surface.point).norm() / 2 + surface.radius + reach;
  for (const Triangle& face : boundary.faces) {
    const Vec3 a = at(face[0]), b = at(face[1]), c = at(face[2]);
    const double size = std::max((b - a).squaredNorm(), (c - a).squaredNorm());
    const double away = (a - middle).norm() - extent;
    if (away > 0 && away * away > size) continue;
    if (const auto point = capsule_face_contact(surface, face, a, b, c, reach)) visit(*point);
  }
}

/// The gap at the nodes of a point found before, with the surface or the nodes elsewhere, m; 0 where they are apart.
template <class At>
double updated_gap(const ContactSurface& surface, const ContactPoint& point, const At& at) {
  std::optional<ContactPoint> now;
  if (surface.shape == ContactSurface::Shape::plane) return surface.other.dot(at(point.nodes[0]) - surface.point);
  if (surface.shape == ContactSurface::Shape::thread)
    now = thread_contact(surface, at(point.nodes[0]), at(point.nodes[1]), 0);
  else
    now = capsule_face_contact(surface, {point.nodes[0], point.nodes[1], point.nodes[2]}, at(point.nodes[0]),
                               at(point.nodes[1]), at(point.nodes[2]), 0);
  return now ? now->gap : 0;
}

}  // namespace heml
