#pragma once
// Contact surfaces and contact detection: a table is a half space, a probe a capsule (a ball where its shaft has no
// length), a suture a thread that bounds the distance of two nodes. For each, each_contact() yields contact points of
// the tissue with gap and normal; impulses (contact_impulses.hpp) and the penalty energy (contact_potential.hpp) use
// the same points.
//
//   half space: at every node          capsule: at the point of each face that is nearest to its axis
//
//     o   o   o   gap > 0                      ──────────────┐ tail
//   ──┴───┴───┴── normal ↑                     axis · · · · ·│ radius
//   ////////////  gap < 0                      ──────────────┘
//
// A face whose corners are above a plane is above it everywhere, so nodes suffice; a probe may be smaller than a face.
// The contact point of a thread is the difference of its ends, which must stay within a ball of the thread's length.
#include <heml/math/types.hpp>
#include <heml/mesh/tet_mesh.hpp>
#include <optional>
#include <span>
#include <vector>

namespace heml {

/// A fixed half space.
struct Table {
  Vec3 point = Vec3::Zero();    ///< m, on it
  Vec3 normal = Vec3::UnitY();  ///< unit, towards the tissue
  double friction = 0;          ///< Coulomb's coefficient
};

/// A table from the moment at which it is put where it is. One that is put where tissue is rises from below that tissue
/// to its place, since tissue that is found deep inside would be thrown out of it.
struct PlacedTable {
  Table table;
  double depth = 0;  ///< m, below its place at `start`
  double speed = 0;  ///< m/s, at which it rises
  double start = 0;  ///< s
  bool rises(double time) const { return depth > speed * (time - start); }
};

/// A rigid ball or capsule whose tip follows a polyline at constant speed and stays at its end.
class Probe {
 public:
  /// radius: m. shaft: m, from the tip's centre to the other end of the axis; 0: a ball.
  Probe(double radius, const Vec3& shaft, double friction) : radius_(radius), shaft_(shaft), friction_(friction) {}

  /// Starts moving along `path` (one or more positions of the tip, m) at `time` (s) with `speed` (m/s), from the
  /// current position; the first call starts at path[0].
  void go(const std::vector<Vec3>& path, double speed, double time);
  /// Position of the tip at a time (s), m. Requires an earlier go().
  Vec3 tip(double time) const;

  double radius() const { return radius_; }
  double friction() const { return friction_; }
  const Vec3& shaft() const { return shaft_; }
  double speed() const { return speed_; }  ///< m/s, while it moves

 private:
  double radius_;
  Vec3 shaft_;
  double friction_, speed_ = 0, start_ = 0;
  std::vector<Vec3> path_;
};

/// A thread between two nodes whose length changes linearly over ramp_time.
struct Suture {
  std::array<int, 2> nodes;  ///< internal numbers
  double from, to;           ///< m, lengths at the start and the end
  double start, ramp_time;   ///< s
  double length(double time) const;
};

/// A table, probe, suture or the tissue itself at one time.
struct ContactSurface {
  enum class Shape { plane, capsule, thread, tissue };
  Shape shape;
  Vec3 point;                 ///< m: on the plane; the capsule's tip
  Vec3 other;                 ///< the plane's normal, unit; the capsule's other end, m
  double radius;              ///< m, of the capsule; the thread's length
  double friction;            ///< Coulomb's coefficient
  std::array<int, 2> ends{};  ///< of the thread
};

ContactSurface surface_of(const PlacedTable& placed, double time);
ContactSurface surface_of(const Probe& probe, double time);
ContactSurface surface_of(const Suture& suture, double time);

/// A point of the tissue near a surface, as a weighted sum of nodal positions. Weights of a node or a face sum to 1.
/// Weights of a thread or a self-contact pair sum to 0: their point is the vector between the two sides.
struct ContactPoint {
  std::array<int, 4> nodes;
  std::array<double, 4> weights;
  int count;    ///< of nodes: 1, 2 (a thread), 3 (a face) or 4 (self_contact.hpp)
  double gap;   ///< m, negative is penetration
  Vec3 normal;  ///< unit, direction out
};

/// The point of a face (corners at a, b, c, m) nearest to a capsule; none where the gap exceeds `reach` (m) or the axis
/// touches the face without passing through it, so that the normal is undefined. Where the axis passes through the
/// face, the gap is −(radius + depth of the less deep end below the face), and the normal takes the face over that end.
std::optional<ContactPoint> capsule_face_contact(const ContactSurface& capsule, const Triangle& face, const Vec3& a,
                                                 const Vec3& b, const Vec3& c, double reach);

/// False only where a face with these corners (m) is no nearer to a capsule than `reach` (m).
bool may_touch(const ContactSurface& capsule, const Vec3& a, const Vec3& b, const Vec3& c, double reach);

/// Contact of a thread with its ends at a and b (m); none where it is slack by more than `reach` (m) or a equals b.
std::optional<ContactPoint> thread_contact(const ContactSurface& thread, const Vec3& a, const Vec3& b, double reach);

/// Nodes and faces of a body's surface, internal numbers.
struct ContactBoundary {
  std::vector<int> nodes;       ///< ascending
  std::vector<Triangle> faces;  ///< outward
};

/// Calls visit(ContactPoint) for each of these faces that has a point with a gap below `reach` (m) to a capsule, in
/// their order.
template <class At, class Visit>
void each_capsule_contact(const ContactSurface& capsule, const std::vector<Triangle>& faces, double reach, const At& at,
                          const Visit& visit) {
  for (const Triangle& face : faces) {
    const Vec3 a = at(face[0]), b = at(face[1]), c = at(face[2]);
    if (!may_touch(capsule, a, b, c, reach)) continue;
    if (const auto point = capsule_face_contact(capsule, face, a, b, c, reach)) visit(*point);
  }
}

/// Calls visit(ContactPoint) for each contact point with a gap below `reach` (m), in the order of boundary.nodes or
/// boundary.faces. at(node): position, m. Linear in the size of the boundary.
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
  each_capsule_contact(surface, boundary.faces, reach, at, visit);
}

/// The gap (m) at the nodes of a point found before, after the surface or the nodes moved; 0 where a thread or capsule
/// no longer touches.
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
